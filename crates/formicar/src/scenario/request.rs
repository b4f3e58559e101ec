//! One question to a planner.

use super::CurvatureMode;
use crate::geometry::{Point2, Pose2};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::time::Duration;

/// From where to where, and under which conditions. World coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// Pose of the rear-axle centre at the beginning.
    pub start: Pose2,
    /// Pose of the rear-axle centre at the end.
    pub goal: Pose2,
    /// Other goals, under the same heading mode and tolerance: the path ends at whichever is
    /// nearest.
    pub other_goals: Vec<Pose2>,
    /// Places that the path passes on its way, in this order.
    pub via: Vec<ViaPoint>,
    /// Whether the start heading is fixed.
    pub start_heading: StartHeading,
    /// Whether the goal heading is fixed.
    pub goal_heading: GoalHeading,
    /// How far from the goal a path may end.
    pub goal_tolerance: GoalTolerance,
    /// Which gears may be used.
    pub motion: MotionMode,
    /// Whether the curvature may jump.
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
            other_goals: Vec::new(),
            via: Vec::new(),
            start_heading: StartHeading::default(),
            goal_heading: GoalHeading::default(),
            goal_tolerance: GoalTolerance::default(),
            motion: MotionMode::default(),
            curvature: CurvatureMode::default(),
            deadline: None,
            budget_steps: None,
        }
    }
}

/// A place that a path passes: the rear-axle centre comes within the tolerance of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViaPoint {
    /// Where.
    pub position: Point2,
    /// The heading there, radians; none where the planner chooses.
    pub heading_rad: Option<f64>,
    /// How far off the path may pass.
    pub tolerance: GoalTolerance,
}

impl ViaPoint {
    /// How far off a path may pass where nothing else is asked for.
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

/// Whether the start heading is fixed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum StartHeading {
    /// As given.
    #[default]
    Exact,
    /// The planner chooses.
    Any,
}

/// Whether the goal heading is fixed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum GoalHeading {
    /// As given.
    #[default]
    Exact,
    /// As given or opposite.
    Bidirectional,
    /// The planner chooses.
    Any,
}

/// Which gears may be used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum MotionMode {
    /// Forward only.
    Forward,
    /// Forward and in reverse, reverse at a penalty.
    #[default]
    Reverse,
}

/// How far from the goal a path may end.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GoalTolerance {
    /// Distance in metres, above 0.
    #[serde(rename = "xy")]
    pub xy_m: f64,
    /// Heading difference in radians, above 0.
    #[serde(rename = "yaw")]
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
