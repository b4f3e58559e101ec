//! A vehicle between command and motion: delay, actuators, roll.

use super::controller::{DriveCommand, DriveLimits};
use crate::collision::Drive;
use crate::vehicle::BicycleState;
use std::collections::VecDeque;

/// Times that differ by less are one, seconds.
const SAME_S: f64 = 1e-9;

/// A vehicle with actuators: commands take effect late, and wheels and speed change no faster than
/// they can.
///
/// ```
/// use formicar::tracking::{ActuatedVehicle, DriveCommand, DriveLimits};
/// use formicar::vehicle::BicycleState;
///
/// let limits = DriveLimits {
///     wheelbase_m: 0.65,
///     max_steer_rad: 0.7,
///     steer_rate_rad_per_s: 1.0,
///     acceleration_mps2: 0.5,
///     braking_mps2: 1.0,
///     delay_s: 0.1,
///     control_period_s: 0.02,
/// };
/// let mut vehicle = ActuatedVehicle::new(limits, BicycleState::default());
/// vehicle.give(DriveCommand { speed_mps: 1.0, steer_rad: 0.0 });
/// for _ in 0..10 {
///     vehicle.step(0.05);
/// }
/// assert!((vehicle.state().speed_mps - 0.5 * 0.4).abs() < 1e-9);
/// ```
#[derive(Clone, Debug)]
pub struct ActuatedVehicle {
    limits: DriveLimits,
    state: BicycleState,
    command: DriveCommand,
    /// Commands with the times at which they take effect.
    pending: VecDeque<(f64, DriveCommand)>,
    t_s: f64,
}

impl ActuatedVehicle {
    /// A vehicle in a state, commanded to stand.
    pub fn new(limits: DriveLimits, state: BicycleState) -> Self {
        Self {
            limits,
            state,
            command: DriveCommand::default(),
            pending: VecDeque::new(),
            t_s: 0.0,
        }
    }

    /// Its limits.
    pub fn limits(&self) -> &DriveLimits {
        &self.limits
    }

    /// Its state.
    pub fn state(&self) -> BicycleState {
        self.state
    }

    /// Time since the beginning, seconds.
    pub fn t_s(&self) -> f64 {
        self.t_s
    }

    /// The command in effect.
    pub fn command(&self) -> DriveCommand {
        self.command
    }

    /// Commands that have not yet taken effect, the oldest first.
    pub fn pending(&self) -> Vec<DriveCommand> {
        self.pending.iter().map(|(_, command)| *command).collect()
    }

    /// Turns the wheels at once, for the beginning of a drive.
    pub(super) fn turn_wheels(&mut self, steer_rad: f64) {
        self.state.steer_rad = steer_rad;
    }

    /// Gives a command, which takes effect after the delay.
    pub fn give(&mut self, command: DriveCommand) {
        self.pending
            .push_back((self.t_s + self.limits.delay_s, command));
    }

    /// Drives for a time with the wheels held; the line or arc that it rolls, in the frame of its
    /// pose.
    pub fn step(&mut self, duration_s: f64) -> Drive {
        while let Some((since_s, command)) = self.pending.front().copied() {
            if since_s > self.t_s + SAME_S {
                break;
            }
            self.command = command;
            self.pending.pop_front();
        }
        let limit = self.limits.max_steer_rad;
        let most_rad = self.limits.steer_rate_rad_per_s * duration_s;
        let now = self.state.steer_rad;
        let steer_rad = self.command.steer_rad.clamp(-limit, limit);
        self.state.steer_rad = steer_rad.clamp(now - most_rad, now + most_rad);
        let before_mps = self.state.speed_mps;
        self.state.speed_mps = self.changed_speed_mps(duration_s);
        let drive = Drive {
            start: self.state.pose,
            curvature_per_m: self.state.steer_rad.tan() / self.limits.wheelbase_m,
            signed_length_m: 0.5 * (before_mps + self.state.speed_mps) * duration_s,
        };
        if drive.signed_length_m != 0.0 {
            let Drive {
                start,
                curvature_per_m,
                signed_length_m,
            } = drive;
            self.state.pose = start.advance(curvature_per_m, signed_length_m);
        }
        self.t_s += duration_s;
        drive
    }

    /// The speed after a step toward the one asked for.
    fn changed_speed_mps(&self, duration_s: f64) -> f64 {
        let (now, asked) = (self.state.speed_mps, self.command.speed_mps);
        let brakes = asked.abs() < now.abs() || asked * now < 0.0;
        let rate = if brakes {
            self.limits.braking_mps2
        } else {
            self.limits.acceleration_mps2
        };
        let next = asked.clamp(now - rate * duration_s, now + rate * duration_s);
        // Between the gears the vehicle stands for a moment.
        if next * now < 0.0 { 0.0 } else { next }
    }
}
