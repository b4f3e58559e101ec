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
mod explanation;
mod goals;
mod improve;
mod outcome;
mod path_document;
mod race;
mod replan;
mod request_document;
mod run;
mod sealed;
mod sections;
mod stored_path;
mod update;
mod via;
mod via_record;

pub use crate::search::{HybridAstarConfig, ImprovedAstarConfig};
pub use answer::{
    ANSWER_SCHEMA, Answer, AnswerContext, ColonyRecord, MapRecord, Provenance, SoftCostsRecord,
    Timing, VehicleRecord,
};
pub use config::{ConfigError, GridSearchConfig, PlannerConfig, PlannerName};
pub use explanation::{Collision, Disconnected, Explanation, Gap};
pub use outcome::{NotFound, Outcome, Plan, PlanError, Stages};
pub use path_document::{POSE_SPACING_M, PathDocument, PoseRecord, SegmentRecord};
pub use replan::ReplanConfig;
pub use request_document::RequestDocument;
pub use stored_path::{AnswerError, CertificateHashes, CertificateNumbers, StoredPath};
pub use via_record::ViaRecord;

use crate::collision::ObstacleMap;
use crate::layers::SoftCosts;
use crate::map::OccupancyGrid;
use crate::numeric::Seed;
use crate::progress::{Limits, Observer};
use crate::scenario::{Request, Scenario};
use crate::search::DrivableMap;
use crate::vehicle::Vehicle;
use std::sync::Arc;

/// A planner that keeps what it has prepared: ask it as often as you like.
#[derive(Clone, Debug)]
pub struct Planner {
    obstacles: Arc<ObstacleMap>,
    vehicle: Vehicle,
    config: PlannerConfig,
    n_threads: usize,
    /// Where the vehicle should rather not drive.
    soft_costs: Option<Arc<SoftCosts>>,
    /// What searches over cells prepare and reuse.
    cells: Option<cells::PreparedCells>,
    /// What searches that drive prepare and reuse.
    drive_ground: Option<Arc<DrivableMap>>,
    /// Which parts of the ground hang together for the vehicle's rear axle.
    axle_ground: Option<Arc<sealed::AxleGround>>,
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
            soft_costs: None,
            cells: None,
            drive_ground: None,
            axle_ground: None,
        })
    }

    /// The same planner on at most so many threads; the result never depends on it. Colonies use
    /// them, everything else runs on one.
    #[must_use]
    pub fn with_threads(self, n_threads: usize) -> Self {
        Self { n_threads, ..self }
    }

    /// The same planner with a preference for some ground over other, brought onto the frame of
    /// its map. It never makes a path invalid nor a search fail. Not all planners heed it (see
    /// [`PlannerName::heeds_soft_costs`]).
    #[must_use]
    pub fn with_soft_costs(self, costs: &SoftCosts) -> Self {
        let costs = costs.onto(self.obstacles.frame());
        Self {
            soft_costs: Some(Arc::new(costs)),
            ..self
        }
    }

    /// The prepared map.
    pub fn obstacles(&self) -> &Arc<ObstacleMap> {
        &self.obstacles
    }

    /// The vehicle.
    pub fn vehicle(&self) -> &Vehicle {
        &self.vehicle
    }

    /// Every parameter.
    pub fn config(&self) -> &PlannerConfig {
        &self.config
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
        let mut limits = self.begin(request, observer)?;
        let found = match self.sealed_off(request) {
            Some(sealed) => Err(sealed),
            None => self.find(request, seed, &mut limits)?,
        };
        let found = match found {
            Ok(found) => self.made_continuous(request, seed, found, &mut limits)?,
            Err(ended) => Err(ended),
        };
        Ok(self.conclude(request, seed, found, &mut limits))
    }

    /// The limits of a query, where it can be asked.
    fn begin<'o>(
        &self,
        request: &Request,
        observer: &'o mut dyn Observer,
    ) -> Result<Limits<'o>, PlanError> {
        request.check(&self.obstacles, &self.vehicle)?;
        if request.deadline.is_some() && observer.elapsed().is_none() {
            return Err(PlanError::DeadlineWithoutClock);
        }
        let (budget_steps, deadline) = (request.budget_steps, request.deadline);
        Ok(Limits::new(observer, budget_steps, deadline))
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
