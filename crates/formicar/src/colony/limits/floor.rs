//! No less pheromone than a share of what there was at first.

use crate::numeric::{OutOfRange, check_range};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// tau >= `share` tau0, with the least initial pheromone tau0.
///
/// A reading that Wang 2019 (10) needs: its penalty would make pheromone negative.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Floor {
    /// Share of the initial pheromone, from 0 to 1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub share: f64,
}

impl Default for Floor {
    fn default() -> Self {
        Self { share: 1e-3 }
    }
}

impl Floor {
    pub(super) fn check(&self) -> Result<(), OutOfRange> {
        check_range("colony.limits.share", self.share, 0.0..=1.0)
    }
}
