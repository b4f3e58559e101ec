//! What a controller sees, and what it asks for.

use super::actuators::Actuators;
use crate::path::{Direction, TimedPath};
use crate::tracking::TrackingError;
use crate::tracking::stretch::Stretch;
use crate::vehicle::{BicycleState, Motion, Vehicle};

/// Steers and drives a vehicle along a timed path.
///
/// A controller may keep what it knows from one call to the next; [`track_by`](super::track_by) calls
/// it once per control period, in order of time.
pub trait DriveController {
    /// Its name.
    fn name(&self) -> &str;

    /// The command at a moment.
    fn command(&mut self, at: &DriveMoment) -> DriveCommand;

    /// How often it had no answer and braked instead.
    fn n_failures(&self) -> usize {
        0
    }
}

/// A speed and a steering angle to be reached as fast as the actuators can.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DriveCommand {
    /// Speed, m/s; negative in reverse.
    pub speed_mps: f64,
    /// Angle of the virtual middle wheel, radians, positive to the left.
    pub steer_rad: f64,
}

/// What the vehicle can do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DriveLimits {
    /// Distance between the axles, meters.
    pub wheelbase_m: f64,
    /// Largest steering angle, radians.
    pub max_steer_rad: f64,
    /// Fastest change of the steering angle, rad/s; may be infinite.
    pub steer_rate_rad_per_s: f64,
    /// Largest acceleration, m/s^2.
    pub acceleration_mps2: f64,
    /// Largest deceleration, m/s^2.
    pub braking_mps2: f64,
    /// Time until a command takes effect, seconds.
    pub delay_s: f64,
    /// Time between two commands, seconds.
    pub control_period_s: f64,
}

/// Acceleration of a vehicle that names none, m/s^2.
const USUAL_ACCELERATION_MPS2: f64 = 1.0;
/// Brakes without a limit of their own are stronger than the motor by this.
const BRAKING_RATIO: f64 = 2.0;

impl DriveLimits {
    /// What a vehicle can do with its actuators; what these leave out is as the vehicle says.
    ///
    /// # Errors
    /// A vehicle that does not steer or whose wheelbase is unknown, or an actuator out of its
    /// range.
    pub fn of(
        vehicle: &Vehicle,
        actuators: &Actuators,
        steer_rate_rad_per_s: Option<f64>,
    ) -> Result<Self, TrackingError> {
        actuators.check()?;
        if vehicle.motion() == Motion::Point {
            return Err(TrackingError::NeedsACar);
        }
        let wheelbase_m = vehicle.wheelbase_m();
        let wheelbase_m = wheelbase_m.ok_or(TrackingError::NeedsAWheelbase)?;
        let of_vehicle = vehicle.parameters();
        let acceleration_mps2 = actuators.max_acceleration_mps2;
        let acceleration_mps2 = acceleration_mps2.or(of_vehicle.max_acceleration_mps2);
        let acceleration_mps2 = acceleration_mps2.unwrap_or(USUAL_ACCELERATION_MPS2);
        let braking_mps2 = actuators.max_braking_mps2;
        let rate = steer_rate_rad_per_s.or(of_vehicle.max_steer_rate_rad_per_s);
        Ok(Self {
            wheelbase_m,
            max_steer_rad: (wheelbase_m * vehicle.max_curvature_per_m()).atan(),
            steer_rate_rad_per_s: rate.unwrap_or(f64::INFINITY),
            acceleration_mps2,
            braking_mps2: braking_mps2.unwrap_or(BRAKING_RATIO * acceleration_mps2),
            delay_s: actuators.delay_s,
            control_period_s: actuators.control_period_s,
        })
    }
}

/// A moment of a drive.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct DriveMoment<'a> {
    /// Time since the drive began, seconds.
    pub t_s: f64,
    /// The vehicle; its speed is negative in reverse.
    pub state: BicycleState,
    /// Commands that have been given and have not yet taken effect, the oldest first.
    pub pending: &'a [DriveCommand],
    /// The drive to follow.
    pub reference: &'a TimedPath,
    /// Arc length of the path's place nearest to the vehicle, within the stretch that is driven.
    pub s_m: f64,
    /// Arc lengths at which that stretch begins and ends.
    pub stretch_m: [f64; 2],
    /// Its gear.
    pub direction: Direction,
    /// Distance of the body from the nearest obstacle, meters; infinite where no map is known.
    pub clearance_m: f64,
    /// What the vehicle can do.
    pub limits: DriveLimits,
    pub(in crate::tracking) stretch: &'a Stretch,
    pub(in crate::tracking) foot_m: f64,
    /// Length driven on the stretch.
    pub(in crate::tracking) driven_m: f64,
}

impl DriveMoment<'_> {
    /// The speed, at least 0, that keeps to the times of the reference: its own speed when the
    /// command takes effect, and a share of the length by which the vehicle is late; no faster than
    /// it can stop at the end of the stretch.
    pub fn scheduled_speed_mps(&self) -> f64 {
        /// Rate at which a delay is made up for, 1/s.
        const CATCH_UP_PER_S: f64 = 2.0;
        /// A vehicle that is late by more than some millimeters drives at least so fast, m/s.
        const CREEP_MPS: f64 = 0.05;
        const LATE_M: f64 = 0.005;
        /// Share of the deceleration that is planned with.
        const BRAKING_SHARE: f64 = 0.8;
        let delay_s = self.limits.delay_s + 0.5 * self.limits.control_period_s;
        let due = self.reference.at(self.t_s + delay_s);
        let [begin_m, end_m] = self.stretch_m;
        let is_due_here = due.s_m > begin_m && due.s_m < end_m;
        let due_mps = if is_due_here { due.speed_mps } else { 0.0 };
        let own_mps = self.direction.sign() * self.state.speed_mps;
        let own_m = self.s_m + own_mps.max(0.0) * delay_s;
        let late_m = due.s_m.clamp(begin_m, end_m) - own_m;
        let left_m = (end_m.min(self.reference.end().s_m) - own_m).max(0.0);
        let stoppable = (2.0 * BRAKING_SHARE * self.limits.braking_mps2 * left_m).sqrt();
        let creep_mps = if late_m > LATE_M { CREEP_MPS } else { 0.0 };
        let wished_mps = due_mps + CATCH_UP_PER_S * late_m;
        wished_mps.max(creep_mps).clamp(0.0, stoppable)
    }

    /// A command in the gear of the stretch; a vehicle that stands turns its wheels first.
    pub fn drive(&self, speed_mps: f64, steer_rad: f64) -> DriveCommand {
        /// Below this speed the vehicle stands, m/s.
        const STANDS_MPS: f64 = 0.01;
        /// Wheels that have more to turn are turned first, radians.
        const TURNS_FIRST_RAD: f64 = 0.02;
        let limit = self.limits.max_steer_rad;
        let steer_rad = steer_rad.clamp(-limit, limit);
        let turns = (steer_rad - self.state.steer_rad).abs() > TURNS_FIRST_RAD;
        let stands = self.state.speed_mps.abs() < STANDS_MPS && turns;
        let speed_mps = if stands { 0.0 } else { speed_mps };
        DriveCommand {
            speed_mps: self.direction.sign() * speed_mps,
            steer_rad,
        }
    }
}
