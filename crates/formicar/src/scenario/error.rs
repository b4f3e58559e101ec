//! Requests that cannot be planned for, and Nav2's codes for outcomes.

use crate::map::Cell;
use thiserror::Error;

/// An error in a request.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum ScenarioError {
    /// Something that every request needs.
    #[error("{what} is missing; hint: give it as x, y, heading in meters and radians")]
    Missing {
        /// The name of the missing value.
        what: &'static str,
    },
    /// A number that is infinite or not a number.
    #[error("{what} is not finite: {value}")]
    NotFinite {
        /// The name of the number.
        what: &'static str,
        /// As printed.
        value: String,
    },
    /// A number outside its range.
    #[error("{what} = {value}; it must be {range}")]
    OutOfRange {
        /// The name of the number.
        what: &'static str,
        /// Its value.
        value: f64,
        /// The allowed values.
        range: &'static str,
    },
    /// A heading beyond a turn, which was meant in degrees.
    #[error(
        "{what} heading = {heading_rad}; it must be in radians, within a turn{}",
        in_degrees(*heading_rad)
    )]
    BeyondATurn {
        /// The owner of the heading.
        what: &'static str,
        /// Its value.
        heading_rad: f64,
    },
    /// A tolerance that is not above 0.
    #[error("{what} {unit} = {value}; it must be finite and above 0")]
    BadTolerance {
        /// The owner of the tolerance: the goal or a via point.
        what: &'static str,
        /// `xy` or `yaw`.
        unit: &'static str,
        /// Its value.
        value: f64,
    },
    /// A goal and a list of goals in one request.
    #[error("goal and goals are both given; hint: put every goal into goals")]
    GoalAndGoals,
    /// Continuous curvature for a vehicle that does not say how fast its wheels turn.
    #[error(
        "continuous curvature needs a rate, and the vehicle has no {missing}; hint: give max_rate_per_m2, or a vehicle with max_steer_rate_rad_per_s, speed_mps and wheelbase_m"
    )]
    UnknownCurvatureRate {
        /// The measure that the vehicle does not have.
        missing: &'static str,
    },
    /// Continuous curvature for a point.
    #[error(
        "continuous curvature is for cars, the vehicle is a point; hint: ask for curvature \"arcs\""
    )]
    NoCurvature,
    /// A pose off the map.
    #[error("{which} ({x:.3}, {y:.3}) m lies outside the map, which spans ({low_x:.3}, {low_y:.3}) to ({high_x:.3}, {high_y:.3}) m{}", yaw_note(*yaw_rad))]
    OutsideMap {
        /// Start, goal or via point.
        which: Endpoint,
        /// Meters.
        x: f64,
        /// Meters.
        y: f64,
        /// Lower left corner of the map, meters.
        low_x: f64,
        /// Lower left corner of the map, meters.
        low_y: f64,
        /// Opposite corner, meters, before the map's yaw is applied.
        high_x: f64,
        /// Opposite corner, meters, before the map's yaw is applied.
        high_y: f64,
        /// The map's yaw about its lower left corner.
        yaw_rad: f64,
    },
    /// A pose where the vehicle does not fit.
    #[error("{which} ({x:.3}, {y:.3}) m: {problem}; hint: {hint}")]
    Occupied {
        /// Start, goal or via point.
        which: Endpoint,
        /// Meters.
        x: f64,
        /// Meters.
        y: f64,
        /// The obstacle, and the depth of the overlap.
        problem: String,
        /// The nearest pose where the vehicle fits.
        hint: String,
        /// The obstacle cells that its footprint covers.
        cells: Vec<Cell>,
    },
}

/// The hint for a number that may be in degrees.
fn in_degrees(heading: f64) -> String {
    if heading.abs() > 3600.0 {
        return String::new();
    }
    format!("; hint: {heading} degrees are {:.4}", heading.to_radians())
}

fn yaw_note(yaw_rad: f64) -> String {
    if yaw_rad == 0.0 {
        String::new()
    } else {
        format!(" (turned by {yaw_rad:.4} rad about the first)")
    }
}

/// An end of a path, or of one of its legs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Endpoint {
    /// The first pose.
    Start,
    /// The last pose.
    Goal,
    /// A via point, counted from 1.
    Via(usize),
}

impl std::fmt::Display for Endpoint {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Start => f.write_str("start"),
            Self::Goal => f.write_str("goal"),
            Self::Via(n) => write!(f, "via point {n}"),
        }
    }
}

/// The outcome codes of Nav2's `ComputePathToPose` action.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "SCREAMING_SNAKE_CASE"))]
#[repr(u16)]
#[non_exhaustive]
pub enum ErrorCode {
    /// A path was found.
    None = 0,
    /// Any failure without a code of its own.
    Unknown = 200,
    /// No such planner.
    InvalidPlanner = 201,
    /// A frame could not be transformed.
    TfError = 202,
    /// The start lies off the map.
    StartOutsideMap = 203,
    /// The goal lies off the map.
    GoalOutsideMap = 204,
    /// The vehicle does not fit at the start.
    StartOccupied = 205,
    /// The vehicle does not fit at the goal.
    GoalOccupied = 206,
    /// The deadline passed.
    Timeout = 207,
    /// No path was found.
    NoValidPath = 208,
}

impl ErrorCode {
    /// Nav2's name of the code.
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "NONE",
            Self::Unknown => "UNKNOWN",
            Self::InvalidPlanner => "INVALID_PLANNER",
            Self::TfError => "TF_ERROR",
            Self::StartOutsideMap => "START_OUTSIDE_MAP",
            Self::GoalOutsideMap => "GOAL_OUTSIDE_MAP",
            Self::StartOccupied => "START_OCCUPIED",
            Self::GoalOccupied => "GOAL_OCCUPIED",
            Self::Timeout => "TIMEOUT",
            Self::NoValidPath => "NO_VALID_PATH",
        }
    }

    /// Nav2's number of the code.
    pub fn number(self) -> u16 {
        self as u16
    }
}

impl From<&ScenarioError> for ErrorCode {
    fn from(error: &ScenarioError) -> Self {
        match error {
            ScenarioError::OutsideMap {
                which: Endpoint::Start,
                ..
            } => Self::StartOutsideMap,
            // A via point is the goal of a part of the path.
            ScenarioError::OutsideMap {
                which: Endpoint::Goal | Endpoint::Via(_),
                ..
            } => Self::GoalOutsideMap,
            ScenarioError::Occupied {
                which: Endpoint::Start,
                ..
            } => Self::StartOccupied,
            ScenarioError::Occupied {
                which: Endpoint::Goal | Endpoint::Via(_),
                ..
            } => Self::GoalOccupied,
            _ => Self::Unknown,
        }
    }
}
