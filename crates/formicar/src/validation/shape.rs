//! The path by itself: numbers, joints, curvature.

use super::JOINT_TOLERANCE;
use super::report::{Violation, ViolationKind};
use crate::geometry::{Pose2, angle_difference};
use crate::path::{CurvePath, CurveSegment};
use crate::vehicle::{Motion, Vehicle};

/// The longest segment that is judged, meters.
const MAX_LENGTH_M: f64 = 1e5;
/// The most that a segment may turn, radians.
const MAX_TURN_RAD: f64 = 1e4;

/// Segments with numbers that are none, or beyond what any vehicle drives; nothing else can be
/// said of them.
pub(super) fn malformed(path: &CurvePath) -> Vec<Violation> {
    let bad = |s: &CurveSegment| {
        !(s.start.is_finite()
            && (0.0..=MAX_LENGTH_M).contains(&s.length_m)
            && s.max_abs_curvature_per_m() * s.length_m <= MAX_TURN_RAD
            && s.curvature_per_m.is_finite()
            && s.curvature_rate_per_m2.is_finite())
    };
    let start = (!path.start().is_finite()).then(|| {
        malformation(
            path.start(),
            f64::NAN,
            "the start pose is not finite".into(),
        )
    });
    let segments = path.segments().iter().enumerate().filter(|(_, s)| bad(s)).map(|(i, s)| {
        let message = format!(
            "segment {i} has length {} m, curvature {} 1/m, which changes by {} 1/m^2, and start ({}, {}, {}); all must be finite, the length in 0 to {MAX_LENGTH_M} m, the turn at most {MAX_TURN_RAD} rad",
            s.length_m, s.curvature_per_m, s.curvature_rate_per_m2, s.start.x, s.start.y, s.start.heading
        );
        malformation(s.start, s.length_m, message)
    });
    start.into_iter().chain(segments).collect()
}

fn malformation(pose: Pose2, amount: f64, message: String) -> Violation {
    Violation {
        kind: ViolationKind::Malformed,
        s_m: 0.0,
        pose,
        amount,
        limit: 0.0,
        message,
    }
}

/// Joints and curvature.
pub(super) fn check(vehicle: &Vehicle, path: &CurvePath, curvature_slack: f64) -> Vec<Violation> {
    let mut violations = Vec::new();
    let mut expected = path.start();
    let mut s_m = 0.0;
    for segment in path.segments() {
        violations.extend(joint(vehicle, expected, segment.start, s_m));
        violations.extend(curvature(vehicle, segment, s_m, curvature_slack));
        expected = segment.end();
        s_m += segment.length_m;
    }
    violations
}

/// Largest absolute curvature of a path.
pub(super) fn max_curvature_per_m(path: &CurvePath) -> f64 {
    path.segments()
        .iter()
        .fold(0.0, |most, s| s.max_abs_curvature_per_m().max(most))
}

fn joint(vehicle: &Vehicle, expected: Pose2, found: Pose2, s_m: f64) -> Option<Violation> {
    let gap_m = expected.position().distance(found.position());
    let kink_rad = match vehicle.motion() {
        Motion::Point => 0.0,
        Motion::Car => angle_difference(found.heading, expected.heading).abs(),
    };
    let (amount, unit, what) = if gap_m > JOINT_TOLERANCE {
        (gap_m, "m", "jumps")
    } else if kink_rad > JOINT_TOLERANCE {
        (kink_rad, "rad", "turns on the spot")
    } else {
        return None;
    };
    Some(Violation {
        kind: ViolationKind::Discontinuity,
        s_m,
        pose: found,
        amount,
        limit: JOINT_TOLERANCE,
        message: format!(
            "the path {what} by {amount:.6} {unit} at ({:.3}, {:.3}), s = {s_m:.3} m; the limit is {JOINT_TOLERANCE} {unit}",
            found.x, found.y
        ),
    })
}

fn curvature(vehicle: &Vehicle, segment: &CurveSegment, s_m: f64, slack: f64) -> Option<Violation> {
    let limit = vehicle.max_curvature_per_m();
    let amount = segment.max_abs_curvature_per_m();
    if amount <= limit * (1.0 + slack) || segment.length_m == 0.0 {
        return None;
    }
    Some(Violation {
        kind: ViolationKind::Curvature,
        s_m,
        pose: segment.start,
        amount,
        limit,
        message: format!(
            "curvature {amount:.6} 1/m (radius {:.3} m) over {:.3} m from ({:.3}, {:.3}), s = {s_m:.3} m; the vehicle's limit is {limit:.6} 1/m (radius {:.3} m)",
            1.0 / amount,
            segment.length_m,
            segment.start.x,
            segment.start.y,
            1.0 / limit
        ),
    })
}
