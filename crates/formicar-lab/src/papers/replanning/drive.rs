//! One drive through a changing map.

use super::changes::{Block, can_stand, regions};
use crate::papers::experiment::{Ground, Variant};
use crate::run::measure;
use anyhow::Result;
use formicar::collision::{Body, ObstacleMap};
use formicar::geometry::Arc;
use formicar::map::CellRegion;
use formicar::metrics::flip;
use formicar::numeric::Seed;
use formicar::objective::DriveMeter;
use formicar::path::CurvePath;
use formicar::planner::{Outcome, Plan, Planner, PlannerConfig};
use formicar::scenario::Request;
use serde::Serialize;

/// Distance between two changes, as a share of the first path.
const DRIVEN_SHARE: f64 = 0.1;
/// Samples of paths when they are compared, meters apart.
const SPACING_M: f64 = 0.25;
/// A place of a path this near to another path is on it, meters.
const NEAR_M: f64 = 0.25;

/// The origin of a new path after a change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Replanning {
    /// It is planned anew.
    Anew,
    /// It is replanned from the last one.
    FromLast,
}

/// A configuration and its way to a new path.
pub(super) struct Method {
    pub(super) variant: Variant,
    pub(super) replanning: Replanning,
}

/// A change of the map, and the vehicle's answer to it.
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
    /// The last path is still free after the change.
    pub(super) still_free: bool,
    /// There is a certified path.
    pub(super) found: bool,
    /// It passes an obstacle on another side than the last path.
    pub(super) flip: Option<bool>,
    /// Share of its places that lie on the path before.
    pub(super) kept_share: Option<f64>,
    /// Its cost, meters.
    pub(super) cost_m: Option<f64>,
    /// The cost of the path planned anew from the same place, meters.
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

/// The answer to a query, and its times.
#[derive(Clone)]
struct Answer {
    plan: Option<Plan>,
    first_ms: Option<f64>,
    query_ms: f64,
}

/// Drives a request of a ground, with a new path after every change; ends where there is none.
pub(super) fn drive(ground: &Ground, method: &Method, seed: u64) -> Result<Vec<Step>> {
    let config = method.variant.config.clone();
    let mut planner = ground.planner(&config)?;
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
        let anew = self.ask(request, Replanning::Anew)?;
        let own = match self.method.replanning {
            Replanning::Anew => anew.clone(),
            Replanning::FromLast => self.ask(request, Replanning::FromLast)?,
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
        let gone = self.standing.take();
        let vanishing = measure(&mut (), |_| match gone {
            Some(gone) => self.planner.update_map(gone.region, &gone.before),
            None => Ok(()),
        });
        vanishing.answer?;
        let common = self.planner.obstacles().as_ref().clone();
        // What stood under the block may have vanished with the last one.
        let next = Block::of(&common, region);
        let appearing = measure(&mut (), |_| {
            self.planner.update_map(next.region, &next.values())
        });
        appearing.answer?;
        self.standing = Some(next);
        Ok((common, 1e3 * (vanishing.query_s + appearing.query_s)))
    }

    /// Plans from a start, by a copy of the planner: what queries prepare once after a change is
    /// part of each.
    fn ask(&self, request: &Request, method: Replanning) -> Result<Answer> {
        let mut planner = self.planner.clone();
        let seed = Seed(self.seed);
        let measured = measure(&mut (), |observer| match method {
            Replanning::Anew => planner.plan(request, seed, observer),
            Replanning::FromLast => planner.replan(request, &self.path, seed, observer),
        });
        let (first_s, query_s) = (measured.first_feasible_s(), measured.query_s);
        let plan = match measured.answer? {
            Outcome::Found(plan) => Some(*plan),
            Outcome::NotFound(_) => None,
        };
        Ok(Answer {
            plan,
            first_ms: first_s.map(|first_s| 1e3 * first_s),
            query_ms: 1e3 * query_s,
        })
    }

    fn is_free(&self, path: &CurvePath, request: &Request) -> bool {
        let obstacles = self.planner.obstacles();
        formicar::validation::judge(obstacles, &self.ground.vehicle, request, path).valid
    }

    fn cost_m(&self, path: &CurvePath) -> f64 {
        let (obstacles, vehicle) = (self.planner.obstacles(), &self.ground.vehicle);
        let body = Body::new(vehicle);
        let cost = self.config.cost().of_vehicle(vehicle);
        let meter = DriveMeter::new(obstacles, &body, &cost);
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
