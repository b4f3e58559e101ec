//! Errors of colonies.

use crate::numeric::OutOfRange;
use crate::search::SearchError;
use crate::vehicle::VehicleError;
use thiserror::Error;

/// An invalid configuration of a colony.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum ColonyError {
    /// A parameter outside its range.
    #[error(transparent)]
    OutOfRange(#[from] OutOfRange),
    /// An evaporation that would leave its range.
    #[error(
        "colony.evaporation: rho is {rho} at iteration {iteration}; it must be above 0 and below 1; hint: change amplitude or offset"
    )]
    Evaporation {
        /// The first iteration at which it does.
        iteration: u32,
        /// The share that would evaporate.
        rho: f64,
    },
}

/// Why a colony did not run.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum RunError {
    /// A parameter is out of its range.
    #[error(transparent)]
    Config(#[from] ColonyError),
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
