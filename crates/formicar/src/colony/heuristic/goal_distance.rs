//! Visibility as nearness to the goal: eta = 1 / distance.

use super::desire::LogDesire;
use crate::colony::ColonyProblem;
use crate::parameters::parameters;
use crate::progress::{Limits, Status};

parameters! {
    /// eta = 1 / max(d, floor) with the straight distance d from the cell to the goal, in cells.
    ///
    /// The reading of Lei & Zheng 2020 (2) (floor 1) and of Wang 2019 (8) (floor 0.5); the papers
    /// leave eta open.
    pub struct GoalDistance {
        /// β: exponent of η.
        #[range(0.0..=100.0)]
        pub beta: f64 = 1.0,
        /// The least distance that counts, in cells.
        #[range(0.01..=100.0)]
        pub floor_cells: f64 = 1.0,
    }
}

impl GoalDistance {
    pub(super) fn add_to(
        &self,
        desire: &mut LogDesire,
        problem: &ColonyProblem,
        cells: &[u32],
        limits: &mut Limits,
    ) -> Result<(), Status> {
        let (moves, goal) = (problem.moves(), problem.goal());
        let (goal_col, goal_row) = (f64::from(goal.col), f64::from(goal.row));
        for (log, &index) in desire.cells.iter_mut().zip(cells) {
            limits.step()?;
            let cell = moves.cell(index as usize);
            let (dx, dy) = (
                f64::from(cell.col) - goal_col,
                f64::from(cell.row) - goal_row,
            );
            *log -= self.beta * dx.hypot(dy).max(self.floor_cells).ln();
        }
        Ok(())
    }
}
