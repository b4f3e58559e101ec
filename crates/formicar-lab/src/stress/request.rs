//! Requests: random free poses under random conditions.

use formicar::collision::{Body, Drive, ObstacleMap};
use formicar::geometry::{Point2, Pose2};
use formicar::numeric::RandomStream;
use formicar::scenario::{GoalHeading, GoalTolerance, Request, StartHeading, ViaPoint};
use formicar::vehicle::Gears;
use std::f64::consts::PI;

/// Random poses that may be tried before one is free.
const MAX_TRIES: usize = 300;

/// A request, and whether the vehicle stands free at all poses that it names.
pub(super) fn draw(
    obstacles: &ObstacleMap,
    body: &Body,
    random: &mut RandomStream,
) -> (Request, bool) {
    let poses = Poses { obstacles, body };
    let mut all_free = true;
    let mut pose = |random: &mut RandomStream| {
        let (pose, is_free) = poses.draw(random);
        all_free &= is_free;
        pose
    };
    let (start, goal) = (pose(random), pose(random));
    let n_others = few(random, 3);
    let other_goals = (0..n_others).map(|_| pose(random)).collect();
    let n_via = few(random, 3);
    let via = (0..n_via).map(|_| pose(random)).collect::<Vec<_>>();
    let via = via
        .into_iter()
        .map(|pose| via_point(pose, random))
        .collect();
    let start_heading = match random.below(5) {
        0 => StartHeading::Any,
        _ => StartHeading::Exact,
    };
    let goal_heading = match random.below(6) {
        0 => GoalHeading::Any,
        1 => GoalHeading::Bidirectional,
        _ => GoalHeading::Exact,
    };
    let gears = match random.below(3) {
        0 => Gears::Forward,
        _ => Gears::Both,
    };
    let goal_tolerance = tolerance(random).unwrap_or_default();
    let request = Request {
        other_goals,
        via,
        start_heading,
        goal_heading,
        goal_tolerance,
        gears,
        ..Request::new(start, goal)
    };
    (request, all_free)
}

/// Zero mostly, sometimes one to `most`.
fn few(random: &mut RandomStream, most: usize) -> usize {
    match random.below(6) {
        0 => 1 + random.below(most),
        _ => 0,
    }
}

fn via_point(pose: Pose2, random: &mut RandomStream) -> ViaPoint {
    let via = ViaPoint::new(pose.position());
    let via = match random.below(2) {
        0 => via,
        _ => via.with_heading(pose.heading),
    };
    ViaPoint {
        tolerance: tolerance(random).unwrap_or(via.tolerance),
        ..via
    }
}

/// From a tenth of a millimeter to a meter or so; none where the usual one will do.
fn tolerance(random: &mut RandomStream) -> Option<GoalTolerance> {
    let mut power = |low: f64, high: f64| 10_f64.powf(random.range(low, high));
    let tolerance = GoalTolerance {
        xy_m: power(-4.0, 0.2),
        yaw_rad: power(-4.0, 0.3),
    };
    (random.below(2) == 0).then_some(tolerance)
}

/// Places for a vehicle on a map.
struct Poses<'a> {
    obstacles: &'a ObstacleMap,
    body: &'a Body,
}

impl Poses<'_> {
    /// A random pose, and whether it is free: now and then, and where tries find none, it may not
    /// be.
    fn draw(&self, random: &mut RandomStream) -> (Pose2, bool) {
        let frame = self.obstacles.frame();
        let extent_m = frame.extent_m();
        let n_tries = if random.below(40) == 0 { 1 } else { MAX_TRIES };
        let mut pose = Pose2::default();
        for _ in 0..n_tries {
            let position =
                Point2::new(random.range(0.0, extent_m.x), random.range(0.0, extent_m.y));
            let in_grid = Pose2::at(position, random.range(-PI, PI));
            pose = frame.to_world(in_grid).wrapped();
            // As a planner sees it, after rounding.
            let drive = Drive::at(frame.to_grid(pose));
            if self.obstacles.is_free(self.body, &drive) {
                return (pose, true);
            }
        }
        (pose, false)
    }
}
