//! Measurements of a run beyond its answer: the clearance of its ends, the cost of its path, the
//! judge's time and, for a foreign path, the judge's verdict.

use super::record::{RunRecord, finite, one_line};
use crate::rival::Verdict;
use formicar::collision::{Body, ObstacleMap};
use formicar::geometry::{Arc, Pose2};
use formicar::metrics::{ClearanceSummary, CompatibleMetrics, PathMetrics};
use formicar::objective::{DriveCost, DriveMeter};
use formicar::path::{CurvePath, CurveSegment};
use formicar::planner::Plan;
use formicar::scenario::Request;
use formicar::validation::{Samples, judge};
use formicar::vehicle::{Motion, Vehicle};
use std::time::Instant;

/// A map, and a vehicle on it.
#[derive(Clone, Copy, Debug)]
pub struct Evaluation<'a> {
    /// The prepared map.
    pub obstacles: &'a ObstacleMap,
    /// The vehicle.
    pub vehicle: &'a Vehicle,
}

impl Evaluation<'_> {
    /// Notes the size of the map, and the lesser clearance of the given start and goal.
    pub fn ends(&self, record: &mut RunRecord, [start, goal]: [Pose2; 2]) {
        let (frame, body) = (self.obstacles.frame(), Body::new(self.vehicle));
        let clearance_m = |pose: Pose2| self.obstacles.clearance_m(&body, frame.to_grid(pose));
        record.n_cols = Some(frame.n_cols() as u64);
        record.n_rows = Some(frame.n_rows() as u64);
        record.ends_clearance_m = finite(clearance_m(start).min(clearance_m(goal)));
    }

    /// Judges a plan once more, and notes the metrics and the cost of its path.
    pub(super) fn plan(&self, record: &mut RunRecord, request: &Request, plan: &Plan) {
        let begun = Instant::now();
        let report = judge(self.obstacles, self.vehicle, request, &plan.path);
        record.judge_s = Some(begun.elapsed().as_secs_f64());
        // The verdict of the record is that of this second look.
        record.valid = Some(report.valid && plan.certificate.valid);
        let compatible = CompatibleMetrics::new(&plan.path, self.vehicle, self.obstacles);
        record.measure_path(&plan.metrics, &compatible);
        record.cost_m = self.cost_m(&plan.path);
    }

    /// Notes the judge's verdict on a foreign path with everything that is measured of one of
    /// ours. Returns the path where it is valid.
    pub fn foreign_path(
        &self,
        record: &mut RunRecord,
        request: &Request,
        samples: &Samples,
    ) -> Option<CurvePath> {
        let begun = Instant::now();
        let verdict = Verdict::new(self.obstacles, self.vehicle, request, samples)?;
        record.judge_s = Some(begun.elapsed().as_secs_f64());
        record.valid = Some(verdict.report.valid);
        record.reason = one_line(&verdict.reason().unwrap_or_default());
        if !verdict.is_measurable(self.obstacles) {
            return None;
        }
        let (path, least_m) = (&verdict.path, verdict.report.min_clearance_m);
        let clearance = ClearanceSummary::new(self.obstacles, self.vehicle, path, least_m);
        let exact = PathMetrics::new(path, self.vehicle, request.goal, clearance)
            .with_travel_time(path, self.vehicle);
        let compatible = CompatibleMetrics::new(path, self.vehicle, self.obstacles);
        record.measure_path(&exact, &compatible);
        record.cost_m = self.cost_m(path);
        verdict.report.valid.then_some(verdict.path)
    }

    /// The cost of driving a path by the usual weights; none of a point.
    pub(crate) fn cost_m(&self, path: &CurvePath) -> Option<f64> {
        if self.vehicle.motion() != Motion::Car {
            return None;
        }
        let cost = DriveCost::default().of_vehicle(self.vehicle);
        let body = Body::new(self.vehicle);
        let meter = DriveMeter::new(self.obstacles, &body, &cost);
        let start = self.obstacles.frame().to_grid(path.start());
        finite(meter.path_m(start, &arcs(path)))
    }
}

fn arcs(path: &CurvePath) -> Vec<Arc> {
    let segments = path.segments().iter();
    let arc = |s: &CurveSegment| Arc::new(s.curvature_per_m, s.direction.sign() * s.length_m);
    segments.map(arc).collect()
}
