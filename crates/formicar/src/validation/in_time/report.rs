//! The findings on a drive in time.

use crate::geometry::Pose2;
use std::ops::Deref;

/// The judge's findings on a drive.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct TimedReport {
    /// True if nothing was violated.
    pub valid: bool,
    /// True if the drive ends at the end of the path.
    pub arrives: bool,
    /// Time of the drive, seconds.
    pub duration_s: f64,
    /// Time up to which obstacles are predicted, seconds; from then on they are taken to stand.
    pub horizon_s: f64,
    /// The distance that was to be kept, meters.
    pub distance_m: f64,
    /// Proven least distance of the body (with its safety margin) from moving obstacles (with their
    /// uncertainty) over drive and horizon, meters; too low by at most 0.1 mm. Null without
    /// obstacles.
    pub min_distance_m: Option<f64>,
    /// Where and when the body comes nearest to an obstacle.
    pub nearest: Option<Nearest>,
    /// Highest speed, m/s.
    pub max_speed_mps: f64,
    /// Largest acceleration along the path, m/s^2.
    pub max_acceleration_mps2: f64,
    /// Largest deceleration, m/s^2.
    pub max_braking_mps2: f64,
    /// Largest lateral acceleration, m/s^2.
    pub max_lateral_mps2: f64,
    /// Fastest change of the steering angle while driving, rad/s; null where the wheelbase is
    /// unknown.
    pub max_steer_rate_rad_per_s: Option<f64>,
    /// Largest jerk within a phase, m/s^3.
    pub max_jerk_mps3: f64,
    /// The violations, in order of time.
    pub violations: Vec<TimedViolation>,
}

/// The place where the body comes nearest to an obstacle.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct Nearest {
    /// The obstacle's name, or its number counted from 1.
    pub obstacle: String,
    /// Time, seconds.
    pub t_s: f64,
    /// Arc length, meters.
    pub s_m: f64,
    /// The vehicle.
    pub pose: Pose2,
    /// The distance, meters; negative where they overlap, by how much one must move.
    pub distance_m: f64,
}

/// A violation during a drive.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct TimedViolation {
    /// The kind of violation.
    pub kind: TimedViolationKind,
    /// Time where it is worst, or where it was found, seconds.
    pub t_s: f64,
    /// Arc length there, meters.
    pub s_m: f64,
    /// The vehicle there.
    pub pose: Pose2,
    /// The value found, in the unit of the limit.
    pub amount: f64,
    /// The value allowed.
    pub limit: f64,
    /// Both as a sentence with units.
    pub message: String,
}

/// Kinds of violations in time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum TimedViolationKind {
    /// The body comes too near to a moving obstacle.
    Distance,
    /// The speed exceeds its limit, or that of a zone.
    Speed,
    /// The acceleration or the deceleration exceeds its limit.
    Acceleration,
    /// The lateral acceleration exceeds its limit.
    Lateral,
    /// The wheels turn faster than they can, or had no time to turn while the vehicle stood.
    SteerRate,
    /// The jerk exceeds its limit, or the acceleration jumps where it is limited.
    Jerk,
    /// The gear changes while the vehicle moves.
    Cusp,
    /// Phases that do not join, or do not begin or end as they should.
    Discontinuity,
    /// A number that is not finite, a negative duration, or a drive backwards along the path.
    Malformed,
}

impl TimedViolationKind {
    /// The kind in words.
    pub fn in_words(self) -> &'static str {
        match self {
            Self::Distance => "distance",
            Self::Speed => "speed",
            Self::Acceleration => "acceleration",
            Self::Lateral => "lateral acceleration",
            Self::SteerRate => "steering rate",
            Self::Jerk => "jerk",
            Self::Cusp => "change of gear",
            Self::Discontinuity => "discontinuity",
            Self::Malformed => "malformed",
        }
    }
}

/// The judge's proof that a drive keeps limits and distance. Only the judge makes one.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(transparent))]
pub struct TimedCertificate(TimedReport);

impl TimedReport {
    /// The certificate, if nothing was violated; otherwise the report back.
    ///
    /// # Errors
    /// The report itself, where something was violated.
    pub fn certify(self) -> Result<TimedCertificate, Box<Self>> {
        if self.valid && self.violations.is_empty() {
            Ok(TimedCertificate(self))
        } else {
            Err(Box::new(self))
        }
    }
}

impl Deref for TimedCertificate {
    type Target = TimedReport;
    fn deref(&self) -> &TimedReport {
        &self.0
    }
}
