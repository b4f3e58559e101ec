//! The one door: a map, a vehicle and a configuration in, certified paths out.

mod answer;
mod ants;
mod cells;
mod chords;
mod config;
mod continuous;
mod curve;
mod evolve;
mod explain;
mod outcome;
mod path_document;
mod request_document;
mod run;
mod sections;

pub use crate::search::{HybridAstarConfig, ImprovedAstarConfig};
pub use answer::{
    ANSWER_SCHEMA, Answer, AnswerContext, AnswerError, CertificateHashes, CertificateNumbers,
    ColonyRecord, MapRecord, Provenance, StoredPath, Timing, VehicleRecord,
};
pub use config::{ConfigError, GridSearchConfig, PlannerConfig, PlannerName};
pub use outcome::{NotFound, Outcome, Plan, PlanError, Stages};
pub use path_document::{POSE_SPACING_M, PathDocument, PoseRecord, SegmentRecord};
pub use request_document::RequestDocument;

use crate::collision::ObstacleMap;
use crate::map::OccupancyGrid;
use crate::numeric::Seed;
use crate::progress::{Limits, Observer};
use crate::scenario::{Request, Scenario};
use crate::vehicle::Vehicle;
use std::sync::Arc;

/// A planner that keeps what it has prepared: ask it as often as you like.
#[derive(Clone, Debug)]
pub struct Planner {
    obstacles: Arc<ObstacleMap>,
    vehicle: Vehicle,
    config: PlannerConfig,
    n_threads: usize,
    /// What searches over cells prepare and reuse.
    cells: Option<cells::PreparedCells>,
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
            n_threads: 1,
            cells: None,
        })
    }

    /// The same planner on at most so many threads; the result never depends on it. Colonies use
    /// them, everything else runs on one.
    #[must_use]
    pub fn with_threads(self, n_threads: usize) -> Self {
        Self { n_threads, ..self }
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
    /// A request that cannot be asked on this map, or a deadline without a clock. Ending without
    /// a path is no error.
    pub fn plan(
        &mut self,
        request: &Request,
        seed: Seed,
        observer: &mut dyn Observer,
    ) -> Result<Outcome, PlanError> {
        request.check(&self.obstacles, &self.vehicle)?;
        if request.deadline.is_some() && observer.elapsed().is_none() {
            return Err(PlanError::DeadlineWithoutClock);
        }
        let mut limits = Limits::new(observer, request.budget_steps, request.deadline);
        let found = match self.search(request, seed, &mut limits)? {
            Ok(found) => self.made_continuous(request, seed, found, &mut limits)?,
            Err(ended) => Err(ended),
        };
        Ok(self.conclude(request, seed, found, &mut limits))
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
