//! The problem that an evolution solves: a grid, a shortest path over it, and the vehicle.

use crate::map::{BitGrid, Cell, DiagonalRule, MoveMasks};
use crate::search::{GridSearch, SearchError, check_end};

/// Start and goal on a grid with its allowed moves.
#[derive(Clone, Debug)]
pub struct EvolutionProblem<'a> {
    pub(super) moves: &'a MoveMasks,
    /// A shortest path over cells.
    pub(super) shortest: &'a GridSearch,
    pub(super) start: Cell,
    pub(super) goal: Cell,
    /// Side of a cell, meters.
    pub(super) resolution_m: f64,
    /// The start heading in the frame of the grid; none if it is free.
    pub(super) start_heading_rad: Option<f64>,
    /// Wheelbase in meters and largest steering in radians.
    pub(super) steering: [f64; 2],
}

impl<'a> EvolutionProblem<'a> {
    /// From the first to the last cell of a shortest path, on cells of a side in meters.
    ///
    /// The vehicle is its wheelbase in meters and its largest steering in radians, both positive.
    ///
    /// # Errors
    /// An end off the map or blocked, or a path without cells.
    pub fn new(
        moves: &'a MoveMasks,
        shortest: &'a GridSearch,
        resolution_m: f64,
        steering: [f64; 2],
    ) -> Result<Self, SearchError> {
        let cells = &shortest.path.cells;
        let (Some(&start), Some(&goal)) = (cells.first(), cells.last()) else {
            return Err(crate::progress::Status::NoPath.into());
        };
        check_end(moves, "start", start)?;
        check_end(moves, "goal", goal)?;
        Ok(Self {
            moves,
            shortest,
            start,
            goal,
            resolution_m,
            start_heading_rad: None,
            steering,
        })
    }

    /// The same with a heading, in the frame of the grid, from which the first step turns.
    #[must_use]
    pub fn with_start_heading(self, start_heading_rad: Option<f64>) -> Self {
        Self {
            start_heading_rad,
            ..self
        }
    }

    pub(super) fn blocked(&self) -> &'a BitGrid {
        self.moves.blocked()
    }

    pub(super) fn rule(&self) -> DiagonalRule {
        self.moves.rule()
    }

    /// `L_ref`: length of the shortest path, at least a cell, meters.
    pub(super) fn reference_m(&self) -> f64 {
        self.shortest.length_cells().max(1.0) * self.resolution_m
    }
}
