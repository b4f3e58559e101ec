//! The record of a population's generation.

use super::IterationRecord;
use crate::map::Cell;

/// A population at the end of a generation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PopulationView<'a> {
    /// Its numbers.
    pub record: &'a IterationRecord,
    /// Its polylines, each from start to goal.
    pub lines: &'a [Vec<Cell>],
    /// One flag each, true if it is free of collisions.
    pub is_free: &'a [bool],
    /// Cost and penalty of each.
    pub fitness: &'a [f64],
    /// The cheapest that is free of collisions; none if none is.
    pub best: Option<usize>,
}
