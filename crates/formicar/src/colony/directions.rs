//! The steps that an ant may take.

use crate::parameters::Parameters;

/// Steps that an ant may take.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Directions {
    /// Straight steps.
    Four,
    /// Straight steps and both along one diagonal, the one nearer to the line from start to goal
    /// (Joshy & Supriya 2016; the choice of the diagonal is a reading).
    Six,
    /// All steps.
    #[default]
    Eight,
}

impl Parameters for Directions {}
