//! The timed path that is followed, and the controller.

use super::config::DriverConfig;
use crate::error::SetupError;
use formicar::path::TimedPath;
use formicar::tracking::{
    Controller, DriveCommand, DriveController, DriveLimits, FollowedState, Follower,
};
use formicar::vehicle::BicycleState;
use std::collections::VecDeque;

/// A robot that is so much off its place on the timed path begins the next one where it is, meters.
const LAG_M: f64 = 0.1;

/// The timed path, its follower and the controller.
pub(super) struct Reference {
    controller: Box<dyn DriveController>,
    asks_for_clearance: bool,
    limits: DriveLimits,
    follower: Option<Follower>,
    /// The speed with which the next timed path begins, m/s, at least 0.
    present_mps: f64,
    /// Commands with the times at which they take effect.
    pending: VecDeque<(f64, DriveCommand)>,
}

impl Reference {
    pub(super) fn new(config: &DriverConfig, limits: DriveLimits) -> Result<Self, SetupError> {
        Ok(Self {
            controller: controller(&config.controller)?,
            asks_for_clearance: matches!(config.controller, Controller::RegulatedPurePursuit(_)),
            limits,
            follower: None,
            present_mps: 0.0,
            pending: VecDeque::new(),
        })
    }

    pub(super) fn asks_for_clearance(&self) -> bool {
        self.asks_for_clearance && self.follower.is_some()
    }

    pub(super) fn n_failures(&self) -> usize {
        self.controller.n_failures()
    }

    /// Lets the robot stand.
    pub(super) fn hold(&mut self) {
        self.follower = None;
        self.present_mps = 0.0;
    }

    pub(super) fn follow(&mut self, timed: TimedPath) {
        self.follower = Follower::new(timed, self.limits).ok();
    }

    /// The speed with which the next timed path begins, m/s, at least 0.
    pub(super) fn present_mps(&self) -> f64 {
        self.present_mps
    }

    /// The length of the timed path that is behind the robot; none where it is far off the path.
    ///
    /// That is the length due by now, which keeps one timed path in step with the next. A robot that
    /// lags, since its controller is careful, is where it is.
    pub(super) fn behind_m(
        &mut self,
        t_s: f64,
        state: BicycleState,
        max_error_m: f64,
    ) -> Option<f64> {
        let Some(follower) = &self.follower else {
            self.present_mps = 0.0;
            return Some(0.0);
        };
        let [error_m, _] = follower.error(state.pose);
        if error_m > max_error_m {
            return None;
        }
        let due = follower.timed().at(t_s);
        let lags = (due.s_m - follower.s_m()).abs() > LAG_M;
        self.present_mps = if lags {
            state.speed_mps.abs()
        } else {
            due.speed_mps
        };
        Some(if lags { follower.s_m() } else { due.s_m })
    }

    pub(super) fn command(
        &mut self,
        t_s: f64,
        state: BicycleState,
        clearance_m: f64,
    ) -> DriveCommand {
        const SAME_S: f64 = 1e-9;
        while self
            .pending
            .front()
            .is_some_and(|(at_s, _)| *at_s <= t_s + SAME_S)
        {
            self.pending.pop_front();
        }
        let pending: Vec<_> = self.pending.iter().map(|(_, command)| *command).collect();
        let command = match &mut self.follower {
            Some(follower) => {
                let seen = FollowedState {
                    t_s,
                    state,
                    pending: &pending,
                    clearance_m,
                };
                follower.command(&seen, self.controller.as_mut())
            }
            None => DriveCommand {
                speed_mps: 0.0,
                steer_rad: state.steer_rad,
            },
        };
        if self.limits.delay_s > 0.0 {
            self.pending.push_back((t_s + self.limits.delay_s, command));
        }
        command
    }
}

fn controller(law: &Controller) -> Result<Box<dyn DriveController>, SetupError> {
    match law {
        Controller::RegulatedPurePursuit(law) => Ok(Box::new(*law)),
        #[cfg(feature = "mpc")]
        Controller::Mpc(parameters) => Ok(Box::new(formicar::tracking::ModelPredictive::new(
            *parameters,
        ))),
        #[cfg(not(feature = "mpc"))]
        Controller::Mpc(_) => Err(formicar::tracking::TrackingError::NotCompiledIn.into()),
        law => Err(SetupError::Contradiction {
            what: "controller",
            problem: format!("{} does not drive in time by itself", law.name()),
            hint: "mpc or regulated-pure-pursuit",
        }),
    }
}
