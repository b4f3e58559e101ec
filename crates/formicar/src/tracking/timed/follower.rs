//! A controller called from outside: where the vehicle is along a timed path.

use super::controller::{DriveCommand, DriveController, DriveLimits, DriveMoment};
use crate::geometry::{Pose2, angle_difference};
use crate::path::TimedPath;
use crate::tracking::TrackingError;
use crate::tracking::errors::Offset;
use crate::tracking::stretch::{Stretch, stretches};
use crate::vehicle::BicycleState;

/// Below this speed the vehicle stands, m/s.
const STANDS_MPS: f64 = 0.01;
/// A vehicle that stands so near to the end of a stretch is there, meters.
const END_M: f64 = 0.02;
/// One that stands for so long is as near as it gets, seconds.
const PATIENCE_S: f64 = 0.5;

/// Follows a timed path step by step, with any [`DriveController`] and any source of poses: the loop
/// of a robot or of a simulation stays with the caller.
///
/// It keeps the stretch that is driven and the vehicle's place on it. Times are those of the timed
/// path, which may begin at any of them.
///
/// ```
/// use formicar::motion::fastest;
/// use formicar::path::{Direction, SpeedLimits};
/// use formicar::tracking::{DriveLimits, FollowedState, Follower, RegulatedPurePursuit};
/// use formicar::vehicle::BicycleState;
/// use formicar::{CurvePath, Pose2, Vehicle};
///
/// let mut path = CurvePath::new(Pose2::default());
/// path.push(0.0, 5.0, Direction::Forward);
/// let timed = fastest(&path, &Vehicle::warehouse_amr(), &SpeedLimits::default(), 0.1);
/// let limits = DriveLimits {
///     wheelbase_m: 0.65,
///     max_steer_rad: 0.7,
///     steer_rate_rad_per_s: 1.0,
///     acceleration_mps2: 1.0,
///     braking_mps2: 1.0,
///     delay_s: 0.0,
///     control_period_s: 0.02,
/// };
/// let mut follower = Follower::new(timed, limits)?;
/// let beside = BicycleState { pose: Pose2::new(0.0, 0.1, 0.0), ..BicycleState::default() };
/// let seen = FollowedState { t_s: 0.5, state: beside, pending: &[], clearance_m: f64::INFINITY };
/// let command = follower.command(&seen, &mut RegulatedPurePursuit::default());
/// assert!(command.steer_rad < 0.0);
/// # Ok::<(), formicar::tracking::TrackingError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Follower {
    timed: TimedPath,
    limits: DriveLimits,
    stretches: Vec<Stretch>,
    at: usize,
    begin_m: f64,
    offset: Offset,
    stands_since_s: Option<f64>,
}

/// What a follower is told at a moment.
#[derive(Clone, Copy, Debug)]
pub struct FollowedState<'a> {
    /// The time, seconds.
    pub t_s: f64,
    /// The vehicle; its speed is negative in reverse.
    pub state: BicycleState,
    /// Commands that have been given and have not yet taken effect, the oldest first.
    pub pending: &'a [DriveCommand],
    /// Distance of the body from the nearest obstacle, meters; infinite where no map is known.
    pub clearance_m: f64,
}

impl Follower {
    /// A follower at the beginning of a timed path.
    ///
    /// # Errors
    /// A path that jumps, or with numbers that are not finite.
    pub fn new(timed: TimedPath, limits: DriveLimits) -> Result<Self, TrackingError> {
        Ok(Self {
            stretches: stretches(timed.path())?,
            timed,
            limits,
            at: 0,
            begin_m: 0.0,
            offset: Offset::default(),
            stands_since_s: None,
        })
    }

    /// The timed path.
    pub fn timed(&self) -> &TimedPath {
        &self.timed
    }

    /// The arc length of the place nearest to the vehicle when it was last seen.
    pub fn s_m(&self) -> f64 {
        let length_m = self.stretches.get(self.at).map_or(0.0, Stretch::length_m);
        self.begin_m + self.offset.foot_m.clamp(0.0, length_m)
    }

    /// How far the vehicle was from the path when it was last seen, meters and radians.
    pub fn error(&self, pose: Pose2) -> [f64; 2] {
        let on_path = self.timed.path().pose_at(self.s_m());
        let turn_rad = angle_difference(pose.heading, on_path.heading).abs();
        [pose.position().distance(on_path.position()), turn_rad]
    }

    /// Sees the vehicle, and asks a controller for a command. On a path without length the vehicle
    /// is told to stand.
    pub fn command(
        &mut self,
        seen: &FollowedState,
        controller: &mut dyn DriveController,
    ) -> DriveCommand {
        self.see(seen);
        let Some(stretch) = self.stretches.get(self.at) else {
            return DriveCommand {
                speed_mps: 0.0,
                steer_rad: seen.state.steer_rad,
            };
        };
        controller.command(&DriveMoment {
            t_s: seen.t_s,
            state: seen.state,
            pending: seen.pending,
            reference: &self.timed,
            s_m: self.s_m(),
            stretch_m: [self.begin_m, self.begin_m + stretch.length_m()],
            direction: stretch.direction,
            clearance_m: seen.clearance_m,
            limits: self.limits,
            stretch,
            foot_m: self.offset.foot_m,
            driven_m: self.offset.foot_m.max(0.0),
        })
    }

    fn see(&mut self, seen: &FollowedState) {
        let Some(stretch) = self.stretches.get(self.at) else {
            return;
        };
        self.offset = Offset::new(stretch, seen.state.pose, self.offset.foot_m);
        let stands = seen.state.speed_mps.abs() < STANDS_MPS;
        self.stands_since_s = stands.then(|| self.stands_since_s.unwrap_or(seen.t_s));
        let waits_s = self
            .stands_since_s
            .map_or(0.0, |since_s| seen.t_s - since_s);
        let left_m = stretch.length_m() - self.offset.foot_m;
        let end_m = self.begin_m + stretch.length_m();
        // The drive waits here as well where others pass: it goes on once its time has come.
        let is_due = self.timed.at(seen.t_s).s_m >= end_m - END_M;
        let is_near = left_m < END_M || waits_s > PATIENCE_S && left_m < 10.0 * END_M;
        if stands && is_due && is_near && self.at + 1 < self.stretches.len() {
            self.begin_m = end_m;
            self.at += 1;
            self.stands_since_s = None;
            self.offset = Offset::new(&self.stretches[self.at], seen.state.pose, 0.0);
        }
    }
}
