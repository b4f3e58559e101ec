//! What is measured of a run beyond its answer: the clearance of its ends, the cost of its path,
//! and how long the judge takes.

use formicar::collision::{Body, ObstacleMap};
use formicar::geometry::{Arc, Pose2};
use formicar::metrics::{ClearanceSummary, CompatibleMetrics, PathMetrics};
use formicar::objective::{DriveCost, DriveMeter};
use formicar::path::CurvePath;
use formicar::planner::{Plan, Planner};
use formicar::scenario::Request;
use formicar::validation::{Samples, judge};
use formicar::vehicle::{Motion, Vehicle};
use formicar_lab::campaign::Row;
use formicar_lab::rival::Verdict;
use serde_json::json;
use std::time::Instant;

/// The map, and the vehicle on it.
pub(crate) type Place<'a> = (&'a ObstacleMap, &'a Vehicle);

/// The size of the map, and the lesser clearance of start and goal alone: of several goals and
/// headings the given ones.
pub(crate) fn ground(row: &mut Row, (obstacles, vehicle): Place, [start, goal]: [Pose2; 2]) {
    let (frame, body) = (obstacles.frame(), Body::new(vehicle));
    let clearance_m = |pose: Pose2| obstacles.clearance_m(&body, frame.to_grid(pose));
    let least_m = clearance_m(start).min(clearance_m(goal));
    row.set("n_cols", &json!(frame.n_cols()));
    row.set("n_rows", &json!(frame.n_rows()));
    row.set("ends_clearance_m", &json!(least_m));
}

/// What a path costs by the usual weights, and how long it takes to judge it.
pub(super) fn path(row: &mut Row, planner: &Planner, request: &Request, plan: &Plan) {
    let (obstacles, vehicle) = (planner.obstacles(), planner.vehicle());
    let begun = Instant::now();
    let report = judge(obstacles, vehicle, request, &plan.path);
    let judge_s = begun.elapsed().as_secs_f64();
    // The verdict of the row is that of this second look.
    row.set("valid", &json!(report.valid && plan.certificate.valid));
    row.set("judge_s", &json!(judge_s));
    cost(row, (obstacles, vehicle), &plan.path);
}

/// What a path costs by the usual weights.
fn cost(row: &mut Row, (obstacles, vehicle): Place, path: &CurvePath) {
    if vehicle.motion() == Motion::Car {
        let (cost, body) = (DriveCost::default(), Body::new(vehicle));
        let radius_m = vehicle.min_turning_radius_m();
        let meter = DriveMeter::new(obstacles, &body, &cost, radius_m);
        let start = obstacles.frame().to_grid(path.start());
        row.set("cost_m", &json!(meter.path_m(start, &arcs(path))));
    }
}

/// The judge's word on a foreign path, with everything that is measured of one of ours; of a path
/// that cannot be driven there is the reason why. Returns the path where it can be.
pub(crate) fn verdict(
    row: &mut Row,
    place: Place,
    request: &Request,
    samples: &Samples,
) -> Option<CurvePath> {
    let (obstacles, vehicle) = place;
    let begun = Instant::now();
    let verdict = Verdict::new(obstacles, vehicle, request, samples)?;
    row.set("judge_s", &json!(begun.elapsed().as_secs_f64()));
    row.set("valid", &json!(verdict.report.valid));
    row.set("reason", &json!(verdict.reason()));
    if !verdict.is_measurable(obstacles) {
        return None;
    }
    let (path, least_m) = (&verdict.path, verdict.report.min_clearance_m);
    let clearance = ClearanceSummary::new(obstacles, vehicle, path, least_m);
    let metrics = PathMetrics::new(path, vehicle, request.goal, clearance);
    row.fill(&serde_json::to_value(metrics).unwrap_or_default());
    let compatible = CompatibleMetrics::new(path, vehicle, obstacles);
    row.fill(&serde_json::to_value(compatible).unwrap_or_default());
    cost(row, place, path);
    verdict.report.valid.then_some(verdict.path)
}

fn arcs(path: &CurvePath) -> Vec<Arc> {
    let segments = path.segments().iter();
    let arc = |s: &formicar::path::CurveSegment| {
        Arc::new(s.curvature_per_m, s.direction.sign() * s.length_m)
    };
    segments.map(arc).collect()
}
