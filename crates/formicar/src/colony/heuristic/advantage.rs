//! Guidance by what a step saves: the same at every distance from the goal.

use super::{LogDesire, step_length};
use crate::numeric::{OutOfRange, check_range};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// exp(-beta (c + S' - S)): a step of length c from a cell at S to one at S', where S is the
/// length of the shortest allowed way to the goal, in cells.
///
/// A step along a shortest way has weight 1, any other less by its detour. Powers of 1 / S, in
/// contrast, hardly tell neighbors apart far from the goal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Advantage {
    /// Weight of a cell of detour, from 0 to 100.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub beta: f64,
}

impl Default for Advantage {
    fn default() -> Self {
        Self { beta: 2.0 }
    }
}

impl Advantage {
    pub(super) fn check(&self) -> Result<(), OutOfRange> {
        check_range("colony.guidance.beta", self.beta, 0.0..=100.0)
    }

    pub(super) fn add_to(&self, desire: &mut LogDesire, costs_to_go: &[f64]) {
        // S is the same for all steps from a cell, and an ant compares no others.
        for (log, cost) in desire.cells.iter_mut().zip(costs_to_go) {
            *log -= self.beta * cost;
        }
        for (step, log) in desire.steps.iter_mut().enumerate() {
            *log -= self.beta * step_length(step);
        }
    }
}
