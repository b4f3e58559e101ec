//! The one door: a map, a vehicle and a configuration in, certified paths out.

mod config;
mod outcome;

pub use config::{ConfigError, GridSearchConfig, HybridAstarConfig, PlannerConfig, PlannerName};
pub use outcome::{NotFound, Outcome, Plan, PlanError};

use crate::collision::ObstacleMap;
use crate::map::OccupancyGrid;
use crate::numeric::Seed;
use crate::progress::Observer;
use crate::scenario::{Request, Scenario};
use crate::vehicle::Vehicle;
use std::sync::Arc;

/// A planner that keeps what it has prepared: ask it as often as you like.
#[derive(Clone, Debug)]
pub struct Planner {
    obstacles: Arc<ObstacleMap>,
    vehicle: Vehicle,
    config: PlannerConfig,
}

impl Planner {
    /// Prepares a map for a vehicle: the map set-up.
    ///
    /// # Errors
    /// A configuration outside its ranges.
    pub fn new(
        map: &OccupancyGrid,
        vehicle: Vehicle,
        config: PlannerConfig,
    ) -> Result<Self, PlanError> {
        Self::on(Arc::new(ObstacleMap::new(map)), vehicle, config)
    }

    /// A planner on a map that is prepared already.
    ///
    /// # Errors
    /// A configuration outside its ranges.
    pub fn on(
        obstacles: Arc<ObstacleMap>,
        vehicle: Vehicle,
        config: PlannerConfig,
    ) -> Result<Self, PlanError> {
        config.check()?;
        Ok(Self {
            obstacles,
            vehicle,
            config,
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

    /// Plans one request. Same map, vehicle, configuration, request and seed: same path.
    ///
    /// # Errors
    /// A request that cannot be asked on this map. Ending without a path is no error.
    pub fn plan(
        &mut self,
        request: &Request,
        seed: Seed,
        observer: &mut dyn Observer,
    ) -> Result<Outcome, PlanError> {
        let _ = (seed, observer);
        request.check(&self.obstacles, &self.vehicle)?;
        unimplemented!("search is on its way")
    }
}

/// Plans one scenario with a planner made for it.
///
/// # Errors
/// As [`Planner::new`] and [`Planner::plan`].
pub fn plan(
    scenario: &Scenario,
    config: &PlannerConfig,
    seed: Seed,
    observer: &mut dyn Observer,
) -> Result<Outcome, PlanError> {
    Planner::on(
        scenario.obstacles().clone(),
        scenario.vehicle().clone(),
        config.clone(),
    )?
    .plan(scenario.request(), seed, observer)
}
