//! The poses that a request allows at its ends, and which of its goals a path has reached.

use super::goal_region::poses_around;
use super::{GoalHeading, Request, StartHeading, ViaPoint};
use crate::geometry::{Pose2, angle_difference};
use crate::vehicle::Motion;
use std::f64::consts::{PI, TAU};

/// Headings tried where the planner may choose one.
const N_FREE_HEADINGS: u32 = 72;

/// The goal that a path ends at, or comes nearest to.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ReachedGoal {
    /// Its place among the goals, the first is 0.
    pub index: usize,
    /// The goal.
    pub goal: Pose2,
    /// Distance of the path's end from it, meters.
    pub error_m: f64,
    /// Heading difference as the goal-heading mode counts it, radians.
    pub error_rad: f64,
}

impl Request {
    /// All goals, the first one first.
    pub fn goals(&self) -> impl Iterator<Item = Pose2> + '_ {
        std::iter::once(self.goal).chain(self.other_goals.iter().copied())
    }

    /// The same request with one of its goals alone.
    #[must_use]
    pub fn with_goal(&self, goal: Pose2) -> Self {
        Self {
            goal,
            other_goals: Vec::new(),
            ..self.clone()
        }
    }

    /// The start poses that the start-heading mode allows; those of `any` are a sample.
    pub fn start_poses(&self) -> Vec<Pose2> {
        match self.start_heading {
            StartHeading::Exact => vec![self.start],
            StartHeading::Any => all_around(self.start),
        }
    }

    /// The poses at all goals that the goal-heading mode allows; those of `any` are a sample.
    pub fn goal_poses(&self) -> Vec<Pose2> {
        self.goals()
            .flat_map(|goal| self.poses_at_goal(goal))
            .collect()
    }

    /// The poses at one goal that the goal-heading mode allows; those of `any` are a sample.
    pub fn poses_at_goal(&self, goal: Pose2) -> Vec<Pose2> {
        match self.goal_heading {
            GoalHeading::Exact => vec![goal],
            GoalHeading::Bidirectional => vec![goal, turned(goal, PI)],
            GoalHeading::Any => all_around(goal),
        }
    }

    /// The poses at one goal at which a vehicle can stand, as `is_free` tells: those that the
    /// goal-heading mode allows or, where each of these is taken, others within the tolerance.
    pub(crate) fn free_poses_at_goal(
        &self,
        goal: Pose2,
        is_free: impl Fn(Pose2) -> bool,
    ) -> Vec<Pose2> {
        let poses = self.poses_at_goal(goal);
        let free: Vec<Pose2> = poses.iter().copied().filter(|&p| is_free(p)).collect();
        if !free.is_empty() {
            return free;
        }
        let near = |pose| poses_around(pose, self.goal_tolerance).find(|&p| is_free(p));
        poses.into_iter().filter_map(near).collect()
    }

    /// True where a path that ends at a pose has reached a goal.
    pub fn is_goal(&self, motion: Motion, end: Pose2) -> bool {
        let reached = self.reached_goal(motion, end);
        reached.error_m <= self.goal_tolerance.xy_m
            && reached.error_rad <= self.goal_tolerance.yaw_rad
    }

    /// The goal that a path with this end has reached: that which is nearest in units of the
    /// tolerance, the first of equals. A point has no heading.
    pub fn reached_goal(&self, motion: Motion, end: Pose2) -> ReachedGoal {
        let of_goal = |(index, goal): (usize, Pose2)| ReachedGoal {
            index,
            goal,
            error_m: end.position().distance(goal.position()),
            error_rad: self.goal_error_rad(motion, goal, end),
        };
        let tolerance = self.goal_tolerance;
        let misses = |reached: &ReachedGoal| {
            let (xy, yaw) = (tolerance.xy_m, tolerance.yaw_rad);
            (reached.error_m / xy).max(reached.error_rad / yaw)
        };
        let first = of_goal((0, self.goal));
        let others = self.goals().enumerate().skip(1).map(of_goal);
        others.fold(first, |best, other| {
            if misses(&other) < misses(&best) {
                other
            } else {
                best
            }
        })
    }

    fn goal_error_rad(&self, motion: Motion, goal: Pose2, end: Pose2) -> f64 {
        let off = angle_difference(end.heading, goal.heading).abs();
        match (motion, self.goal_heading) {
            (Motion::Point, _) | (_, GoalHeading::Any) => 0.0,
            (Motion::Car, GoalHeading::Exact) => off,
            (Motion::Car, GoalHeading::Bidirectional) => off.min(PI - off),
        }
    }
}

impl ViaPoint {
    /// The poses at which it may be passed exactly; without a heading they are a sample.
    pub fn poses(&self) -> Vec<Pose2> {
        let pose = Pose2::at(self.position, self.heading_rad.unwrap_or_default());
        match self.heading_rad {
            Some(_) => vec![pose],
            None => all_around(pose),
        }
    }
}

fn turned(pose: Pose2, turn_rad: f64) -> Pose2 {
    Pose2::at(pose.position(), pose.heading + turn_rad).wrapped()
}

fn all_around(pose: Pose2) -> Vec<Pose2> {
    let turn = |i| turned(pose, TAU * f64::from(i) / f64::from(N_FREE_HEADINGS));
    (0..N_FREE_HEADINGS).map(turn).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_goal_that_a_path_ends_at_counts_by_tolerance_and_heading_mode() {
        let mut request = Request::new(Pose2::default(), Pose2::new(5.0, 0.0, 0.0));
        request.other_goals = vec![Pose2::new(5.0, 0.0, PI), Pose2::new(9.0, 1.0, 0.5)];
        let index = |request: &Request, x, y, heading| {
            let reached = request.reached_goal(Motion::Car, Pose2::new(x, y, heading));
            (reached.index, reached.error_rad < 1e-9)
        };
        assert_eq!(index(&request, 5.0, 0.0, 0.0), (0, true));
        assert_eq!(index(&request, 5.0, 0.0, PI), (1, true));
        assert_eq!(index(&request, 9.0, 1.0, 0.5), (2, true));
        request.goal_heading = GoalHeading::Any;
        assert_eq!(index(&request, 5.0, 0.0, PI), (0, true));
        assert_eq!(index(&request, 8.0, 1.0, PI), (2, true));
        assert_eq!(request.goal_poses().len(), 3 * N_FREE_HEADINGS as usize);
    }
}
