//! One drive through a changing map.

use super::course::{Block, block, regions};
use crate::experiment::{Ground, Variant};
use anyhow::Result;
use formicar::collision::{Body, ObstacleMap};
use formicar::geometry::Arc;
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
pub struct Step {
    /// The map.
    pub map: String,
    /// The method.
    pub method: String,
    /// The seed.
    pub seed: u64,
    /// The change, counted from 1.
    pub change: usize,
    /// Whether the path before is free after the change.
    pub still_free: bool,
    /// Whether there is a certified path.
    pub found: bool,
    /// Whether it passes an obstacle on another side than the path before.
    pub flip: Option<bool>,
    /// Share of its places that lie on the path before.
    pub kept_share: Option<f64>,
    /// What it costs, metres.
    pub cost_m: Option<f64>,
    /// What the path planned anew from the same place costs, metres.
    pub anew_cost_m: Option<f64>,
    /// Its length.
    pub length_m: Option<f64>,
    /// Its least clearance.
    pub min_clearance_m: Option<f64>,
    /// Changing the map, milliseconds.
    pub update_ms: f64,
    /// Until the first certified path, milliseconds.
    pub first_ms: Option<f64>,
    /// The query in all, milliseconds.
    pub query_ms: f64,
    /// The query planned anew from the same place, milliseconds.
    pub anew_query_ms: f64,
    /// Search steps.
    pub n_steps: u64,
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
        let goal = journey.path.end();
        let next = block(
            planner_map(&journey.planner),
            &ground.vehicle,
            region,
            [start, goal],
        );
        let Some(next) = next else {
            journey.path = rest(&journey.path, behind_m);
            continue;
        };
        let step = journey.step(&request, next, i + 1)?;
        let is_found = step.found;
        steps.push(step);
        if !is_found {
            break;
        }
    }
    Ok(steps)
}

fn planner_map(planner: &Planner) -> &ObstacleMap {
    planner.obstacles()
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
    fn step(&mut self, request: &Request, next: Block, change: usize) -> Result<Step> {
        let begun = Watch::start();
        if let Some(gone) = self.standing.take() {
            self.planner.update_map(gone.region, &gone.before)?;
        }
        let vanished_ms = begun.ms();
        // Both the path before and the one after are free on this map.
        let common = self.planner.obstacles().as_ref().clone();
        // What stood under the block before may have vanished with the last one.
        let lethal = common.lethal();
        let before = next.region.cells();
        let before = before
            .map(|cell| 100 * i8::from(lethal.get(cell.col as usize, cell.row as usize)))
            .collect();
        let next = Block { before, ..next };
        let begun = Watch::start();
        self.planner.update_map(next.region, &next.values())?;
        let update_ms = vanished_ms + begun.ms();
        self.standing = Some(next);
        let ahead = rest(
            &self.path,
            self.path.nearest_m(request.start, 1.0, SPACING_M),
        );
        // What queries prepare once after a change is part of each.
        let mut cold = self.planner.clone();
        let (anew, anew_watch) = self.query(&mut cold, request, false)?;
        let mut planner = self.planner.clone();
        let (plan, watch, query_ms) = if self.method.replans {
            let (plan, watch) = self.query(&mut planner, request, true)?;
            let query_ms = watch.1;
            (plan, watch.0, query_ms)
        } else {
            let copy = anew.clone();
            (copy, Watch { ..anew_watch.0 }, anew_watch.1)
        };
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
            anew_cost_m: anew.as_ref().map(|plan| self.cost_m(&plan.path)),
            length_m: path.map(CurvePath::length_m),
            min_clearance_m: plan.as_ref().map(|plan| plan.certificate.min_clearance_m),
            update_ms,
            first_ms: watch.first_ms,
            query_ms,
            anew_query_ms: anew_watch.1,
            n_steps: plan.as_ref().map_or(0, |plan| plan.n_steps),
        };
        if let Some(plan) = plan {
            self.path = plan.path;
        }
        Ok(step)
    }

    /// Plans from a start, with the watch and the time that it took.
    fn query(
        &self,
        planner: &mut Planner,
        request: &Request,
        replans: bool,
    ) -> Result<(Option<Plan>, (Watch, f64))> {
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
        Ok((plan, (watch, query_ms)))
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
