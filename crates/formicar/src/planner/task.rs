//! The task of a search: a request, and the prepared map on which it is asked.

use super::door;
use super::prepared::{PreparedCells, PreparedMap};
use super::{Ended, Found, Halt, PathSearch, Stages};
use crate::collision::ObstacleMap;
use crate::geometry::{Arc, Pose2};
use crate::layers::{SoftCosts, nearest_open};
use crate::map::{BitGrid, Cell, DiagonalRule};
use crate::numeric::Seed;
use crate::path::CurvePath;
use crate::progress::{Limits, Status};
use crate::scenario::{Request, StartHeading};
use crate::search::{DrivableMap, HybridAstarConfig};
use crate::vehicle::{Vehicle, VehicleError};
use std::sync;

/// A request on a prepared map, for a [`PathSearch`].
#[derive(Debug)]
pub struct Task<'a> {
    pub(super) search: &'a dyn PathSearch,
    pub(super) request: &'a Request,
    pub(super) seed: Seed,
    pub(super) n_threads: usize,
    pub(super) soft_costs: Option<&'a SoftCosts>,
    pub(super) map: &'a mut PreparedMap,
}

impl<'a> Task<'a> {
    /// The name of the planner that is asked.
    pub fn planner(&self) -> &'a str {
        self.search.name()
    }

    /// The request, checked against map and vehicle; world coordinates.
    pub fn request(&self) -> &'a Request {
        self.request
    }

    /// The seed of all random numbers.
    pub fn seed(&self) -> Seed {
        self.seed
    }

    /// Threads that may be used; no result may depend on their number.
    pub fn n_threads(&self) -> usize {
        self.n_threads
    }

    /// A preference for some ground over other.
    pub fn soft_costs(&self) -> Option<&'a SoftCosts> {
        self.soft_costs
    }

    /// The prepared map: occupied cells, distances, exact clearance.
    pub fn obstacles(&self) -> &sync::Arc<ObstacleMap> {
        &self.map.obstacles
    }

    /// The vehicle.
    pub fn vehicle(&self) -> &Vehicle {
        &self.map.vehicle
    }

    /// A pose in the coordinates of the grid, meters from its lower left corner.
    pub fn to_grid(&self, pose: Pose2) -> Pose2 {
        self.obstacles().frame().to_grid(pose)
    }

    /// The map prepared for the vehicle's motions: made at the first call, kept from query to
    /// query, repaired where cells change.
    ///
    /// # Errors
    /// A vehicle that does not steer.
    pub fn drive_ground(
        &mut self,
        config: &HybridAstarConfig,
    ) -> Result<sync::Arc<DrivableMap>, VehicleError> {
        self.map.drive_ground(config)
    }

    /// Lends moves over cells on obstacles grown by half the vehicle's width, kept from query to
    /// query.
    pub fn with_cells<R>(
        &mut self,
        rule: DiagonalRule,
        work: impl FnOnce(&Self, &mut PreparedCells) -> R,
    ) -> R {
        let mut cells = self.map.take_cells(rule);
        let result = work(self, &mut cells);
        self.map.keep_cells(cells);
        result
    }

    /// The cells of start and goal or, where a grown obstacle covers them, the nearest open ones:
    /// the body is free there, but it may be shorter behind its axle than wide.
    ///
    /// # Errors
    /// No open cell near an end.
    pub fn open_ends(&self, blocked: &BitGrid) -> Result<[Cell; 2], Ended> {
        self.open_ends_of(self.request, blocked)
    }

    /// The same for another request.
    pub(super) fn open_ends_of(
        &self,
        request: &Request,
        blocked: &BitGrid,
    ) -> Result<[Cell; 2], Ended> {
        let frame = self.obstacles().frame();
        let radius = 2 * self.map.growth_cells().ceil() as u32 + 1;
        let open = |end: &str, pose: Pose2| {
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

    /// A path of arcs driven from a start pose in grid coordinates, which is the request's start
    /// or, where its heading is free, turned on the spot.
    pub fn driven(&self, start: Pose2, arcs: &[Arc]) -> Found {
        let start = match self.request.start_heading {
            StartHeading::Exact => self.request.start,
            StartHeading::Any => self.obstacles().frame().to_world(start).wrapped(),
        };
        Found::new(CurvePath::from_arcs(start, arcs), Stages::default())
    }

    /// Plans past the via points of the request, leg by leg, with the search that is asked.
    ///
    /// # Errors
    /// As [`PathSearch::find`]; the reason names the leg.
    pub fn find_past_via_points(&mut self, limits: &mut Limits) -> Result<Found, Halt> {
        door::find_legs(self, limits)
    }

    /// The same task for another request.
    pub(super) fn asking<'b>(&'b mut self, request: &'b Request) -> Task<'b> {
        Task {
            request,
            map: self.map,
            ..*self
        }
    }

    /// The same task on another prepared map.
    pub(super) fn on<'b>(&'b self, map: &'b mut PreparedMap) -> Task<'b> {
        Task { map, ..*self }
    }
}
