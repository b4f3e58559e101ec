//! Start, goal and gears, as the request asks for them.

use super::JOINT_TOLERANCE;
use super::report::{Violation, ViolationKind};
use crate::geometry::{Pose2, angle_difference};
use crate::path::{CurvePath, Direction};
use crate::scenario::{ReachedGoal, Request, StartHeading};
use crate::vehicle::{Gears, Motion, Vehicle};

/// The findings at both ends and about the gears.
pub(super) struct Ends {
    pub(super) reached: ReachedGoal,
    pub(super) violations: Vec<Violation>,
}

pub(super) fn check(vehicle: &Vehicle, request: &Request, path: &CurvePath) -> Ends {
    let end = path.end();
    let reached = request.reached_goal(vehicle.motion(), end);
    let at_goal = Place {
        kind: ViolationKind::Goal,
        s_m: path.length_m(),
        pose: end,
    };
    let tolerance = request.goal_tolerance;
    let at_end = [
        at_goal.miss("goal", reached.error_m, tolerance.xy_m, "m"),
        at_goal.miss("goal heading", reached.error_rad, tolerance.yaw_rad, "rad"),
        forbidden_gear(request, path),
    ];
    let mut violations = missed_start(vehicle, request, path.start(), JOINT_TOLERANCE);
    violations.extend(at_end.into_iter().flatten());
    Ends {
        reached,
        violations,
    }
}

/// The message for a first pose that misses the start of a request by more than a tolerance, meters
/// and radians: the place, and the heading where that is asked for.
pub fn missed_start(
    vehicle: &Vehicle,
    request: &Request,
    first: Pose2,
    tolerance: f64,
) -> Vec<Violation> {
    let (error_m, error_rad) = start_error(vehicle, request, first);
    let at_start = Place {
        kind: ViolationKind::Start,
        s_m: 0.0,
        pose: first,
    };
    let missed = [
        at_start.miss("start", error_m, tolerance, "m"),
        at_start.miss("start heading", error_rad, tolerance, "rad"),
    ];
    missed.into_iter().flatten().collect()
}

/// An end of the path.
struct Place {
    kind: ViolationKind,
    s_m: f64,
    pose: Pose2,
}

impl Place {
    fn miss(&self, what: &str, amount: f64, limit: f64, unit: &str) -> Option<Violation> {
        let message = || {
            format!("the path misses the {what} by {amount:.6} {unit}; the limit is {limit} {unit}")
        };
        (amount > limit).then(|| Violation {
            kind: self.kind,
            s_m: self.s_m,
            pose: self.pose,
            amount,
            limit,
            message: message(),
        })
    }
}

/// Distance and heading difference from the start; a point has no heading.
fn start_error(vehicle: &Vehicle, request: &Request, start: Pose2) -> (f64, f64) {
    let error_rad = match (vehicle.motion(), request.start_heading) {
        (Motion::Point, _) | (_, StartHeading::Any) => 0.0,
        (Motion::Car, StartHeading::Exact) => turn(start, request.start),
    };
    (
        start.position().distance(request.start.position()),
        error_rad,
    )
}

fn turn(a: Pose2, b: Pose2) -> f64 {
    angle_difference(a.heading, b.heading).abs()
}

fn forbidden_gear(request: &Request, path: &CurvePath) -> Option<Violation> {
    if request.gears == Gears::Both {
        return None;
    }
    let mut s_m = 0.0;
    for segment in path.segments() {
        if segment.direction == Direction::Reverse && segment.length_m > 0.0 {
            let message = format!(
                "drives {:.3} m in reverse from ({:.3}, {:.3}), s = {s_m:.3} m; the request allows forward motion only",
                segment.length_m, segment.start.x, segment.start.y
            );
            let (amount, limit) = (segment.length_m, 0.0);
            return Some(Violation {
                kind: ViolationKind::Gear,
                s_m,
                pose: segment.start,
                amount,
                limit,
                message,
            });
        }
        s_m += segment.length_m;
    }
    None
}
