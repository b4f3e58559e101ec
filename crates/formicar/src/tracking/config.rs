//! What a simulated drive is made of: controller, speed, steps, start, and when to give up.

use super::{Controller, TrackingError};
use crate::vehicle::{Motion, Vehicle};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Speed where neither configuration nor vehicle name one, m/s (Lei & Zheng 2020, sec. IV.B).
pub const DEFAULT_SPEED_MPS: f64 = 0.3;

/// The most that the vehicle may turn in a time step, radians: the Runge-Kutta step then leaves
/// the exact arc by less than 4e-8 of its length.
const MAX_TURN_PER_STEP_RAD: f64 = 0.1;

/// Parameters of a simulated drive.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct TrackingConfig {
    /// What turns the wheels.
    pub controller: Controller,
    /// Speed, metres per second, 0.001 to 100; where left out that of the vehicle, or 0.3.
    #[schemars(range(min = 0.001, max = 100.0))]
    pub speed_mps: Option<f64>,
    /// Fastest change of the steering angle, radians per second, 0.001 to 100; where left out
    /// that of the vehicle, or unbounded.
    #[schemars(range(min = 0.001, max = 100.0))]
    pub max_steer_rate_rad_per_s: Option<f64>,
    /// Time for which the wheels are held, seconds, 0.0001 to 1; in it the vehicle may turn by at
    /// most 0.1 rad.
    #[schemars(range(min = 0.0001, max = 1.0))]
    pub time_step_s: f64,
    /// Time between two points of the trace, seconds, 0.0001 to 60.
    #[schemars(range(min = 0.0001, max = 60.0))]
    pub record_interval_s: f64,
    /// How far beside the path's first pose the vehicle starts.
    pub start_offset: StartOffset,
    /// Cross-track error at which the vehicle has left the path, metres, 0.01 to 1000; above the
    /// lateral start offset.
    #[schemars(range(min = 0.01, max = 1000.0))]
    pub give_up_error_m: f64,
    /// Driven length at which to give up, 1 to 100 times the length of the path and one turning
    /// radius.
    #[schemars(range(min = 1.0, max = 100.0))]
    pub give_up_length_ratio: f64,
}

/// A start pose in the frame of the path's first pose.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct StartOffset {
    /// To the front, metres, -1000 to 1000.
    #[schemars(range(min = -1000.0, max = 1000.0))]
    pub along_m: f64,
    /// To the left, metres, -1000 to 1000.
    #[schemars(range(min = -1000.0, max = 1000.0))]
    pub lateral_m: f64,
    /// Counter-clockwise, radians, -pi to pi.
    #[schemars(range(min = -std::f64::consts::PI, max = std::f64::consts::PI))]
    pub heading_rad: f64,
}

impl Default for TrackingConfig {
    fn default() -> Self {
        Self {
            controller: Controller::default(),
            speed_mps: None,
            max_steer_rate_rad_per_s: None,
            time_step_s: 0.02,
            record_interval_s: 0.1,
            start_offset: StartOffset::default(),
            give_up_error_m: 2.0,
            give_up_length_ratio: 2.0,
        }
    }
}

impl TrackingConfig {
    /// The same parameters with what was left out taken from a vehicle.
    ///
    /// # Errors
    /// A vehicle that does not steer or whose wheelbase is unknown, or the first parameter that
    /// is out of its range, with value and range.
    pub fn for_vehicle(&self, vehicle: &Vehicle) -> Result<Self, TrackingError> {
        if vehicle.motion() == Motion::Point {
            return Err(TrackingError::NeedsACar);
        }
        let wheelbase_m = vehicle
            .wheelbase_m()
            .ok_or(TrackingError::NeedsAWheelbase)?;
        let of_vehicle = vehicle.parameters();
        let speed_mps = self.speed_mps.or(of_vehicle.speed_mps);
        let complete = Self {
            controller: self.controller.for_wheelbase(wheelbase_m),
            speed_mps: Some(speed_mps.unwrap_or(DEFAULT_SPEED_MPS)),
            max_steer_rate_rad_per_s: self
                .max_steer_rate_rad_per_s
                .or(of_vehicle.max_steer_rate_rad_per_s),
            ..self.clone()
        };
        complete.check_ranges()?;
        complete.check_time_step(vehicle)?;
        Ok(complete)
    }

    /// The speed, m/s.
    pub(super) fn speed(&self) -> f64 {
        self.speed_mps.unwrap_or(DEFAULT_SPEED_MPS)
    }

    fn check_ranges(&self) -> Result<(), TrackingError> {
        let offset = self.start_offset;
        let rate = self.max_steer_rate_rad_per_s.unwrap_or(100.0);
        let own = [
            ("speed_mps", self.speed(), [0.001, 100.0]),
            ("max_steer_rate_rad_per_s", rate, [0.001, 100.0]),
            ("time_step_s", self.time_step_s, [0.0001, 1.0]),
            ("record_interval_s", self.record_interval_s, [0.0001, 60.0]),
            ("start_offset.along_m", offset.along_m, [-1000.0, 1000.0]),
            (
                "start_offset.lateral_m",
                offset.lateral_m,
                [-1000.0, 1000.0],
            ),
            ("start_offset.heading_rad", offset.heading_rad, [-PI, PI]),
            ("give_up_error_m", self.give_up_error_m, [0.01, 1000.0]),
            (
                "give_up_length_ratio",
                self.give_up_length_ratio,
                [1.0, 100.0],
            ),
        ];
        let all = own.into_iter().chain(self.controller.ranges());
        for (key, value, [low, high]) in all {
            if !(low..=high).contains(&value) {
                let range = format!("in {low} to {high}");
                return Err(TrackingError::OutOfRange { key, value, range });
            }
        }
        if offset.lateral_m.abs() >= self.give_up_error_m {
            let range = format!("below give_up_error_m = {}", self.give_up_error_m);
            return Err(TrackingError::OutOfRange {
                key: "start_offset.lateral_m",
                value: offset.lateral_m,
                range,
            });
        }
        Ok(())
    }

    fn check_time_step(&self, vehicle: &Vehicle) -> Result<(), TrackingError> {
        let turn_rad_per_s = self.speed() * vehicle.max_curvature_per_m();
        if self.time_step_s * turn_rad_per_s <= MAX_TURN_PER_STEP_RAD {
            return Ok(());
        }
        let most_s = MAX_TURN_PER_STEP_RAD / turn_rad_per_s;
        Err(TrackingError::OutOfRange {
            key: "time_step_s",
            value: self.time_step_s,
            range: format!(
                "at most {most_s:.4} for this vehicle at {} m/s: a step may turn it by {MAX_TURN_PER_STEP_RAD} rad",
                self.speed()
            ),
        })
    }
}
