//! One question to a planner.

use super::CurvatureMode;
use crate::geometry::{Point2, Pose2};
use crate::vehicle::Gears;
use std::time::Duration;

/// A start, a goal, and the conditions of the path between them. World coordinates.
///
/// Fields may be added: end a literal with `..Request::new(start, goal)` or
/// `..Default::default()`.
///
/// ```
/// use formicar::{Gears, Pose2, Request};
///
/// let request = Request {
///     gears: Gears::Forward,
///     budget_steps: Some(100_000),
///     ..Request::new(Pose2::new(2.0, 3.0, 0.0), Pose2::new(24.0, 9.0, 1.57))
/// };
/// assert_eq!(request.goals().count(), 1);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Request {
    /// Pose of the rear-axle center at the beginning.
    pub start: Pose2,
    /// Pose of the rear-axle center at the end.
    pub goal: Pose2,
    /// Other goals, under the same heading mode and tolerance: the path ends at whichever is
    /// nearest.
    pub other_goals: Vec<Pose2>,
    /// Places that the path passes on its way, in this order.
    pub via: Vec<ViaPoint>,
    /// The rule for the start heading.
    pub start_heading: StartHeading,
    /// The rule for the goal heading.
    pub goal_heading: GoalHeading,
    /// What to do where the vehicle stands in contact with obstacles.
    pub start_contact: StartContact,
    /// The tolerance at the goal.
    pub goal_tolerance: GoalTolerance,
    /// The gears that the path may use.
    pub gears: Gears,
    /// The continuity of the curvature.
    pub curvature: CurvatureMode,
    /// Time after which to give up; it needs an observer with a clock, and alone can make two
    /// runs differ.
    pub deadline: Option<Duration>,
    /// Search steps after which to give up.
    pub budget_steps: Option<u64>,
}

impl Request {
    /// From `start` to `goal` with exact headings, both gears, and no limits.
    pub fn new(start: Pose2, goal: Pose2) -> Self {
        Self {
            start,
            goal,
            ..Self::default()
        }
    }
}

/// A place that a path passes: the rear-axle center comes within the tolerance of it.
///
/// ```
/// use formicar::{Point2, Pose2, Request, ViaPoint};
///
/// let mut request = Request::new(Pose2::new(2.0, 3.0, 0.0), Pose2::new(24.0, 9.0, 0.0));
/// request.via = vec![ViaPoint::new(Point2::new(12.0, 5.0)).with_heading(0.5)];
/// assert_eq!(request.via[0].tolerance, ViaPoint::DEFAULT_TOLERANCE);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViaPoint {
    /// The position, world coordinates.
    pub position: Point2,
    /// The heading there, radians; none where the planner chooses.
    pub heading_rad: Option<f64>,
    /// The tolerance at this point.
    pub tolerance: GoalTolerance,
}

impl ViaPoint {
    /// The tolerance of a via point by default.
    pub const DEFAULT_TOLERANCE: GoalTolerance = GoalTolerance {
        xy_m: 0.1,
        yaw_rad: 0.1,
    };

    /// A place to be passed with any heading, within [`Self::DEFAULT_TOLERANCE`].
    pub fn new(position: Point2) -> Self {
        Self {
            position,
            heading_rad: None,
            tolerance: Self::DEFAULT_TOLERANCE,
        }
    }

    /// The same place with a heading.
    #[must_use]
    pub fn with_heading(self, heading_rad: f64) -> Self {
        Self {
            heading_rad: Some(heading_rad),
            ..self
        }
    }
}

/// The rule for the start heading.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum StartHeading {
    /// As given.
    #[default]
    Exact,
    /// The planner chooses.
    Any,
}

/// The rule for a start at which the body touches obstacles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum StartContact {
    /// The request is refused.
    #[default]
    Refuse,
    /// The vehicle first drives out by the shortest way on which it touches nothing that it does
    /// not touch already; the certified path begins where it is free.
    Escape,
}

/// The rule for the goal heading.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum GoalHeading {
    /// As given.
    #[default]
    Exact,
    /// As given or opposite.
    Bidirectional,
    /// The planner chooses.
    Any,
}

/// The tolerance at the goal.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct GoalTolerance {
    /// Distance in meters, above 0.
    #[cfg_attr(feature = "serde", serde(rename = "xy"))]
    pub xy_m: f64,
    /// Heading difference in radians, above 0.
    #[cfg_attr(feature = "serde", serde(rename = "yaw"))]
    pub yaw_rad: f64,
}

impl Default for GoalTolerance {
    fn default() -> Self {
        Self {
            xy_m: 0.01,
            yaw_rad: 0.01,
        }
    }
}
