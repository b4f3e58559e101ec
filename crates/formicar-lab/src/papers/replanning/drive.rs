//! One drive through a changing map.

use super::course::{Block, can_stand, regions};
use crate::papers::experiment::{Ground, Variant};
use anyhow::Result;
use formicar::collision::{Body, ObstacleMap};
use formicar::geometry::Arc;
use formicar::map::CellRegion;
use formicar::metrics::flip;
use formicar::numeric::Seed;
use formicar::objective::DriveMeter;
use formicar::path::CurvePath;
use formicar::planner::{Outcome, Plan, Planner, PlannerConfig};
use formicar::progress::{Event, Observer};
use formicar::scenario::Request;
use serde::Serialize;
use std::time::Instant;

/// What the vehicle drives between two changes, as a share of the first path.
const DRIVEN_SHARE: f64 = 0.1;
/// Samples of paths when they are compared, metres apart.
const SPACING_M: f64 = 0.25;
/// A place of a path this near to another path is on it, metres.
const NEAR_M: f64 = 0.25;

/// How a new path is made after a change.
pub(super) struct Method {
    pub(super) variant: Variant,
    /// Whether it replans; else it plans anew.
    pub(super) replans: bool,
}

/// A change of the map and what the vehicle does then.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Step {
    /// The map.
    pub(super) map: String,
    /// The method.
    pub(super) method: String,
    /// The seed.
    pub(super) seed: u64,
    /// The change, counted from 1.
    pub(super) change: usize,
    /// Whether the path before is free after the change.
    pub(super) still_free: bool,
    /// Whether there is a certified path.
    pub(super) found: bool,
    /// Whether it passes an obstacle on another side than the path before.
    pub(super) flip: Option<bool>,
    /// Share of its places that lie on the path before.
    pub(super) kept_share: Option<f64>,
    /// What it costs, metres.
    pub(super) cost_m: Option<f64>,
    /// What the path planned anew from the same place costs, metres.
    pub(super) anew_cost_m: Option<f64>,
    /// Its length.
    pub(super) length_m: Option<f64>,
    /// Its least clearance.
    pub(super) min_clearance_m: Option<f64>,
    /// Changing the map, milliseconds.
    pub(super) update_ms: f64,
    /// Until the first certified path, milliseconds.
    pub(super) first_ms: Option<f64>,
    /// The query in all, milliseconds.
    pub(super) query_ms: f64,
    /// The query planned anew from the same place, milliseconds.
    pub(super) anew_query_ms: f64,
    /// Search steps.
    pub(super) n_steps: u64,
}

/// A clock that remembers the first certified path.
struct Watch {
    begun: Instant,
    first_ms: Option<f64>,
}

impl Watch {
    fn start() -> Self {
        Self {
            begun: Instant::now(),
            first_ms: None,
        }
    }

    fn ms(&self) -> f64 {
        self.begun.elapsed().as_secs_f64() * 1e3
    }
}

impl Observer for Watch {
    fn on_event(&mut self, event: &Event) {
        if matches!(event, Event::Improved { .. }) {
            let now_ms = self.ms();
            self.first_ms.get_or_insert(now_ms);
        }
    }
}

/// The answer to a query, and how long it took.
#[derive(Clone)]
struct Asked {
    plan: Option<Plan>,
    first_ms: Option<f64>,
    query_ms: f64,
}

/// Drives a request of a ground, with a new path after every change; ends where there is none.
pub(super) fn drive(ground: &Ground, method: &Method, seed: u64) -> Result<Vec<Step>> {
    let config = method.variant.config.clone();
    let mut planner = Planner::new(&ground.grid, ground.vehicle.clone(), config.clone())?;
    let outcome = planner.plan(&ground.request, Seed(seed), &mut ())?;
    let Outcome::Found(first) = outcome else {
        return Ok(Vec::new());
    };
    let regions = regions(ground.grid.frame(), &ground.vehicle, &first.path, seed);
    let driven_m = DRIVEN_SHARE * first.path.length_m();
    let mut journey = Journey {
        ground,
        method,
        config,
        seed,
        planner,
        path: first.path,
        standing: None,
    };
    let mut steps = Vec::new();
    for (i, region) in regions.into_iter().enumerate() {
        let behind_m = journey.path.length_m().min(driven_m);
        let start = journey.path.pose_at(behind_m);
        let request = Request {
            start,
            ..ground.request.clone()
        };
        let ends = [start, journey.path.end()];
        if !can_stand(journey.planner.obstacles(), &ground.vehicle, region, ends) {
            journey.path = rest(&journey.path, behind_m);
            continue;
        }
        let step = journey.step(&request, region, i + 1)?;
        let is_found = step.found;
        steps.push(step);
        if !is_found {
            break;
        }
    }
    Ok(steps)
}

fn rest(path: &CurvePath, behind_m: f64) -> CurvePath {
    path.between_m(behind_m, path.length_m())
}

struct Journey<'a> {
    ground: &'a Ground,
    method: &'a Method,
    config: PlannerConfig,
    seed: u64,
    planner: Planner,
    path: CurvePath,
    /// The block that has appeared last.
    standing: Option<Block>,
}

impl Journey<'_> {
    /// A block vanishes, another appears, and there is a new path.
    fn step(&mut self, request: &Request, region: CellRegion, change: usize) -> Result<Step> {
        let (common, update_ms) = self.change_map(region)?;
        let driven_m = self.path.nearest_m(request.start, 1.0, SPACING_M);
        let ahead = rest(&self.path, driven_m);
        let anew = self.ask(request, false)?;
        let own = if self.method.replans {
            self.ask(request, true)?
        } else {
            anew.clone()
        };
        let plan = own.plan;
        let path = plan.as_ref().map(|plan| &plan.path);
        let step = Step {
            map: self.ground.map.clone(),
            method: self.method.variant.name.clone(),
            seed: self.seed,
            change,
            still_free: self.is_free(&ahead, request),
            found: plan.is_some(),
            flip: path.map(|path| flip(&ahead, path, &common)),
            kept_share: path.map(|path| kept_share(path, &ahead)),
            cost_m: path.map(|path| self.cost_m(path)),
            anew_cost_m: anew.plan.as_ref().map(|plan| self.cost_m(&plan.path)),
            length_m: path.map(CurvePath::length_m),
            min_clearance_m: plan.as_ref().map(|plan| plan.certificate.min_clearance_m),
            update_ms,
            first_ms: own.first_ms,
            query_ms: own.query_ms,
            anew_query_ms: anew.query_ms,
            n_steps: plan.as_ref().map_or(0, |plan| plan.n_steps),
        };
        if let Some(plan) = plan {
            self.path = plan.path;
        }
        Ok(step)
    }

    /// Lets the last block vanish and the next one appear; the map between the two, on which the
    /// path before and the one after are free, and the time of both updates.
    fn change_map(&mut self, region: CellRegion) -> Result<(ObstacleMap, f64)> {
        let watch = Watch::start();
        if let Some(gone) = self.standing.take() {
            self.planner.update_map(gone.region, &gone.before)?;
        }
        let vanished_ms = watch.ms();
        let common = self.planner.obstacles().as_ref().clone();
        // What stood under the block may have vanished with the last one.
        let next = Block::of(&common, region);
        let watch = Watch::start();
        self.planner.update_map(next.region, &next.values())?;
        self.standing = Some(next);
        Ok((common, vanished_ms + watch.ms()))
    }

    /// Plans from a start, by a copy of the planner: what queries prepare once after a change is
    /// part of each.
    fn ask(&self, request: &Request, replans: bool) -> Result<Asked> {
        let mut planner = self.planner.clone();
        let mut watch = Watch::start();
        let seed = Seed(self.seed);
        let outcome = if replans {
            planner.replan(request, &self.path, seed, &mut watch)?
        } else {
            planner.plan(request, seed, &mut watch)?
        };
        let query_ms = watch.ms();
        let plan = match outcome {
            Outcome::Found(plan) => Some(*plan),
            Outcome::NotFound(_) => None,
        };
        Ok(Asked {
            plan,
            first_ms: watch.first_ms,
            query_ms,
        })
    }

    fn is_free(&self, path: &CurvePath, request: &Request) -> bool {
        let obstacles = self.planner.obstacles();
        formicar::validation::judge(obstacles, &self.ground.vehicle, request, path).valid
    }

    fn cost_m(&self, path: &CurvePath) -> f64 {
        let (obstacles, vehicle) = (self.planner.obstacles(), &self.ground.vehicle);
        let body = Body::new(vehicle);
        let radius_m = vehicle.min_turning_radius_m();
        let meter = DriveMeter::new(obstacles, &body, &self.config.cost, radius_m);
        let arcs = path.segments().iter().map(|segment| {
            let length_m = segment.direction.sign() * segment.length_m;
            Arc::new(segment.curvature_per_m, length_m)
        });
        let start = obstacles.frame().to_grid(path.start());
        meter.path_m(start, &arcs.collect::<Vec<_>>())
    }
}

/// Share of a path's places that lie on another path.
fn kept_share(path: &CurvePath, other: &CurvePath) -> f64 {
    let (places, others) = (path.sample(SPACING_M), other.sample(0.5 * NEAR_M));
    let is_near = |place: &&formicar::path::PathPose| {
        let at = place.pose.position();
        let mut others = others.iter();
        others.any(|other| other.pose.position().distance(at) <= NEAR_M)
    };
    places.iter().filter(is_near).count() as f64 / places.len() as f64
}
