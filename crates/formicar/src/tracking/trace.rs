//! The result of a simulated drive: the trace and its summary.

use super::TrackingConfig;
use crate::geometry::Pose2;
use crate::path::{CurvePath, Direction};
use std::fmt::Write;

/// The ending of a simulated drive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum TrackingStatus {
    /// At the end of the path, however far beside it.
    Arrived,
    /// Farther from the path than [`TrackingConfig::give_up_error_m`].
    LeftPath,
    /// Driven for longer than [`TrackingConfig::give_up_length_ratio`] allows.
    GaveUp,
}

impl TrackingStatus {
    /// The word used in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Arrived => "arrived",
            Self::LeftPath => "left_path",
            Self::GaveUp => "gave_up",
        }
    }
}

/// The vehicle at one time; angles in radians, positive to the left.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct TracePoint {
    /// Time since the drive began, seconds; it goes on while the wheels are turned standing.
    pub t_s: f64,
    /// Length driven so far, meters.
    pub driven_m: f64,
    /// Arc length of the path's nearest place, meters.
    pub s_m: f64,
    /// The rear-axle center; heading in (-pi, pi].
    pub pose: Pose2,
    /// Gear in which the pose is reached: 1 forward, -1 in reverse.
    #[cfg_attr(feature = "schema", schemars(with = "i8"))]
    pub direction: Direction,
    /// Steering angle of the virtual middle wheel with which the pose is reached.
    pub steer_rad: f64,
    /// Angle of the left front wheel.
    pub left_wheel_rad: f64,
    /// Angle of the right front wheel.
    pub right_wheel_rad: f64,
    /// Distance from the path, meters, positive where the vehicle is left of it as it faces.
    pub cross_track_error_m: f64,
    /// Heading less that of the path's nearest place, in (-pi, pi].
    pub heading_error_rad: f64,
    /// Speed, m/s, negative in reverse; of drives in time.
    #[cfg_attr(
        feature = "serde",
        serde(default, skip_serializing_if = "Option::is_none")
    )]
    pub speed_mps: Option<f64>,
}

/// A simulated drive in numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct TrackingSummary {
    /// Time from begin to end, seconds.
    pub duration_s: f64,
    /// Driven length, meters.
    pub driven_m: f64,
    /// Changes of gear driven.
    pub n_gear_changes: usize,
    /// Largest distance from the path, meters, the first pose counted.
    pub max_cross_track_error_m: f64,
    /// Root mean square of the distance over driven length, meters.
    pub rms_cross_track_error_m: f64,
    /// Largest absolute heading error, radians, the first pose counted.
    pub max_heading_error_rad: f64,
    /// Root mean square of the heading error over driven length, radians.
    pub rms_heading_error_rad: f64,
    /// Distance of the last pose from the path's end, meters.
    pub goal_error_m: f64,
    /// Absolute heading difference between the last pose and the path's end, radians.
    pub goal_error_rad: f64,
    /// Largest absolute steering angle of the virtual middle wheel, radians.
    pub max_steer_rad: f64,
    /// Largest absolute angle of a front wheel, the inner one, radians.
    pub max_wheel_rad: f64,
    /// Share of the driven length on which the controller asked for more than the steering limit,
    /// by over 1 %.
    pub steering_saturated_share: f64,
    /// Ground that the footprint swept, square meters, as [`super::swept_area_m2`] measures it.
    pub swept_area_m2: f64,
    /// How often the controller had no answer and braked instead; 0 of those that always have one.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "is_zero"))]
    pub n_controller_failures: usize,
}

#[cfg(feature = "serde")]
#[allow(
    clippy::trivially_copy_pass_by_ref,
    reason = "serde hands over a reference"
)]
fn is_zero(number: &usize) -> bool {
    *number == 0
}

/// A simulated drive.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Tracking {
    /// The ending.
    pub status: TrackingStatus,
    /// Its numbers.
    pub summary: TrackingSummary,
    /// The vehicle every [`TrackingConfig::record_interval_s`], and wherever it stood.
    pub trace: Vec<TracePoint>,
    /// The driven path: an arc for every time step, or for several with the same steering angle.
    pub driven: CurvePath,
    /// The parameters, with what the vehicle added to them.
    pub config: TrackingConfig,
}

impl Tracking {
    /// The trace as CSV, with a header.
    pub fn trace_csv(&self) -> String {
        let mut text = String::from(
            "t_s,driven_m,s_m,x,y,heading,direction,steer_rad,left_wheel_rad,right_wheel_rad,\
             cross_track_error_m,heading_error_rad",
        );
        let is_timed = self.trace.iter().any(|p| p.speed_mps.is_some());
        text.push_str(if is_timed { ",speed_mps\n" } else { "\n" });
        for p in &self.trace {
            let Pose2 { x, y, heading } = p.pose;
            let direction = i8::from(p.direction);
            let speed = p.speed_mps.map_or(String::new(), |v| format!(",{v}"));
            // Writing to a string does not fail.
            let _ = writeln!(
                text,
                "{},{},{},{x},{y},{heading},{direction},{},{},{},{},{}{speed}",
                p.t_s,
                p.driven_m,
                p.s_m,
                p.steer_rad,
                p.left_wheel_rad,
                p.right_wheel_rad,
                p.cross_track_error_m,
                p.heading_error_rad
            );
        }
        text
    }

    /// The trace at a driven length: the points around it, and how far between them it lies.
    pub(super) fn at_driven_m(&self, driven_m: f64) -> (&TracePoint, &TracePoint, f64) {
        let last = self.trace.len() - 1;
        let after = self
            .trace
            .partition_point(|p| p.driven_m < driven_m)
            .min(last);
        let (a, b) = (&self.trace[after.saturating_sub(1)], &self.trace[after]);
        let length_m = b.driven_m - a.driven_m;
        let share = if length_m > 0.0 {
            ((driven_m - a.driven_m) / length_m).clamp(0.0, 1.0)
        } else {
            1.0
        };
        (a, b, share)
    }
}
