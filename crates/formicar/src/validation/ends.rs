//! Start, goal and gears, as the request asks for them.

use super::JOINT_TOLERANCE;
use super::report::{Violation, ViolationKind};
use crate::geometry::{Pose2, angle_difference};
use crate::path::{CurvePath, Direction};
use crate::scenario::{GoalHeading, GoalTolerance, MotionMode, Request, StartHeading};
use crate::vehicle::{Motion, Vehicle};
use std::f64::consts::PI;

/// What was found at both ends and about the gears.
pub(super) struct Ends {
    pub(super) goal_error_m: f64,
    pub(super) goal_error_rad: f64,
    pub(super) violations: Vec<Violation>,
}

pub(super) fn check(vehicle: &Vehicle, request: &Request, path: &CurvePath) -> Ends {
    let holonomic = vehicle.motion() == Motion::Point;
    let end = path.end();
    let goal_error_m = end.position().distance(request.goal.position());
    let goal_error_rad = match (holonomic, request.goal_heading) {
        (true, _) | (_, GoalHeading::Any) => 0.0,
        (_, GoalHeading::Exact) => turn(end, request.goal),
        (_, GoalHeading::Bidirectional) => {
            turn(end, request.goal).min(PI - turn(end, request.goal))
        }
    };
    let start = path.start();
    let start_error_m = start.position().distance(request.start.position());
    let start_error_rad = match (holonomic, request.start_heading) {
        (true, _) | (_, StartHeading::Any) => 0.0,
        (_, StartHeading::Exact) => turn(start, request.start),
    };
    let at_start = (ViolationKind::Start, 0.0, start);
    let at_goal = (ViolationKind::Goal, path.length_m(), end);
    let GoalTolerance { xy_m, yaw_rad } = request.goal_tolerance;
    let misses = [
        (at_start, start_error_m, JOINT_TOLERANCE, "start (metres)"),
        (
            at_start,
            start_error_rad,
            JOINT_TOLERANCE,
            "start heading (radians)",
        ),
        (at_goal, goal_error_m, xy_m, "goal (metres)"),
        (at_goal, goal_error_rad, yaw_rad, "goal heading (radians)"),
    ];
    let misses = misses
        .into_iter()
        .filter(|&(_, amount, limit, _)| amount > limit);
    let violations = misses.map(|((kind, s_m, pose), amount, limit, what)| Violation {
        kind,
        s_m,
        pose,
        amount,
        limit,
        message: format!("the path misses the {what} by {amount:.6}; the limit is {limit}"),
    });
    Ends {
        goal_error_m,
        goal_error_rad,
        violations: violations.chain(forbidden_gear(request, path)).collect(),
    }
}

fn turn(a: Pose2, b: Pose2) -> f64 {
    angle_difference(a.heading, b.heading).abs()
}

fn forbidden_gear(request: &Request, path: &CurvePath) -> Option<Violation> {
    if request.motion == MotionMode::Reverse {
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
