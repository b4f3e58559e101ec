//! Planning over cells: a shortest path on grown obstacles, made drivable.

use super::curve::Origin;
use super::run::{Ended, Found};
use super::{PlanError, Planner, PlannerName, Stages};
use crate::layers::nearest_open;
use crate::map::{BitGrid, Cell, MoveMasks};
use crate::progress::{Event, Limits, Status};
use crate::scenario::Request;
use crate::search::{AstarWorkspace, GoalField, GridSearch, SearchError, astar, improved_astar};
use crate::vehicle::Motion;

/// What searches over cells prepare once and reuse from query to query.
#[derive(Clone, Debug)]
pub(super) struct PreparedCells {
    /// Moves on obstacles grown by half the vehicle's width.
    pub(super) moves: MoveMasks,
    pub(super) workspace: AstarWorkspace,
}

impl Planner {
    /// Searches over cells, and makes the path drivable.
    pub(super) fn walk(
        &mut self,
        request: &Request,
        limits: &mut Limits,
    ) -> Result<Result<Found, Ended>, PlanError> {
        self.with_cells(|planner, cells| {
            let ends = match planner.open_ends(request, cells.moves.blocked()) {
                Ok(ends) => ends,
                Err(ended) => return Ok(Err(ended)),
            };
            limits.tell(&Event::SearchStarted);
            let found = match planner.search_cells(cells, ends, limits) {
                Ok(found) => found,
                Err(SearchError::Ended { status }) => return Ok(Err(status.into())),
                Err(error) => return Err(PlanError::Search(error)),
            };
            let origin = planner.origin(cells.moves.blocked(), found.path.cells.len(), "cells");
            let stages = Stages {
                grid_path: Some(found.path.clone()),
                ..Stages::default()
            };
            Ok(planner.curve_of(request, stages, &found.path, &origin))
        })
    }

    /// Lends what searches over cells reuse.
    pub(super) fn with_cells<R>(&mut self, body: impl FnOnce(&Self, &mut PreparedCells) -> R) -> R {
        let mut cells = self.cells.take().unwrap_or_else(|| PreparedCells {
            moves: MoveMasks::new(&self.grown(), self.config.grid_search.diagonal_rule),
            workspace: AstarWorkspace::new(),
        });
        let result = body(self, &mut cells);
        self.cells = Some(cells);
        result
    }

    fn search_cells(
        &self,
        cells: &mut PreparedCells,
        [start, goal]: [Cell; 2],
        limits: &mut Limits,
    ) -> Result<GridSearch, SearchError> {
        let PreparedCells { moves, workspace } = cells;
        match self.config.planner {
            PlannerName::Dijkstra => GoalField::new(moves, &[goal], limits)?.path(moves, start),
            PlannerName::ImprovedAstar => {
                let config = &self.config.improved_astar;
                improved_astar(moves, [start, goal], config, workspace, limits)
            }
            _ => astar(moves, start, goal, workspace, limits),
        }
    }

    /// The story of a way that this planner found.
    pub(super) fn origin<'a>(
        &self,
        blocked: &'a BitGrid,
        n_places: usize,
        places: &str,
    ) -> Origin<'a> {
        let name = self.config.planner.name();
        Origin {
            blocked,
            rule: self.config.grid_search.diagonal_rule,
            found: format!("{name} found a way of {n_places} {places}"),
            hint: "hybrid-astar searches over what the car can drive",
        }
    }

    /// The cells of start and goal or, where a grown obstacle covers them, the nearest open ones:
    /// the body is free there, but it may be shorter behind its axle than wide.
    pub(super) fn open_ends(
        &self,
        request: &Request,
        blocked: &BitGrid,
    ) -> Result<[Cell; 2], Ended> {
        let frame = self.obstacles.frame();
        let radius = 2 * self.growth_cells().ceil() as u32 + 1;
        let open = |end: &str, pose: crate::geometry::Pose2| {
            let cell = frame.cell_at(pose.position()).unwrap_or_default();
            nearest_open(blocked, cell, radius).ok_or_else(|| {
                let reason = format!(
                    "no cell within {radius} cells of the {end} is open after obstacles are grown by half the width; hint: hybrid-astar uses the true footprint"
                );
                Ended::because(Status::NoPath, reason, Stages::default())
            })
        };
        Ok([open("start", request.start)?, open("goal", request.goal)?])
    }

    /// Cells on which the vehicle's middle may not be: nearer to an obstacle's square than half its
    /// width, which is half a cell more from center to center. For a point, obstacles.
    fn grown(&self) -> BitGrid {
        let grown = self.obstacles.distance().within(self.growth_cells());
        grown.unwrap_or_else(|| self.obstacles.lethal().clone())
    }

    /// How far obstacles are grown from center to center, at most what the distance transform can
    /// tell.
    pub(super) fn growth_cells(&self) -> f64 {
        if self.vehicle.motion() == Motion::Point {
            return 0.0;
        }
        let limit = f64::from(self.obstacles.distance().truncation_cells()) - 0.5;
        let half_width_cells = 0.5 * self.vehicle.width_m() / self.obstacles.frame().resolution_m();
        (half_width_cells + 0.5).min(limit)
    }
}
