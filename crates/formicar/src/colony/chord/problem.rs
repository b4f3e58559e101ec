//! The problem that a colony of chords solves: a map, a vehicle, start and goal.

use crate::collision::ObstacleMap;
use crate::geometry::Pose2;
use crate::map::{Cell, MoveMasks};
use crate::vehicle::Vehicle;

/// A vehicle on a map, its start and goal, and the grid on which shortest paths guide the ants.
#[derive(Clone, Copy, Debug)]
pub struct ChordProblem<'a> {
    /// The map.
    pub obstacles: &'a ObstacleMap,
    /// Who drives.
    pub vehicle: &'a Vehicle,
    /// Moves over cells, on obstacles grown so that the vehicle fits.
    pub moves: &'a MoveMasks,
    /// The start, grid coordinates.
    pub start: Pose2,
    /// Whether the first step turns from the start's heading.
    pub start_heading_is_exact: bool,
    /// The goal, a cell.
    pub goal: Cell,
}

impl ChordProblem<'_> {
    /// The cell of the start.
    pub(super) fn start_cell(&self) -> Cell {
        let scale = 1.0 / self.obstacles.frame().resolution_m();
        Cell::new((self.start.x * scale) as u32, (self.start.y * scale) as u32)
    }
}
