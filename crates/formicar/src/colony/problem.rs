//! The problem that a colony solves: a path from start to goal.

use super::directions::Directions;
use crate::map::{Cell, MoveMasks};
use crate::search::{SearchError, check_end};

/// Start and goal on a grid with its allowed moves.
#[derive(Clone, Debug)]
pub struct ColonyProblem {
    moves: MoveMasks,
    start: Cell,
    goal: Cell,
}

impl ColonyProblem {
    /// Cells that ants may reach at most: a colony takes about 120 bytes for each.
    pub const MAX_CELLS: usize = 4_000_000;

    /// A problem on allowed moves; the configuration's diagonal rule should have made them.
    pub fn new(moves: MoveMasks, start: Cell, goal: Cell) -> Self {
        Self { moves, start, goal }
    }

    /// The allowed moves.
    pub fn moves(&self) -> &MoveMasks {
        &self.moves
    }

    /// The cell where the ants start.
    pub fn start(&self) -> Cell {
        self.start
    }

    /// The cell that they look for.
    pub fn goal(&self) -> Cell {
        self.goal
    }

    /// Checks that ants can stand on start and goal.
    pub(super) fn check_ends(&self) -> Result<(), SearchError> {
        check_end(&self.moves, "start", self.start)?;
        check_end(&self.moves, "goal", self.goal)
    }

    /// Columns and rows from a cell to the goal.
    pub(super) fn to_goal(&self, cell: Cell) -> (i64, i64) {
        let difference = |a: u32, b: u32| i64::from(a) - i64::from(b);
        (
            difference(self.goal.col, cell.col),
            difference(self.goal.row, cell.row),
        )
    }

    /// The steps of a configuration, a bit each.
    pub(super) fn directions(&self, directions: Directions) -> u8 {
        let (dx, dy) = self.to_goal(self.start);
        match directions {
            Directions::Four => 0b0101_0101,
            Directions::Six if dx * dy >= 0 => 0b0111_0111,
            Directions::Six => 0b1101_1101,
            Directions::Eight => u8::MAX,
        }
    }
}
