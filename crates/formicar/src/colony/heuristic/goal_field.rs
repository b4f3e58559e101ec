//! Guidance by the length of the shortest way to the goal (Wang 2019).

use super::LogDesire;
use crate::numeric::{OutOfRange, check_range};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// lambda = 1 / max(S, floor) with the length S of the shortest allowed way from the cell to the
/// goal, in cells: Wang 2019 (9).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct GoalFieldGuidance {
    /// Exponent of lambda, from 0 to 100.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub gamma: f64,
    /// The least length that counts, in cells, from 0.01 to 100.
    #[schemars(range(min = 0.01, max = 100.0))]
    pub floor_cells: f64,
}

impl Default for GoalFieldGuidance {
    fn default() -> Self {
        Self {
            gamma: 3.0,
            floor_cells: 0.5,
        }
    }
}

impl GoalFieldGuidance {
    pub(super) fn check(&self) -> Result<(), OutOfRange> {
        check_range("colony.guidance.gamma", self.gamma, 0.0..=100.0)?;
        check_range(
            "colony.guidance.floor_cells",
            self.floor_cells,
            0.01..=100.0,
        )
    }

    pub(super) fn add_to(&self, desire: &mut LogDesire, costs_to_go: &[f64]) {
        for (log, cost) in desire.cells.iter_mut().zip(costs_to_go) {
            *log += self.log_factor(*cost);
        }
    }

    pub(super) fn log_factor(&self, cost_to_go: f64) -> f64 {
        -self.gamma * cost_to_go.max(self.floor_cells).ln()
    }
}
