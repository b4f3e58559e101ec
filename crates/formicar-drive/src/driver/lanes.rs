//! Planners on what is known, one per margin, and the ground that has been seen.

use super::config::DriverConfig;
use crate::error::SetupError;
use crate::known_map::{KnownChange, KnownMap};
use crate::limits::{plan_error, with_margin};
use crate::route::{free_m, joined};
use formicar::collision::{Body, ObstacleMap};
use formicar::map::{FREE, OCCUPIED, UNKNOWN};
use formicar::scenario::StartContact;
use formicar::{
    CurvePath, Observer, OccupancyGrid, Outcome, PlanError, Planner, Pose2, Request, Vehicle,
};

/// A planner with a margin.
struct Lane {
    body: Body,
    planner: Planner,
    /// The value that its map gives unknown cells.
    unknown_is: i8,
}

/// Planners from the widest margin to the narrowest, the last of them on known ground alone.
pub(super) struct Lanes {
    all: Vec<Lane>,
    /// The known map with unknown cells occupied.
    seen: ObstacleMap,
    /// The body with the narrowest margin.
    guard: Body,
}

/// A question to the planners.
pub(super) struct Search<'a> {
    pub(super) request: Request,
    pub(super) previous: Option<&'a CurvePath>,
    /// The first lane to ask.
    pub(super) first: usize,
}

impl Lanes {
    pub(super) fn new(
        known: &KnownMap,
        vehicle: &Vehicle,
        config: &DriverConfig,
    ) -> Result<Self, SetupError> {
        let lane = |margin_m: f64, unknown_is: i8| {
            let vehicle = with_margin(vehicle, margin_m)?;
            let map = decided(known, unknown_is)?;
            Ok(Lane {
                body: Body::new(&vehicle),
                planner: Planner::new(&map, vehicle, config.planner.clone())?,
                unknown_is,
            })
        };
        let margins = config.margins_m.iter();
        let lanes = margins.map(|&margin_m| lane(margin_m, FREE));
        let mut lanes: Vec<Lane> = lanes.collect::<Result<_, SetupError>>()?;
        let narrowest_m = config.margins_m.last().copied().unwrap_or(0.0);
        lanes.push(lane(narrowest_m, OCCUPIED)?);
        Ok(Self {
            all: lanes,
            seen: ObstacleMap::new(&decided(known, OCCUPIED)?),
            guard: Body::new(&with_margin(vehicle, narrowest_m)?),
        })
    }

    pub(super) fn update(&mut self, change: &KnownChange) -> Result<(), SetupError> {
        for lane in &mut self.all {
            let values = change.with_unknown_as(lane.unknown_is);
            lane.planner.update_map(change.region, &values)?;
        }
        let values = change.with_unknown_as(OCCUPIED);
        let updated = self.seen.update(&change.region, &values);
        updated.map(|_| ()).map_err(plan_error)
    }

    /// The last lane: known ground alone.
    pub(super) fn cautious(&self) -> usize {
        self.all.len() - 1
    }

    /// The length of a path that is free on the map of a lane, with its margin.
    pub(super) fn free_m(&self, lane: usize, path: &CurvePath) -> f64 {
        let lane = &self.all[lane];
        free_m(lane.planner.obstacles(), &lane.body, path)
    }

    /// The length of a path that has been seen and is free, with the narrowest margin.
    pub(super) fn seen_m(&self, path: &CurvePath) -> f64 {
        free_m(&self.seen, &self.guard, path)
    }

    /// The length of a path on which no obstacle is known, with the narrowest margin.
    pub(super) fn open_m(&self, path: &CurvePath) -> f64 {
        free_m(self.all[0].planner.obstacles(), &self.guard, path)
    }

    /// Distance of the robot, with the narrowest margin, from the nearest known obstacle, meters.
    pub(super) fn clearance_m(&self, pose: Pose2) -> f64 {
        let obstacles = self.all[0].planner.obstacles();
        obstacles.clearance_m(&self.guard, obstacles.frame().to_grid(pose))
    }

    /// The first path that a lane finds, with the lane; counts what is asked.
    pub(super) fn search(
        &mut self,
        search: &Search,
        config: &DriverConfig,
        (n_searches, observer): (&mut usize, &mut dyn Observer),
    ) -> Result<Option<(CurvePath, usize)>, SetupError> {
        for (i, lane) in self.all.iter_mut().enumerate().skip(search.first) {
            *n_searches += 1;
            if let Some(path) = lane.search(search, config, observer)? {
                return Ok(Some((path, i)));
            }
        }
        Ok(None)
    }
}

impl Lane {
    /// A path, from where the robot stands also out of contact with its margin.
    fn search(
        &mut self,
        search: &Search,
        config: &DriverConfig,
        observer: &mut dyn Observer,
    ) -> Result<Option<CurvePath>, SetupError> {
        let request = Request {
            budget_steps: Some(config.budget_steps),
            start_contact: StartContact::Escape,
            ..search.request.clone()
        };
        let outcome = match search.previous {
            Some(previous) => {
                let request = Request {
                    start_contact: StartContact::Refuse,
                    ..request
                };
                self.planner
                    .replan(&request, previous, config.seed, observer)
            }
            None => self.planner.plan(&request, config.seed, observer),
        };
        match outcome {
            Ok(Outcome::Found(plan)) => Ok(Some(match &plan.escape {
                Some(escape) => joined(&escape.path, &plan.path),
                None => plan.path,
            })),
            // A start or goal in contact on this lane may be free on the next.
            Ok(Outcome::NotFound(_)) | Err(PlanError::Scenario(_)) => Ok(None),
            Err(error) => Err(error.into()),
        }
    }
}

/// A map whose unknown cells have a value.
fn decided(known: &KnownMap, unknown_is: i8) -> Result<OccupancyGrid, SetupError> {
    let known_or = |&v: &i8| if v == UNKNOWN { unknown_is } else { v };
    let values = known.values().iter().map(known_or).collect();
    OccupancyGrid::new(*known.frame(), values).map_err(plan_error)
}
