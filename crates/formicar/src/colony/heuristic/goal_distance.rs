//! Visibility as nearness to the goal: eta = 1 / distance.

use super::LogDesire;
use crate::colony::ColonyProblem;
use crate::numeric::{OutOfRange, check_range};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// eta = 1 / max(d, floor) with the straight distance d from the cell to the goal, in cells.
///
/// The reading of Lei & Zheng 2020 (2) (floor 1) and of Wang 2019 (8) (floor 0.5); the papers
/// leave eta open.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct GoalDistance {
    /// Exponent of eta, from 0 to 100.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub beta: f64,
    /// The least distance that counts, in cells, from 0.01 to 100.
    #[schemars(range(min = 0.01, max = 100.0))]
    pub floor_cells: f64,
}

impl Default for GoalDistance {
    fn default() -> Self {
        Self {
            beta: 1.0,
            floor_cells: 1.0,
        }
    }
}

impl GoalDistance {
    pub(super) fn check(&self) -> Result<(), OutOfRange> {
        check_range("colony.visibility.beta", self.beta, 0.0..=100.0)?;
        check_range(
            "colony.visibility.floor_cells",
            self.floor_cells,
            0.01..=100.0,
        )
    }

    pub(super) fn add_to(&self, desire: &mut LogDesire, problem: &ColonyProblem, cells: &[u32]) {
        let (moves, goal) = (problem.moves(), problem.goal());
        let (goal_col, goal_row) = (f64::from(goal.col), f64::from(goal.row));
        for (log, &index) in desire.cells.iter_mut().zip(cells) {
            let cell = moves.cell(index as usize);
            let (dx, dy) = (
                f64::from(cell.col) - goal_col,
                f64::from(cell.row) - goal_row,
            );
            *log -= self.beta * dx.hypot(dy).max(self.floor_cells).ln();
        }
    }
}
