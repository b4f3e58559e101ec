//! The poses at which a path may end.

use super::{GoalHeading, GoalTolerance, Request};
use crate::geometry::{Point2, Pose2, angle_difference};
use std::f64::consts::{PI, TAU};

/// All goals of a request with their tolerance and heading mode.
///
/// ```
/// use formicar::scenario::{GoalRegion, GoalTolerance};
/// use formicar::{Pose2, Request};
///
/// let request = Request {
///     goal_tolerance: GoalTolerance { xy_m: 0.25, yaw_rad: 0.1 },
///     ..Request::new(Pose2::default(), Pose2::new(5.0, 0.0, 0.0))
/// };
/// let region = GoalRegion::of(&request);
/// assert!(region.contains(Pose2::new(4.8, 0.1, -0.05)));
/// assert!(!region.contains(Pose2::new(4.7, 0.1, 0.0)));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct GoalRegion {
    goals: Vec<Pose2>,
    heading: GoalHeading,
    tolerance: GoalTolerance,
}

/// Ends stay this share inside of the tolerance, so that rounding leads none out of it.
const INSIDE: f64 = 1.0 - 1e-6;
/// Poses that are drawn stay a little further inside, for the same reason.
const DRAWN_INSIDE: f64 = 1.0 - 2e-6;
/// Shares of the distance and of the turn at which the surroundings of a blocked goal are looked
/// at, the nearest first; the least covers a goal that is blocked by a hair.
const SHARES: [f64; 4] = [0.1, 0.4, 0.7, 0.99];
/// Directions that are looked at around a blocked goal.
const N_DIRECTIONS: u32 = 16;

impl GoalRegion {
    /// That of a request, in its coordinates.
    pub fn of(request: &Request) -> Self {
        Self {
            goals: request.goals().collect(),
            heading: request.goal_heading,
            tolerance: request.goal_tolerance,
        }
    }

    /// The same in other coordinates of the same scale.
    #[must_use]
    pub fn map_poses(&self, to: impl Fn(Pose2) -> Pose2) -> Self {
        Self {
            goals: self.goals.iter().map(|&goal| to(goal)).collect(),
            ..*self
        }
    }

    /// The tolerance.
    pub fn tolerance(&self) -> GoalTolerance {
        self.tolerance
    }

    /// True where there is room for another end: a heading that is free, or a tolerance above the
    /// default, which is there for rounding.
    pub fn has_room(&self) -> bool {
        let GoalTolerance { xy_m, yaw_rad } = GoalTolerance::default();
        let is_wide = self.tolerance.xy_m > xy_m || self.tolerance.yaw_rad > yaw_rad;
        is_wide || self.heading == GoalHeading::Any
    }

    /// True where a car may end at a pose.
    pub fn contains(&self, pose: Pose2) -> bool {
        self.goals.iter().any(|&goal| {
            pose.position().distance(goal.position()) <= INSIDE * self.tolerance.xy_m
                && self.turn_rad(goal, pose.heading).abs() <= INSIDE * self.tolerance.yaw_rad
        })
    }

    /// A pose of the region near another one: at two numbers from 0 to 1 for the position in the
    /// disc of the nearest goal, and one for the heading.
    pub fn pose_near(&self, pose: Pose2, [radius, direction, turn]: [f64; 3]) -> Option<Pose2> {
        let apart_m = |goal: &&Pose2| goal.position().distance(pose.position());
        let nearest = |a: &&Pose2, b: &&Pose2| apart_m(a).total_cmp(&apart_m(b));
        let goal = *self.goals.iter().min_by(nearest)?;
        let from_goal_m = DRAWN_INSIDE * self.tolerance.xy_m * radius.sqrt();
        let position = goal.position() + Point2::unit(TAU * direction) * from_goal_m;
        // The heading of the goal that is meant: where it is free, that of the pose.
        let meant_rad = pose.heading - self.turn_rad(goal, pose.heading);
        let turn_rad = DRAWN_INSIDE * self.tolerance.yaw_rad * (2.0 * turn - 1.0);
        Some(Pose2::at(position, meant_rad + turn_rad))
    }

    /// The turn from the nearest heading allowed at a goal to a heading.
    fn turn_rad(&self, goal: Pose2, heading_rad: f64) -> f64 {
        let off_rad = angle_difference(heading_rad, goal.heading);
        match self.heading {
            GoalHeading::Bidirectional if off_rad.abs() > 0.5 * PI => {
                off_rad - PI.copysign(off_rad)
            }
            GoalHeading::Exact | GoalHeading::Bidirectional => off_rad,
            GoalHeading::Any => 0.0,
        }
    }
}

/// Poses around a goal pose within a tolerance, from the nearest to the farthest.
pub(crate) fn poses_around(
    goal: Pose2,
    tolerance: GoalTolerance,
) -> impl Iterator<Item = Pose2> + use<> {
    let turns = [0.0, 0.5, -0.5, 0.99, -0.99].map(|share| share * tolerance.yaw_rad);
    let offsets = SHARES.into_iter().flat_map(move |share| {
        (0..N_DIRECTIONS).map(move |i| {
            let direction = Point2::unit(TAU * f64::from(i) / f64::from(N_DIRECTIONS));
            direction * (share * tolerance.xy_m)
        })
    });
    std::iter::once(Point2::default())
        .chain(offsets)
        .flat_map(move |offset| {
            turns.map(|turn_rad| Pose2::at(goal.position() + offset, goal.heading + turn_rad))
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn region(heading: GoalHeading) -> GoalRegion {
        GoalRegion::of(&Request {
            goal_heading: heading,
            goal_tolerance: GoalTolerance {
                xy_m: 0.5,
                yaw_rad: 0.2,
            },
            other_goals: vec![Pose2::new(9.0, 0.0, 0.0)],
            ..Request::new(Pose2::default(), Pose2::new(5.0, 0.0, 1.0))
        })
    }

    #[test]
    fn headings_count_as_the_mode_says() {
        for (heading, wanted) in [
            (GoalHeading::Exact, [true, false, false]),
            (GoalHeading::Bidirectional, [true, true, false]),
            (GoalHeading::Any, [true, true, true]),
        ] {
            let region = region(heading);
            let held = [0.9, 1.1 + PI, 2.0].map(|rad| region.contains(Pose2::new(5.3, 0.3, rad)));
            assert_eq!(held, wanted, "{heading:?}");
        }
    }

    #[test]
    fn poses_drawn_are_inside_and_belong_to_the_nearest_goal() {
        for heading in [
            GoalHeading::Exact,
            GoalHeading::Bidirectional,
            GoalHeading::Any,
        ] {
            let region = region(heading);
            for draw in [[1.0, 0.3, 1.0], [0.2, 0.9, 0.0], [0.0, 0.0, 0.5]] {
                let pose = region.pose_near(Pose2::new(8.0, 1.0, 3.5), draw).unwrap();
                assert!(region.contains(pose), "{heading:?} {pose:?}");
                assert!(pose.x > 8.0);
            }
        }
    }

    #[test]
    fn surroundings_of_a_goal_are_within_its_tolerance() {
        let (goal, region) = (Pose2::new(5.0, 0.0, 1.0), region(GoalHeading::Exact));
        let mut poses = poses_around(goal, region.tolerance());
        assert_eq!(poses.next(), Some(goal));
        assert!(poses.all(|pose| region.contains(pose)));
    }
}
