//! The result of a run of a colony.

use crate::path::GridPath;
use crate::progress::{History, Stop};

/// The result of a run of a colony.
#[derive(Clone, Debug)]
pub struct ColonyRun {
    /// The cheapest path of all ants; none if no ant arrived.
    pub best: Option<GridPath>,
    /// The paths that were the cheapest before it, the latest first.
    pub earlier: Vec<GridPath>,
    /// All iterations.
    pub history: History,
    /// Why the colony stopped.
    pub stop: Stop,
    /// Pheromone at the end by cell, row by row; not a number where no ant can go.
    pub pheromone: Vec<f32>,
}
