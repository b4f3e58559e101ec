//! Pheromone before the first generation.

use crate::numeric::{OutOfRange, check_range};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// tau0 = n c on the cells of a shortest path over cells, c elsewhere (Li 2024, equation 21).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct PathSeed {
    /// c: pheromone off the path, from 1e-6 to 1e6.
    pub tau: f64,
    /// n: how many times as much lies on the path, from 1 to 1e6; 1 seeds nothing.
    pub factor: f64,
}

impl Default for PathSeed {
    fn default() -> Self {
        Self {
            tau: 1.0,
            factor: 5.0,
        }
    }
}

impl PathSeed {
    pub(super) fn check(&self) -> Result<(), OutOfRange> {
        check_range("chords.initial.tau", self.tau, 1e-6..=1e6)?;
        check_range("chords.initial.factor", self.factor, 1.0..=1e6)
    }
}
