//! Guidance by the length of the shortest way to the goal (Wang 2019).

use super::desire::LogDesire;
use crate::parameters::parameters;
use crate::progress::{Limits, Status};

parameters! {
    /// lambda = 1 / max(S, floor) with the length S of the shortest allowed way from the cell to
    /// the goal, in cells: Wang 2019 (9).
    pub struct GoalFieldGuidance {
        /// γ: exponent of λ.
        #[range(0.0..=100.0)]
        pub gamma: f64 = 3.0,
        /// The least length that counts, in cells.
        #[range(0.01..=100.0)]
        pub floor_cells: f64 = 0.5,
    }
}

impl GoalFieldGuidance {
    pub(super) fn add_to(
        &self,
        desire: &mut LogDesire,
        costs_to_go: &[f64],
        limits: &mut Limits,
    ) -> Result<(), Status> {
        for (log, cost) in desire.cells.iter_mut().zip(costs_to_go) {
            limits.step()?;
            *log += self.log_factor(*cost);
        }
        Ok(())
    }

    pub(super) fn log_factor(&self, cost_to_go: f64) -> f64 {
        -self.gamma * cost_to_go.max(self.floor_cells).ln()
    }
}
