//! Via points: whether a path passes each within its tolerance, one after the other.

use super::report::{Violation, ViolationKind};
use crate::geometry::{Pose2, angle_difference};
use crate::path::{CurvePath, CurveSegment};
use crate::scenario::{Request, ViaPoint};
use crate::vehicle::{Motion, Vehicle};

/// Rounding that is no miss: meters, and radians.
const ROUNDING: f64 = 1e-9;
/// The least step along a segment, as a share of the tolerance and in meters. A path that enters
/// a via point's disc for less than that may count as passing by.
const LEAST_STEP_SHARE: f64 = 1e-3;
const LEAST_STEP_M: f64 = 1e-4;
/// Poses that are looked at for how near a path came to a via point that it missed.
const N_LOOKS: f64 = 1000.0;

/// The arc lengths at which via points are passed, and the first point that is missed.
pub(super) struct Passed {
    /// Arc length at the first pose that will do, in the order of the via points.
    pub(super) s_m: Vec<f64>,
    pub(super) missed: Option<Violation>,
}

/// Each via point is passed at the first pose, from where the one before is passed, that is within
/// its tolerance: whatever order can be kept, is kept by the earliest poses.
pub(super) fn check(vehicle: &Vehicle, request: &Request, path: &CurvePath) -> Passed {
    let mut passed = Passed {
        s_m: Vec::new(),
        missed: None,
    };
    let mut from_m = 0.0;
    for (i, via) in request.via.iter().enumerate() {
        let gate = Gate {
            via: *via,
            has_heading: vehicle.motion() == Motion::Car,
        };
        let Some(s_m) = gate.first_passed(path, from_m) else {
            passed.missed = Some(gate.miss(path, from_m, i + 1));
            break;
        };
        passed.s_m.push(s_m);
        from_m = s_m;
    }
    passed
}

/// The via points that a path has to pass.
struct Gate {
    via: ViaPoint,
    /// True if headings count: a point has none.
    has_heading: bool,
}

impl Gate {
    /// The arc length of the first pose from `from_m` on that is within the tolerance.
    fn first_passed(&self, path: &CurvePath, from_m: f64) -> Option<f64> {
        if path.segments().is_empty() {
            return (self.distance_left(path.start(), 0.0) <= 0.0).then_some(0.0);
        }
        let mut before_m = 0.0;
        for segment in path.segments() {
            let after_m = before_m + segment.length_m;
            if after_m >= from_m {
                let skipped_m = (from_m - before_m).max(0.0);
                if let Some(driven_m) = self.first_on(segment, skipped_m) {
                    return Some(before_m + driven_m);
                }
            }
            before_m = after_m;
        }
        None
    }

    /// The first pose of a segment from a driven length on. No step is longer than what is
    /// certainly left to drive, so that none leads past the tolerance.
    fn first_on(&self, segment: &CurveSegment, from_m: f64) -> Option<f64> {
        let least_step_m = (LEAST_STEP_SHARE * self.via.tolerance.xy_m).max(LEAST_STEP_M);
        let mut driven_m = from_m.min(segment.length_m);
        loop {
            let left_m = self.distance_left(segment.pose_at(driven_m), segment.curvature_per_m);
            if left_m <= 0.0 {
                return Some(driven_m);
            }
            if driven_m >= segment.length_m {
                return None;
            }
            driven_m = (driven_m + left_m.max(least_step_m)).min(segment.length_m);
        }
    }

    /// The least length that has to be driven, on a curvature, until a pose can be within the
    /// tolerance; 0 or less where it is.
    fn distance_left(&self, pose: Pose2, curvature_per_m: f64) -> f64 {
        let tolerance = self.via.tolerance;
        let off_m = self.off_m(pose) - tolerance.xy_m - ROUNDING;
        let off_rad = self.off_rad(pose) - tolerance.yaw_rad - ROUNDING;
        if off_rad > 0.0 {
            // Headings change by the curvature per meter; on a line, not at all.
            return off_m.max(off_rad / curvature_per_m.abs());
        }
        off_m
    }

    fn off_m(&self, pose: Pose2) -> f64 {
        pose.position().distance(self.via.position)
    }

    fn off_rad(&self, pose: Pose2) -> f64 {
        match self.via.heading_rad {
            Some(heading_rad) if self.has_heading => {
                angle_difference(pose.heading, heading_rad).abs()
            }
            _ => 0.0,
        }
    }

    /// The violation of a path that does not pass: how near it comes, or how far it is turned
    /// where it comes near enough.
    fn miss(&self, path: &CurvePath, from_m: f64, number: usize) -> Violation {
        let spacing_m = (path.length_m() / N_LOOKS).max(LEAST_STEP_M);
        let samples = path.sample(spacing_m).into_iter();
        let later: Vec<_> = samples.filter(|at| at.s_m >= from_m).collect();
        let tolerance = self.via.tolerance;
        let near = later
            .iter()
            .filter(|at| self.off_m(at.pose) <= tolerance.xy_m);
        let turned = near.min_by(|a, b| self.off_rad(a.pose).total_cmp(&self.off_rad(b.pose)));
        let nearest = later
            .iter()
            .min_by(|a, b| self.off_m(a.pose).total_cmp(&self.off_m(b.pose)));
        let (s_m, pose) = turned
            .or(nearest)
            .map_or((path.length_m(), path.end()), |at| (at.s_m, at.pose));
        let (what, amount, limit, unit) = match turned {
            Some(at) => (
                "heading at ",
                self.off_rad(at.pose),
                tolerance.yaw_rad,
                "rad",
            ),
            None => ("", self.off_m(pose), tolerance.xy_m, "m"),
        };
        let order = if number > 1 {
            format!(" after via point {}", number - 1)
        } else {
            String::new()
        };
        let message = format!(
            "the path misses the {what}via point {number} at ({:.3}, {:.3}){order} by {amount:.6} {unit}; the limit is {limit} {unit}",
            self.via.position.x, self.via.position.y
        );
        Violation {
            kind: ViolationKind::Via,
            s_m,
            pose,
            amount,
            limit,
            message,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point2;
    use crate::path::Direction;
    use proptest::prelude::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    /// Out 10 m, a half turn to the left, and back beside.
    fn hairpin() -> CurvePath {
        let mut path = CurvePath::new(Pose2::default());
        path.push(0.0, 10.0, Direction::Forward);
        path.push(0.5, 2.0 * PI, Direction::Forward);
        path.push(0.0, 10.0, Direction::Forward);
        path
    }

    fn passed(via: Vec<ViaPoint>) -> Passed {
        let path = hairpin();
        let mut request = Request::new(path.start(), path.end());
        request.via = via;
        check(&Vehicle::lei2020(), &request, &path)
    }

    fn at(x: f64, y: f64) -> ViaPoint {
        ViaPoint::new(Point2::new(x, y))
    }

    #[test]
    fn order_counts() {
        let there_and_back = passed(vec![at(5.0, 0.0), at(12.0, 2.0), at(5.0, 4.0)]);
        assert!(there_and_back.missed.is_none());
        let expected = [4.9, 10.0 + PI - 0.1, 14.9 + 2.0 * PI];
        for (s_m, expected) in there_and_back.s_m.iter().zip(expected) {
            assert!((s_m - expected).abs() < 0.01, "{s_m} is not {expected}");
        }
        let back_first = passed(vec![at(5.0, 4.0), at(5.0, 0.0)]);
        assert_eq!(back_first.s_m.len(), 1);
        let missed = back_first.missed.unwrap();
        assert_eq!(missed.kind, ViolationKind::Via);
        assert!(
            missed
                .message
                .contains("via point 2 at (5.000, 0.000) after via point 1 by 4.0"),
            "{}",
            missed.message
        );
    }

    #[test]
    fn headings_count_for_cars_alone() {
        let up = at(12.0, 2.0).with_heading(FRAC_PI_2);
        assert!(passed(vec![up]).missed.is_none());
        let down = passed(vec![at(12.0, 2.0).with_heading(-FRAC_PI_2)]);
        let message = down.missed.unwrap().message;
        assert!(message.contains("heading at via point 1"), "{message}");
        let path = CurvePath::from_polyline(&[Point2::default(), Point2::new(9.0, 0.0)]);
        let mut request = Request::new(path.start(), path.end());
        request.via = vec![at(5.0, 0.0).with_heading(2.0)];
        assert!(check(&Vehicle::point(), &request, &path).missed.is_none());
    }

    proptest! {
        /// Dense samples decide, but for what is passed by a hair.
        #[test]
        fn agrees_with_dense_samples(
            (x, y) in (-1.0..14.0_f64, -1.0..5.0_f64),
            (xy_m, yaw_rad) in (0.05..1.0_f64, 0.05..1.0_f64),
            heading in prop::option::of(-PI..PI),
        ) {
            let via = ViaPoint {
                heading_rad: heading,
                tolerance: crate::scenario::GoalTolerance { xy_m, yaw_rad },
                ..at(x, y)
            };
            let within = |at: &crate::path::PathPose, slack: f64| {
                let off = heading.map_or(0.0, |h| angle_difference(at.pose.heading, h).abs());
                at.pose.position().distance(via.position) <= xy_m + slack && off <= yaw_rad + slack
            };
            let samples = hairpin().sample(1e-3);
            let found = passed(vec![via]).s_m.first().copied();
            if samples.iter().any(|at| within(at, -2e-3)) {
                prop_assert!(found.is_some());
            }
            if !samples.iter().any(|at| within(at, 2e-3)) {
                prop_assert!(found.is_none());
            }
            if let (Some(s_m), Some(first)) = (found, samples.iter().find(|at| within(at, 2e-3))) {
                prop_assert!(s_m >= first.s_m - 2e-3);
            }
        }
    }
}
