//! The judge's word on a foreign path, for a request.

use formicar::collision::ObstacleMap;
use formicar::path::CurvePath;
use formicar::scenario::Request;
use formicar::validation::{
    FOREIGN_CURVATURE_SLACK, ForeignPath, Report, Samples, Violation, ViolationKind, judge,
    missed_start,
};
use formicar::vehicle::Vehicle;

/// Tolerance at the start of a sampled path, meters and radians: its samples are rounded.
pub const START_TOLERANCE: f64 = 1e-3;

/// A path read from samples, with the judge's findings.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// The path that was judged.
    pub path: CurvePath,
    /// The findings; the slack that samples get is taken off.
    pub report: Report,
}

impl Verdict {
    /// On samples; none where there are none.
    pub fn new(
        obstacles: &ObstacleMap,
        vehicle: &Vehicle,
        request: &Request,
        samples: &Samples,
    ) -> Option<Self> {
        let path = ForeignPath::new(samples, vehicle.motion())?;
        let (path, report) = path.judged_by(|path| findings(obstacles, vehicle, request, path));
        Some(Self {
            path: path.clone(),
            report,
        })
    }

    /// The reason why it cannot be driven, in a sentence or two.
    pub fn reason(&self) -> Option<String> {
        let violations = &self.report.violations;
        let first = violations.first()?;
        Some(match violations.len() {
            1 => first.message.clone(),
            n => format!("{} (the first of {n})", first.message),
        })
    }

    /// True if it is of a size that can be measured: a path that lies elsewhere may be endless.
    pub fn is_measurable(&self, obstacles: &ObstacleMap) -> bool {
        let extent = obstacles.frame().extent_m();
        let is_malformed = |v: &Violation| v.kind == ViolationKind::Malformed;
        let is_short = self.path.length_m() <= MAX_LAPS * (extent.x + extent.y);
        is_short && !self.report.violations.iter().any(is_malformed)
    }
}

/// Longest path that is measured, in times the width and height of the map.
const MAX_LAPS: f64 = 100.0;

/// The judge's findings without those that rounding and sampling may cause.
fn findings(
    obstacles: &ObstacleMap,
    vehicle: &Vehicle,
    request: &Request,
    path: &CurvePath,
) -> Report {
    let mut report = judge(obstacles, vehicle, request, path);
    report.violations.retain(|violation| match violation.kind {
        ViolationKind::Curvature => {
            violation.amount > violation.limit * (1.0 + FOREIGN_CURVATURE_SLACK)
        }
        kind => kind != ViolationKind::Start,
    });
    let missed = missed_start(vehicle, request, path.start(), START_TOLERANCE);
    report.violations.splice(0..0, missed);
    report.valid = report.violations.is_empty();
    report
}

#[cfg(test)]
mod tests {
    use super::*;
    use formicar::geometry::{Point2, Pose2};
    use formicar::map::OccupancyGrid;
    use formicar::scenario::StartHeading;

    fn ground() -> (ObstacleMap, Vehicle, Request) {
        let rows = ["..........................................."; 12];
        let map = OccupancyGrid::from_rows(&rows, 0.5).unwrap();
        let request = Request::new(Pose2::new(4.0, 3.0, 0.0), Pose2::new(12.0, 3.0, 0.0));
        (ObstacleMap::new(&map), Vehicle::sedan(), request)
    }

    fn line(from: f64, to: f64, offset: f64) -> Samples {
        let xs = (0..=80).map(|i| from + (to - from) * f64::from(i) / 80.0);
        let points: Vec<_> = xs.map(|x| Point2::new(x, 3.0 + offset)).collect();
        Samples {
            headings: Some(vec![0.0; points.len()]),
            points,
            rounding_m: 0.0,
        }
    }

    #[test]
    fn a_path_from_start_to_goal_is_valid() {
        let (obstacles, vehicle, request) = ground();
        let of = |samples: &Samples| Verdict::new(&obstacles, &vehicle, &request, samples).unwrap();
        assert_eq!(of(&line(4.0, 12.0, 0.0)).reason(), None);
        assert!(of(&line(4.0, 12.0, 0.0005)).report.valid);
        let off = of(&line(4.0, 12.0, 0.002));
        let reason = off.reason().unwrap();
        assert!(reason.contains("misses the start"), "{reason}");
        assert!(reason.contains("the limit is 0.001 m"), "{reason}");
        assert_eq!(off.report.violations.len(), 1, "{off:?}");
        let mut turned = line(4.0, 12.0, 0.0);
        turned.headings = turned.headings.map(|all| vec![0.01; all.len()]);
        let first = of(&turned).report.violations.remove(0);
        assert_eq!(
            (first.kind, first.limit),
            (ViolationKind::Start, START_TOLERANCE)
        );
        let told = "misses the start heading by 0.010000 rad; the limit is 0.001 rad";
        assert!(first.message.contains(told), "{first:?}");
        let anyhow = Request {
            start_heading: StartHeading::Any,
            ..request.clone()
        };
        let free = Verdict::new(&obstacles, &vehicle, &anyhow, &turned).unwrap();
        let is_start = |v: &Violation| v.kind == ViolationKind::Start;
        assert!(!free.report.violations.iter().any(is_start), "{free:?}");
        let short = of(&line(4.0, 10.0, 0.0));
        assert!(short.reason().unwrap().contains("misses the goal"));
        let far = of(&line(4.0, 1e6, 0.0));
        assert!(!far.report.valid && !far.is_measurable(&obstacles));
        let bare = Samples {
            headings: None,
            ..line(4.0, 12.0, 0.0)
        };
        assert!(of(&bare).report.valid);
        let none = Samples {
            points: Vec::new(),
            headings: None,
            rounding_m: 0.0,
        };
        assert!(Verdict::new(&obstacles, &vehicle, &request, &none).is_none());
    }

    #[test]
    fn a_curve_tighter_than_the_vehicle_is_told() {
        let (obstacles, vehicle, _) = ground();
        let radius_m = 0.8 * vehicle.min_turning_radius_m();
        let center = Point2::new(8.0, 1.2);
        let at = |i: i32| {
            let turn = 0.01 * f64::from(i) - 0.1;
            let point = center + Point2::unit(turn + std::f64::consts::FRAC_PI_2) * radius_m;
            (point, turn)
        };
        let (points, headings): (Vec<_>, Vec<_>) = (0..20).rev().map(at).unzip();
        let samples = Samples {
            points,
            headings: Some(headings),
            rounding_m: 0.0,
        };
        let ends =
            [0, 19].map(|i| Pose2::at(samples.points[i], samples.headings.as_ref().unwrap()[i]));
        let request = Request::new(ends[0], ends[1]);
        let verdict = Verdict::new(&obstacles, &vehicle, &request, &samples).unwrap();
        let kinds: Vec<_> = verdict.report.violations.iter().map(|v| v.kind).collect();
        assert!(kinds.contains(&ViolationKind::Curvature), "{kinds:?}");
    }
}
