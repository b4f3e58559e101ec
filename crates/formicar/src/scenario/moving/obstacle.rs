//! A moving obstacle as users write it down.

/// Something that moves: a shape, its motion, and how fast the prediction gets uncertain.
///
/// In JSON:
///
/// ```text
/// {"name": "cart", "shape": {"polygon": [[-0.5, -0.3], [0.5, -0.3], [0.5, 0.3], [-0.5, 0.3]]},
///  "motion": {"velocity": {"pose": [4, 1, 0], "velocity_mps": [0.8, 0]}}, "growth_mps": 0.05}
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct MovingObstacle {
    /// Its name in messages and pictures; its number where left out.
    #[cfg_attr(
        feature = "serde",
        serde(default, skip_serializing_if = "Option::is_none")
    )]
    pub name: Option<String>,
    /// Its body.
    pub shape: ObstacleShape,
    /// Its predicted motion.
    pub motion: ObstacleMotion,
    /// How fast the body grows on every side with time, since predictions err, meters per second;
    /// 0 where left out.
    #[cfg_attr(feature = "serde", serde(default))]
    pub growth_mps: f64,
}

/// The body of a moving obstacle, in the frame of its pose.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(
    feature = "serde",
    serde(rename_all = "snake_case", deny_unknown_fields)
)]
pub enum ObstacleShape {
    /// A disc about the pose.
    Disc {
        /// Its radius, meters, above 0.
        radius_m: f64,
    },
    /// The corners of a convex polygon, `[x, y]`, meters, in either order.
    Polygon(Vec<[f64; 2]>),
}

/// A predicted motion; headings in radians.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(
    feature = "serde",
    serde(rename_all = "snake_case", deny_unknown_fields)
)]
pub enum ObstacleMotion {
    /// A constant velocity in the frame of the map; the heading stays as it is.
    Velocity {
        /// Pose at time 0, `[x, y, heading]`.
        pose: [f64; 3],
        /// Meters per second along the axes of the map.
        velocity_mps: [f64; 2],
    },
    /// A constant speed along the heading, which turns at a constant rate.
    Turn {
        /// Pose at time 0, `[x, y, heading]`.
        pose: [f64; 3],
        /// Meters per second, negative backwards.
        speed_mps: f64,
        /// Radians per second, positive to the left.
        rate_rad_per_s: f64,
    },
    /// Poses at given times; between two of them the obstacle moves along a line and turns the
    /// shorter way, both evenly. Before the first and after the last it stands.
    Waypoints(Vec<TimedWaypoint>),
}

/// A pose at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct TimedWaypoint {
    /// Time, seconds.
    pub t_s: f64,
    /// `[x, y, heading]`.
    pub pose: [f64; 3],
}
