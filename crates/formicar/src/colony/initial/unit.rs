//! The unit of initial pheromone.

use crate::parameters::Parameters;

/// The unit of initial pheromone.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum PheromoneUnit {
    /// One.
    #[default]
    Absolute,
    /// The deposit of an iteration whose ants all take the straight path from start to goal without
    /// obstacles, so that the first deposits do not swamp it.
    Deposit,
}

impl Parameters for PheromoneUnit {}
