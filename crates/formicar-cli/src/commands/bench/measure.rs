//! What is measured of a run beyond its answer: the clearance of its ends, the cost of its path,
//! and how long the judge takes.

use formicar::collision::Body;
use formicar::geometry::{Arc, Pose2};
use formicar::objective::{DriveCost, DriveMeter};
use formicar::path::CurvePath;
use formicar::planner::{Plan, Planner};
use formicar::scenario::Request;
use formicar::validation::judge;
use formicar::vehicle::Motion;
use formicar_lab::campaign::Row;
use serde_json::json;
use std::time::Instant;

/// The size of the map, and the lesser clearance of start and goal alone: of several goals and
/// headings the given ones.
pub(super) fn ground(row: &mut Row, planner: &Planner, [start, goal]: [Pose2; 2]) {
    let obstacles = planner.obstacles();
    let (frame, body) = (obstacles.frame(), Body::new(planner.vehicle()));
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
    if vehicle.motion() == Motion::Car {
        let (cost, body) = (DriveCost::default(), Body::new(vehicle));
        let radius_m = vehicle.min_turning_radius_m();
        let meter = DriveMeter::new(obstacles, &body, &cost, radius_m);
        let start = obstacles.frame().to_grid(plan.path.start());
        row.set("cost_m", &json!(meter.path_m(start, &arcs(&plan.path))));
    }
}

fn arcs(path: &CurvePath) -> Vec<Arc> {
    let segments = path.segments().iter();
    let arc = |s: &formicar::path::CurveSegment| {
        Arc::new(s.curvature_per_m, s.direction.sign() * s.length_m)
    };
    segments.map(arc).collect()
}
