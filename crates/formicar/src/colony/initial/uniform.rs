//! The same pheromone everywhere.

use super::PheromoneUnit;
use crate::numeric::{OutOfRange, check_range};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// tau0 everywhere (Dorigo, Maniezzo & Colorni 1996).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Uniform {
    /// Pheromone, from 1e-6 to 1e6 units.
    #[schemars(range(min = 1e-6, max = 1e6))]
    pub tau: f64,
    /// What a unit is.
    pub unit: PheromoneUnit,
}

impl Default for Uniform {
    fn default() -> Self {
        Self {
            tau: 1.0,
            unit: PheromoneUnit::Deposit,
        }
    }
}

impl Uniform {
    pub(super) fn check(&self) -> Result<(), OutOfRange> {
        check_range("colony.initial.tau", self.tau, 1e-6..=1e6)
    }
}
