//! Guidance by what a step saves: the same at every distance from the goal.

use super::desire::{LogDesire, step_length};
use crate::parameters::parameters;

parameters! {
    /// exp(-beta (c + S' - S)): a step of length c from a cell at S to one at S', where S is the
    /// length of the shortest allowed way to the goal, in cells.
    ///
    /// A step along a shortest way has weight 1, any other less by its detour. Powers of 1 / S, in
    /// contrast, hardly tell neighbors apart far from the goal.
    pub struct Advantage {
        /// β: weight of a cell of detour.
        #[range(0.0..=100.0)]
        pub beta: f64 = 2.0,
    }
}

impl Advantage {
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
