//! The one door: what happens to every request, whichever search is asked.

mod conclude;
mod continuous;
mod disconnected;
mod escape;
mod explain;
mod goals;
mod legs;

pub(super) use disconnected::AxleGround;
pub use escape::Escape;
pub(super) use legs::find_legs;

use super::prepared::PreparedMap;
use super::{Found, Halt, Outcome, PathSearch, PlanError, PlannerConfig, Task, Vehicles};
use crate::collision::ObstacleMap;
use crate::layers::SoftCosts;
use crate::map::{CellRegion, OccupancyGrid};
use crate::numeric::Seed;
use crate::path::CurvePath;
use crate::progress::{Limits, Observer};
use crate::scenario::{Endpoint, Request, Scenario, ScenarioError, StartContact, StartHeading};
use crate::vehicle::{Motion, Vehicle};
use std::sync::Arc;

/// A planner that keeps what it has prepared: ask it as often as you like.
#[derive(Clone, Debug)]
pub struct Planner {
    search: Arc<dyn PathSearch>,
    map: PreparedMap,
    n_threads: usize,
    /// A preference for some ground over other.
    soft_costs: Option<Arc<SoftCosts>>,
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
        Ok(Self::searching_on(obstacles, vehicle, Arc::new(config)))
    }

    /// A planner that searches in a way of your own.
    pub fn with_search(map: &OccupancyGrid, vehicle: Vehicle, search: Arc<dyn PathSearch>) -> Self {
        Self::searching_on(Arc::new(ObstacleMap::new(map)), vehicle, search)
    }

    /// The same on a map that is prepared already.
    pub fn searching_on(
        obstacles: Arc<ObstacleMap>,
        vehicle: Vehicle,
        search: Arc<dyn PathSearch>,
    ) -> Self {
        Self {
            search,
            map: PreparedMap::new(obstacles, vehicle),
            n_threads: 1,
            soft_costs: None,
        }
    }

    /// The same planner on at most so many threads; the result never depends on it. Colonies use
    /// them, everything else runs on one.
    #[must_use]
    pub fn with_threads(self, n_threads: usize) -> Self {
        Self { n_threads, ..self }
    }

    /// The same planner with a preference for some ground over other, brought onto the frame of
    /// its map. It never makes a path invalid nor a search fail. Only some searches heed it (see
    /// [`Abilities::heeds_soft_costs`](super::Abilities)).
    #[must_use]
    pub fn with_soft_costs(self, costs: &SoftCosts) -> Self {
        let costs = costs.onto(self.map.obstacles.frame());
        Self {
            soft_costs: Some(Arc::new(costs)),
            ..self
        }
    }

    /// The prepared map.
    pub fn obstacles(&self) -> &Arc<ObstacleMap> {
        &self.map.obstacles
    }

    /// The vehicle.
    pub fn vehicle(&self) -> &Vehicle {
        &self.map.vehicle
    }

    /// The planner's name.
    pub fn name(&self) -> &str {
        self.search.name()
    }

    /// Every parameter of a built-in planner.
    pub fn config(&self) -> Option<&PlannerConfig> {
        self.search.config()
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
        let Some((escape, from_there)) = self.escape(request) else {
            let outcome = self.plan_from_free(request, seed, observer);
            return outcome.map_err(|error| shut_in(request, error));
        };
        let mut outcome = self.plan_from_free(&from_there, seed, observer)?;
        if let Outcome::Found(plan) = &mut outcome {
            plan.escape = Some(escape);
        }
        Ok(outcome)
    }

    /// The way out of contact where the request asks for one, and what it asks for from there.
    fn escape(&self, request: &Request) -> Option<(Escape, Request)> {
        if request.start_contact == StartContact::Refuse || !request.start.is_finite() {
            return None;
        }
        let escape = escape::escape(self.obstacles(), self.vehicle(), request)?;
        let from_there = Request {
            start: escape.path.end(),
            start_heading: StartHeading::Exact,
            ..request.clone()
        };
        Some((escape, from_there))
    }

    fn plan_from_free(
        &mut self,
        request: &Request,
        seed: Seed,
        observer: &mut dyn Observer,
    ) -> Result<Outcome, PlanError> {
        let mut limits = self.begin(request, observer)?;
        let mut task = self.task(request, seed);
        let found = disconnected::check(&mut task, &mut limits)
            .and_then(|()| find(&mut task, &mut limits))
            .and_then(|found| continuous::made_continuous(&task, found, &mut limits));
        conclude::conclude(&task, found, &mut limits)
    }

    /// Plans a request again, mostly after [`Planner::update_map`]: from where the vehicle is now,
    /// and with what is left of the path that it drives.
    ///
    /// The part of the previous path ahead of the start is kept where it is still free, met from
    /// the start by a free curve, and bridged where it is broken: by curves or, where none is
    /// free, by a search between the ends of the gap. The result is improved like any first
    /// path. A path planned anew, which is that of [`Planner::plan`], takes its place only where it
    /// is cheaper by more than [`ReplanConfig::consistency`](super::ReplanConfig). Where nothing
    /// can be mended, the answer is that of [`Planner::plan`].
    ///
    /// With via points, those still ahead, the mended path is not improved.
    ///
    /// Same map, vehicle, configuration, request, previous path and seed: same path.
    ///
    /// # Errors
    /// As [`Planner::plan`]; and a planner that does not replan: of the built-in ones all but
    /// `formicar`.
    pub fn replan(
        &mut self,
        request: &Request,
        previous: &CurvePath,
        seed: Seed,
        observer: &mut dyn Observer,
    ) -> Result<Outcome, PlanError> {
        if !self.search.abilities().replans {
            let planner = self.name().to_owned();
            return Err(PlanError::CannotReplan { planner });
        }
        check_motion(self.search.as_ref(), self.vehicle())?;
        let mut limits = self.begin(request, observer)?;
        let mut task = self.task(request, seed);
        let found = disconnected::check(&mut task, &mut limits)
            .and_then(|()| replan(&mut task, previous, &mut limits));
        conclude::conclude(&task, found, &mut limits)
    }

    /// Puts new values into a rectangle of cells of the map, row by row, lowest row first: -1
    /// unknown, 0 free, to 100 occupied. The frame stays, and with it the vehicle's masks.
    ///
    /// Afterwards the planner is, to the bit of every path, one made for the changed map. A map
    /// that others hold too is copied first. Cost is proportional to the cells of the rectangle
    /// that change, grown by twice the truncation of the distance transform (64 cells); the next
    /// query labels the connected parts anew.
    ///
    /// # Errors
    /// A part of the rectangle off the map, another number of values than cells, or a value
    /// outside -1..=100; nothing is changed then.
    pub fn update_map(&mut self, region: CellRegion, values: &[i8]) -> Result<(), PlanError> {
        Ok(self.map.update(&region, values)?)
    }

    fn task<'a>(&'a mut self, request: &'a Request, seed: Seed) -> Task<'a> {
        Task {
            search: self.search.as_ref(),
            request,
            seed,
            n_threads: self.n_threads,
            soft_costs: self.soft_costs.as_deref(),
            map: &mut self.map,
        }
    }

    /// The limits of a query, where it can be asked.
    fn begin<'o>(
        &self,
        request: &Request,
        observer: &'o mut dyn Observer,
    ) -> Result<Limits<'o>, PlanError> {
        request.check(self.obstacles(), self.vehicle())?;
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

/// Finds a path of lines and arcs to any of the goals, past all via points.
fn find(task: &mut Task, limits: &mut Limits) -> Result<Found, Halt> {
    if task.request().via.is_empty() {
        goals::find_any(task, limits)
    } else {
        find_legs(task, limits)
    }
}

/// Plans again with a previous path, where the vehicle is not at a goal already.
fn replan(task: &mut Task, previous: &CurvePath, limits: &mut Limits) -> Result<Found, Halt> {
    let standing = if task.request().via.is_empty() {
        goals::standing(task, limits)
    } else {
        None
    };
    match standing {
        Some(found) => Ok(found),
        None => task.search.replan(task, previous, limits),
    }
}

/// The error of a start in contact, where a way out was asked for and none was found.
fn shut_in(request: &Request, error: PlanError) -> PlanError {
    let is_asked = request.start_contact == StartContact::Escape;
    match error {
        PlanError::Scenario(ScenarioError::Occupied {
            which: Endpoint::Start,
            x,
            y,
            problem,
            hint,
            cells,
        }) if is_asked => PlanError::Scenario(ScenarioError::Occupied {
            which: Endpoint::Start,
            x,
            y,
            problem: format!("{problem}, and no way out touches these cells alone"),
            hint,
            cells,
        }),
        error => error,
    }
}

/// Refuses a point to a search that needs a car.
fn check_motion(search: &dyn PathSearch, vehicle: &Vehicle) -> Result<(), PlanError> {
    if search.abilities().vehicles == Vehicles::Cars && vehicle.motion() == Motion::Point {
        let planner = search.name().to_owned();
        return Err(PlanError::NeedsACar { planner });
    }
    Ok(())
}
