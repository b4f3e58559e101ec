//! The configuration of a simulated drive: controller, speed, steps, start, and when to give up.

use super::{Actuators, Controller, TrackingError};
use crate::geometry::Pose2;
use crate::parameters::{OutOfRange, parameters};
use crate::vehicle::{Motion, Vehicle};
use std::f64::consts::PI;

/// Speed where neither configuration nor vehicle name one, m/s (Lei & Zheng 2020, sec. IV.B).
pub const DEFAULT_SPEED_MPS: f64 = 0.3;

/// The most that the vehicle may turn in a time step, radians: the Runge-Kutta step then leaves
/// the exact arc by less than 4e-8 of its length.
const MAX_TURN_PER_STEP_RAD: f64 = 0.1;

parameters! {
    /// Parameters of a simulated drive.
    pub struct TrackingConfig where check_offset {
        /// What turns the wheels.
        pub controller: Controller = Controller::default(),
        /// Speed, meters per second; where left out that of the vehicle, or 0.3.
        #[range(0.001..=100.0)]
        pub speed_mps: Option<f64> = None,
        /// Fastest change of the steering angle, radians per second; where left out that of the
        /// vehicle, or unbounded.
        #[range(0.001..=100.0)]
        pub max_steer_rate_rad_per_s: Option<f64> = None,
        /// Time for which the wheels are held, seconds; in it the vehicle may turn by at most 0.1
        /// rad.
        #[range(0.0001..=1.0)]
        pub time_step_s: f64 = 0.02,
        /// Time between two points of the trace, seconds.
        #[range(0.0001..=60.0)]
        pub record_interval_s: f64 = 0.1,
        /// Delay, acceleration and control period; of drives in time alone.
        #[serde(skip_serializing_if = "Actuators::is_usual")]
        pub actuators: Actuators = Actuators::default(),
        /// How far beside the path's first pose the vehicle starts.
        pub start_offset: StartOffset = StartOffset::default(),
        /// Cross-track error at which the vehicle has left the path, meters; above the lateral
        /// start offset.
        #[range(0.01..=1000.0)]
        pub give_up_error_m: f64 = 2.0,
        /// Driven length at which to give up, in lengths of the path with one turning radius.
        #[range(1.0..=100.0)]
        pub give_up_length_ratio: f64 = 2.0,
    }
}

parameters! {
    /// A start pose in the frame of the path's first pose.
    #[derive(Copy, Default)]
    pub struct StartOffset {
        /// To the front, meters.
        #[range(-1000.0..=1000.0)]
        pub along_m: f64,
        /// To the left, meters.
        #[range(-1000.0..=1000.0)]
        pub lateral_m: f64,
        /// Counter-clockwise, radians.
        #[range(-PI..=PI)]
        pub heading_rad: f64,
    }
}

impl StartOffset {
    /// Where a vehicle starts beside a path that begins at a pose.
    pub(super) fn beside(&self, begin: Pose2) -> Pose2 {
        begin.compose(Pose2::new(self.along_m, self.lateral_m, self.heading_rad))
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
        complete.check()?;
        complete.check_time_step(vehicle)?;
        Ok(complete)
    }

    /// The speed, m/s.
    pub(super) fn speed(&self) -> f64 {
        self.speed_mps.unwrap_or(DEFAULT_SPEED_MPS)
    }

    /// A vehicle that has left the path before it starts cannot be driven.
    fn check_offset(&self) -> Result<(), OutOfRange> {
        let lateral_m = self.start_offset.lateral_m;
        if lateral_m.abs() < self.give_up_error_m {
            return Ok(());
        }
        Err(OutOfRange {
            key: "start_offset.lateral_m".to_owned(),
            value: lateral_m,
            range: format!("below give_up_error_m = {}", self.give_up_error_m),
        })
    }

    fn check_time_step(&self, vehicle: &Vehicle) -> Result<(), TrackingError> {
        let turn_rad_per_s = self.speed() * vehicle.max_curvature_per_m();
        if self.time_step_s * turn_rad_per_s <= MAX_TURN_PER_STEP_RAD {
            return Ok(());
        }
        let most_s = MAX_TURN_PER_STEP_RAD / turn_rad_per_s;
        Err(TrackingError::OutOfRange(OutOfRange {
            key: "time_step_s".to_owned(),
            value: self.time_step_s,
            range: format!(
                "at most {most_s:.4} for this vehicle at {} m/s: a step may turn it by {MAX_TURN_PER_STEP_RAD} rad",
                self.speed()
            ),
        }))
    }
}
