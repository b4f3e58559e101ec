//! Results and errors of searches on a grid.

use super::cost::{DIAGONAL_COST, MAX_COST, STRAIGHT_COST};
use crate::map::{Cell, MoveMasks};
use crate::parameters::OutOfRange;
use crate::path::GridPath;
use crate::progress::Status;
use std::f64::consts::SQRT_2;
use thiserror::Error;

/// A shortest path from cell to cell.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct GridSearch {
    /// The cells from start to goal.
    pub path: GridPath,
    /// Straight steps.
    pub n_straight: u64,
    /// Diagonal steps.
    pub n_diagonal: u64,
}

impl GridSearch {
    /// Length between cell centers, cells.
    pub fn length_cells(&self) -> f64 {
        self.n_straight as f64 + SQRT_2 * self.n_diagonal as f64
    }

    /// Cost in units of [`STRAIGHT_COST`].
    pub fn cost(&self) -> u64 {
        u64::from(STRAIGHT_COST) * self.n_straight + u64::from(DIAGONAL_COST) * self.n_diagonal
    }

    /// Counts one more step by its place in [`STEPS`](crate::map::STEPS).
    pub(super) fn count_step(&mut self, step: usize) {
        let is_diagonal = step as u64 % 2;
        self.n_diagonal += is_diagonal;
        self.n_straight += 1 - is_diagonal;
    }
}

/// The reason why a search on a grid has no result.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SearchError {
    /// An end off the grid.
    #[error("{end} cell ({}, {}) is off the map of {n_cols} x {n_rows} cells", cell.col, cell.row)]
    OffMap {
        /// "start" or "goal".
        end: &'static str,
        /// The cell given.
        cell: Cell,
        /// Columns of the map.
        n_cols: usize,
        /// Rows of the map.
        n_rows: usize,
    },
    /// An end on a blocked cell.
    #[error("{end} cell ({}, {}) is blocked; hint: move it or inflate obstacles by less", cell.col, cell.row)]
    Blocked {
        /// "start" or "goal".
        end: &'static str,
        /// The cell given.
        cell: Cell,
    },
    /// Costs beyond 32 bits.
    #[error(
        "some path is longer than {max_cells} cells, the limit of the search; hint: use a coarser resolution"
    )]
    TooLong {
        /// The limit in straight steps.
        max_cells: u32,
    },
    /// A parameter outside its range.
    #[error(transparent)]
    OutOfRange(#[from] OutOfRange),
    /// The search ended without a path.
    #[error("the search ended: {}", status.name())]
    Ended {
        /// No path, budget, deadline or cancel.
        status: Status,
    },
}

impl SearchError {
    /// The status of a search that ended without a path; none for invalid input.
    pub fn status(&self) -> Option<Status> {
        match self {
            Self::Ended { status } => Some(*status),
            _ => None,
        }
    }

    pub(super) const TOO_LONG: Self = Self::TooLong {
        max_cells: MAX_COST / STRAIGHT_COST,
    };
}

impl From<Status> for SearchError {
    fn from(status: Status) -> Self {
        Self::Ended { status }
    }
}

/// Checks that a cell lies on the map and is not blocked.
pub(crate) fn check_end(
    moves: &MoveMasks,
    end: &'static str,
    cell: Cell,
) -> Result<(), SearchError> {
    let (n_cols, n_rows) = (moves.n_cols(), moves.n_rows());
    let (col, row) = (cell.col as usize, cell.row as usize);
    if col >= n_cols || row >= n_rows {
        return Err(SearchError::OffMap {
            end,
            cell,
            n_cols,
            n_rows,
        });
    }
    if moves.blocked().get(col, row) {
        return Err(SearchError::Blocked { end, cell });
    }
    Ok(())
}
