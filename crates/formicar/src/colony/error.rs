//! Errors of colonies.

use crate::parameters::OutOfRange;
use crate::progress::Status;
use crate::search::SearchError;
use crate::vehicle::VehicleError;
use thiserror::Error;

/// Why a colony did not run.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum RunError {
    /// A parameter is out of its range.
    #[error(transparent)]
    Config(#[from] OutOfRange),
    /// Start or goal lies off the map or on a blocked cell, or the goal field was cut short.
    #[error(transparent)]
    Search(#[from] SearchError),
    /// A vehicle that cannot have the margin asked for.
    #[error(transparent)]
    Vehicle(#[from] VehicleError),
    /// More cells to reach than [`ColonyProblem::MAX_CELLS`](super::ColonyProblem::MAX_CELLS).
    #[error(
        "a colony works on at most {max} cells, of the map's {n_cells} its ants can reach more; hint: colony.corridor.rule=\"ratio\", or a coarser resolution"
    )]
    TooLarge {
        /// Cells of the map.
        n_cells: usize,
        /// Cells that ants may reach.
        max: usize,
    },
}

impl From<Status> for RunError {
    fn from(status: Status) -> Self {
        Self::Search(status.into())
    }
}
