//! The times of the path: they always end within what has been seen.

use super::config::UnknownGround;
use super::robot::{Driver, STANDS_MPS};
use crate::route::{NOTHING_M, first_gear_m};
use formicar::CurvePath;
use formicar::motion::{MotionConfig, MotionError};
use formicar::path::{Phase, TimedPath};
use formicar::planner::{DriveError, DriveQuestion, drive_in_time};
use formicar::scenario::{MovingObstacle, Predictions};

/// From a stand, shorter hops are not driven, unless they end the path, meters.
const LEAST_HOP_M: f64 = 0.05;
/// On shorter paths there is no room to let anyone pass, meters: the robot goes, or, where someone is
/// near, waits.
const SHORT_M: f64 = 0.05;
/// Someone so near to the robot's reach is waited for, meters.
const NEAR_M: f64 = 1.0;
/// A speed plan is asked for again with less distance from what moves, in shares.
const DISTANCE_SHARES: [f64; 3] = [1.0, 0.5, 0.1];
/// A speed above the limit of a path by less is rounded down to it: a share and m/s.
const ROUNDING: f64 = 1.02;
const ROUNDING_MPS: f64 = 0.02;

impl Driver {
    /// Cuts off what has been driven; a robot far from where it is due stops.
    pub(super) fn advance(&mut self) {
        let (t_s, state) = (self.senses.t_s(), self.senses.state());
        let max_error_m = self.config.max_error_m;
        if let Some(behind_m) = self.reference.behind_m(t_s, state, max_error_m) {
            self.routing.advance(behind_m);
        } else {
            self.counts.n_emergency_brakes += 1;
            self.reference.hold();
            self.routing.forget();
        }
    }

    /// Plans the speed along the path as far as it has been seen and is free.
    pub(super) fn set_times(&mut self) {
        let t_s = self.senses.t_s();
        let due_mps = self.reference.present_mps();
        let Some(path) = self.routing.path().cloned() else {
            self.stop(due_mps, None);
            return;
        };
        let length_m = path.length_m();
        let open_m = match self.config.unknown {
            UnknownGround::StopBefore => self.lanes.seen_m(&path),
            UnknownGround::TakeAsFree => self.lanes.open_m(&path),
        };
        let is_whole = open_m > length_m - NOTHING_M;
        let end_m = if is_whole { length_m } else { open_m };
        let stands = due_mps == 0.0 && self.senses.state().speed_mps.abs() < STANDS_MPS;
        if stands && end_m < if is_whole { NOTHING_M } else { LEAST_HOP_M } {
            self.reference.hold();
            return;
        }
        // The robot stops where the gear changes in any case: what follows is timed from there.
        let end_m = if stands {
            end_m
        } else {
            end_m.min(first_gear_m(&path))
        };
        match self.speed_plan(&path.between_m(0.0, end_m), due_mps) {
            Some(timed) => {
                self.counts.n_certified += 1;
                self.reference.follow(delayed(&timed, t_s));
            }
            None => self.stop(due_mps, Some(&path)),
        }
    }

    /// Brakes along a path as hard as the actuators can.
    fn stop(&mut self, due_mps: f64, path: Option<&CurvePath>) {
        let Some(path) = path.filter(|_| due_mps > 0.0) else {
            self.reference.hold();
            return;
        };
        self.counts.n_emergency_brakes += 1;
        let braking_mps2 = self.limits.braking_mps2;
        let braking = Phase {
            speed_mps: due_mps,
            acceleration_mps2: -braking_mps2,
            duration_s: due_mps / braking_mps2,
            ..Phase::default()
        };
        let timed = TimedPath::new(path.clone(), vec![braking]);
        self.reference.follow(delayed(&timed, self.senses.t_s()));
    }

    /// A speed plan that the judge certifies; with less distance from what moves where the wished one
    /// cannot be kept.
    fn speed_plan(&self, path: &CurvePath, present_mps: f64) -> Option<TimedPath> {
        let obstacles = self.senses.predicted();
        if path.length_m() < SHORT_M && !obstacles.is_empty() {
            let near_m = self.vehicle.footprint().circumradius() + NEAR_M;
            let waits = present_mps == 0.0 && self.senses.has_company(near_m);
            return if waits {
                None
            } else {
                self.speed_plan_alone(path, present_mps)
            };
        }
        let shares = if obstacles.is_empty() {
            &DISTANCE_SHARES[..1]
        } else {
            &DISTANCE_SHARES
        };
        shares.iter().find_map(|share| {
            let config = MotionConfig {
                limits: self.limits_of_plan().clone(),
                present_speed_mps: present_mps,
                distance_m: share * self.config.distance_m,
                ..MotionConfig::default()
            };
            self.certified(path, &obstacles, &config)
        })
    }

    /// A speed plan that heeds nobody.
    fn speed_plan_alone(&self, path: &CurvePath, present_mps: f64) -> Option<TimedPath> {
        let config = MotionConfig {
            limits: self.limits_of_plan().clone(),
            present_speed_mps: present_mps,
            ..MotionConfig::default()
        };
        self.certified(path, &[], &config)
    }

    fn certified(
        &self,
        path: &CurvePath,
        obstacles: &[MovingObstacle],
        config: &MotionConfig,
    ) -> Option<TimedPath> {
        let predictions = Predictions::new(obstacles.to_vec(), self.config.horizon_s).ok()?;
        let ask = |config: &MotionConfig| {
            let question = DriveQuestion {
                predictions: &predictions,
                zones: None,
                config,
            };
            drive_in_time(self.known().frame(), &self.vehicle, path, &question)
        };
        let plan = match ask(config) {
            Err(DriveError::Motion(MotionError::TooFast {
                speed_mps,
                limit_mps,
            })) if speed_mps < ROUNDING * limit_mps + ROUNDING_MPS => ask(&MotionConfig {
                present_speed_mps: limit_mps * (1.0 - 1e-9),
                ..config.clone()
            }),
            plan => plan,
        };
        plan.ok().map(|plan| plan.motion.timed)
    }
}

/// The same drive, begun at a time.
fn delayed(timed: &TimedPath, begins_s: f64) -> TimedPath {
    let phases = timed.phases().iter().map(|phase| Phase {
        t_s: phase.t_s + begins_s,
        ..*phase
    });
    TimedPath::new(timed.path().clone(), phases.collect())
}
