//! The way around what is waited for: planned with the predicted ground closed, compared in seconds.

use super::{
    DriveError, DriveQuestion, Outcome, Plan, PlanError, Planner, TimedPlan, drive_in_time,
};
use crate::collision::{Body, Drive, ObstacleMap};
use crate::geometry::{ConvexPolygon, Point2};
use crate::map::{OCCUPIED, OccupancyGrid};
use crate::metrics::{ClearanceSummary, PathMetrics};
use crate::motion::{MotionStatus, Region};
use crate::numeric::Seed;
use crate::progress::Observer;
use crate::scenario::{Predicted, Request};
use crate::validation::judge;
use std::f64::consts::TAU;

/// A path around what is waited for on another one, and its drive.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct WayAround {
    /// The path, certified on the map as it is.
    pub plan: Plan,
    /// Its drive.
    pub drive: TimedPlan,
}

/// Time between two moments at which predicted ground is closed, seconds.
const STEP_S: f64 = 0.2;
/// Most moments that are looked at for one obstacle.
const MAX_MOMENTS: usize = 2000;
/// Sides of the polygon around a disc.
const DISC_SIDES: u32 = 16;

impl TimedPlan {
    /// True if a drive is better than another one, or than none: it ends at the end of its path, and
    /// sooner.
    pub fn is_better_than(&self, other: Option<&Self>) -> bool {
        let seconds = |plan: &Self| match plan.motion.status {
            MotionStatus::Arrives => plan.motion.timed.duration_s(),
            MotionStatus::Waits => f64::INFINITY,
        };
        other.is_none_or(|other| seconds(self) < seconds(other))
    }
}

/// Looks for a way around the obstacles that close a path for a while.
///
/// The ground that they sweep while they close it (all that they sweep, where `regions` is empty) is
/// closed on a copy of the map; the same planner plans there, and the path is certified on the map as
/// it is. None where the vehicle or every goal stands on that ground, where there is no such way, or
/// none that can be driven in time. The caller compares the drives:
/// [`TimedPlan::is_better_than`].
///
/// # Errors
/// As [`Planner::plan`].
pub fn way_around(
    (planner, map): (&Planner, &OccupancyGrid),
    (request, seed): (&Request, Seed),
    observer: &mut dyn Observer,
    question: &DriveQuestion,
    regions: &[Region],
) -> Result<Option<WayAround>, PlanError> {
    let Some(config) = planner.config() else {
        return Ok(None);
    };
    let vehicle = planner.vehicle();
    let mut closed = map.clone();
    for (i, obstacle) in question.predictions.obstacles().iter().enumerate() {
        if let Some(closing_s) = closing_s(i, regions) {
            close(&mut closed, obstacle, closing_s, question.config.distance_m);
        }
    }
    let body = Body::new(vehicle);
    let on_closed = ObstacleMap::new(&closed);
    let is_free = |pose| on_closed.is_free(&body, &Drive::at(on_closed.frame().to_grid(pose)));
    if !is_free(request.start) || !request.goals().any(is_free) {
        return Ok(None);
    }
    let mut around = Planner::new(&closed, vehicle.clone(), config.clone())?;
    let Outcome::Found(plan) = around.plan(request, seed, observer)? else {
        return Ok(None);
    };
    let Some(plan) = on_map(planner, request, *plan) else {
        return Ok(None);
    };
    let frame = planner.obstacles().frame();
    match drive_in_time(frame, vehicle, &plan.path, question) {
        Ok(drive) => Ok(Some(WayAround { plan, drive })),
        Err(DriveError::Moving(_) | DriveError::Motion(_) | DriveError::Refused(_)) => Ok(None),
    }
}

/// The time in which an obstacle closes a path; all of it where no region is known.
fn closing_s(obstacle: usize, regions: &[Region]) -> Option<[f64; 2]> {
    if regions.is_empty() {
        return Some([0.0, f64::INFINITY]);
    }
    let its = regions.iter().filter(|region| region.obstacle == obstacle);
    its.fold(None, |ends: Option<[f64; 2]>, region| {
        let [from_s, to_s] = ends.unwrap_or([f64::INFINITY, 0.0]);
        Some([from_s.min(region.from_s), to_s.max(region.to_s)])
    })
}

/// Closes the ground under an obstacle, and as far beside it as is to be kept.
fn close(map: &mut OccupancyGrid, obstacle: &Predicted, [from_s, to_s]: [f64; 2], distance_m: f64) {
    let horizon_s = obstacle.knots().last().copied().unwrap_or_default();
    let from_s = from_s.min(horizon_s);
    let span_s = (to_s.min(horizon_s) - from_s).max(0.0);
    let n_moments = ((span_s / STEP_S).ceil() as usize).clamp(1, MAX_MOMENTS);
    for i in 0..=n_moments {
        let t_s = from_s + span_s * i as f64 / n_moments as f64;
        let reach_m = obstacle.radius_at(t_s) + distance_m;
        let around = |corner: Point2| {
            let angles = (0..DISC_SIDES).map(|j| TAU * f64::from(j) / f64::from(DISC_SIDES));
            angles.map(move |angle| corner + Point2::unit(angle) * reach_m)
        };
        let points = obstacle.corners_at(t_s).into_iter().flat_map(around);
        if let Ok(grown) = ConvexPolygon::hull(&points.collect::<Vec<_>>()) {
            map.fill_polygon(grown.corners(), OCCUPIED);
        }
    }
}

/// The plan as it is on the map of another planner; none where the judge refuses it there.
fn on_map(planner: &Planner, request: &Request, plan: Plan) -> Option<Plan> {
    let (obstacles, vehicle) = (planner.obstacles(), planner.vehicle());
    let certificate = judge(obstacles, vehicle, request, &plan.path)
        .certify()
        .ok()?;
    let least_m = certificate.min_clearance_m;
    let clearance = ClearanceSummary::new(obstacles, vehicle, &plan.path, least_m);
    let goal = request.reached_goal(vehicle.motion(), plan.path.end()).goal;
    let metrics = PathMetrics::new(&plan.path, vehicle, goal, clearance);
    Some(Plan {
        metrics: metrics.with_travel_time(&plan.path, vehicle),
        certificate,
        ..plan
    })
}
