//! The simulation in time: command, delay, actuators, roll.

use super::actuated::ActuatedVehicle;
use super::controller::{DriveController, DriveLimits, DriveMoment};
use super::laws::Scheduled;
use crate::collision::{Body, Drive, ObstacleMap};
use crate::geometry::{Pose2, angle_difference};
use crate::path::{CurvePath, CurveSegment, Direction, TimedPath};
use crate::tracking::errors::{Errors, Offset};
use crate::tracking::stretch::{Stretch, stretches};
use crate::tracking::swept_area::swept_area_m2;
use crate::tracking::{
    Controller, TracePoint, Tracking, TrackingConfig, TrackingError, TrackingStatus,
    TrackingSummary,
};
use crate::vehicle::{AckermannAxles, BicycleState, Vehicle};
use std::mem;

/// Steps of the simulation in a control period.
const N_SUBSTEPS: u32 = 4;
/// Below this speed the vehicle stands, m/s.
const STANDS_MPS: f64 = 0.01;
/// A stretch ends where less than this is left of it and the vehicle stands, meters.
const END_M: f64 = 0.01;
/// A vehicle that stands for so long past its times has arrived as far as it goes, seconds.
const PATIENCE_S: f64 = 2.0;
/// A drive is given up after so many durations of the reference, and so many seconds more.
const GIVE_UP_RATIO: f64 = 2.0;
const GIVE_UP_S: f64 = 20.0;
/// Most control periods of a drive.
const MAX_PERIODS: f64 = 2e6;
/// Acceleration of a vehicle that names none, m/s^2.
const USUAL_ACCELERATION_MPS2: f64 = 1.0;
/// Brakes without a limit of their own are stronger than the motor by this.
const BRAKING_RATIO: f64 = 2.0;

/// Drives a vehicle along a timed path by the controller of a configuration.
///
/// Unlike [`track`](crate::tracking::track), the speed changes: the drive begins standing, commands
/// take effect late, and wheels and speed change no faster than the actuators can. The map tells
/// controllers how near obstacles are; it does not stop a drive.
///
/// # Errors
/// As [`track`](crate::tracking::track), or a controller that is not compiled in.
pub fn track_in_time(
    timed: &TimedPath,
    obstacles: Option<&ObstacleMap>,
    vehicle: &Vehicle,
    config: &TrackingConfig,
) -> Result<Tracking, TrackingError> {
    match config.controller {
        Controller::RegulatedPurePursuit(mut law) => {
            track_by(timed, obstacles, vehicle, config, &mut law)
        }
        #[cfg(feature = "mpc")]
        Controller::Mpc(parameters) => {
            let mut controller = super::ModelPredictive::new(parameters);
            track_by(timed, obstacles, vehicle, config, &mut controller)
        }
        #[cfg(not(feature = "mpc"))]
        Controller::Mpc(_) => Err(TrackingError::NotCompiledIn),
        law => track_by(timed, obstacles, vehicle, config, &mut Scheduled { law }),
    }
}

/// The same, by a controller of the caller's.
///
/// # Errors
/// As [`track_in_time`].
pub fn track_by(
    timed: &TimedPath,
    obstacles: Option<&ObstacleMap>,
    vehicle: &Vehicle,
    config: &TrackingConfig,
    controller: &mut dyn DriveController,
) -> Result<Tracking, TrackingError> {
    let config = config.for_vehicle(vehicle)?;
    let stretches = stretches(timed.path())?;
    let n_steps = GIVE_UP_RATIO * timed.duration_s() / config.actuators.control_period_s;
    if !n_steps.is_finite() || n_steps > MAX_PERIODS {
        let limit = MAX_PERIODS;
        return Err(TrackingError::TooLong { n_steps, limit });
    }
    let eyes = obstacles.map(|obstacles| (obstacles, Body::new(vehicle)));
    let mut run = Run::new(timed, vehicle, config)?;
    let status = run.drive(&stretches, eyes.as_ref(), controller);
    Ok(run.conclude(vehicle, status, controller.n_failures()))
}

/// A drive under way.
struct Run<'a> {
    timed: &'a TimedPath,
    config: TrackingConfig,
    axles: AckermannAxles,
    vehicle: ActuatedVehicle,
    driven_m: f64,
    n_gear_changes: usize,
    saturated_m: f64,
    most_steer_rad: f64,
    stands_since_s: f64,
    errors: Errors,
    driven: Vec<CurveSegment>,
    trace: Vec<TracePoint>,
    next_record_s: f64,
}

/// The stretch that is driven.
struct Leg<'a> {
    stretch: &'a Stretch,
    /// Arc length of the path where it begins.
    begin_m: f64,
    /// Length driven before it.
    driven_before_m: f64,
    offset: Offset,
}

impl Leg<'_> {
    fn s_m(&self) -> f64 {
        self.begin_m + self.offset.foot_m.clamp(0.0, self.stretch.length_m())
    }

    fn left_m(&self, end_m: f64) -> f64 {
        (self.begin_m + self.stretch.length_m()).min(end_m) - self.begin_m - self.offset.foot_m
    }
}

impl<'a> Run<'a> {
    fn new(
        timed: &'a TimedPath,
        vehicle: &Vehicle,
        config: TrackingConfig,
    ) -> Result<Self, TrackingError> {
        let axles = AckermannAxles::of(vehicle).ok_or(TrackingError::NeedsAWheelbase)?;
        let of_vehicle = vehicle.parameters().max_acceleration_mps2;
        let acceleration_mps2 = config.actuators.max_acceleration_mps2.or(of_vehicle);
        let acceleration_mps2 = acceleration_mps2.unwrap_or(USUAL_ACCELERATION_MPS2);
        let braking_mps2 = config.actuators.max_braking_mps2;
        let rate = config.max_steer_rate_rad_per_s;
        let offset = config.start_offset;
        let beside = Pose2::new(offset.along_m, offset.lateral_m, offset.heading_rad);
        let limits = DriveLimits {
            wheelbase_m: axles.wheelbase_m,
            max_steer_rad: (axles.wheelbase_m * vehicle.max_curvature_per_m()).atan(),
            steer_rate_rad_per_s: rate.unwrap_or(f64::INFINITY),
            acceleration_mps2,
            braking_mps2: braking_mps2.unwrap_or(BRAKING_RATIO * acceleration_mps2),
            delay_s: config.actuators.delay_s,
            control_period_s: config.actuators.control_period_s,
        };
        let start = BicycleState {
            pose: timed.path().start().compose(beside),
            ..BicycleState::default()
        };
        Ok(Self {
            axles,
            vehicle: ActuatedVehicle::new(limits, start),
            timed,
            config,
            driven_m: 0.0,
            n_gear_changes: 0,
            saturated_m: 0.0,
            most_steer_rad: 0.0,
            stands_since_s: 0.0,
            errors: Errors::default(),
            driven: Vec::new(),
            trace: Vec::new(),
            next_record_s: 0.0,
        })
    }

    fn drive(
        &mut self,
        stretches: &[Stretch],
        eyes: Option<&(&ObstacleMap, Body)>,
        controller: &mut dyn DriveController,
    ) -> TrackingStatus {
        let Some(first) = stretches.first() else {
            let offset = Offset::beside(self.timed.path().start(), self.vehicle.state().pose);
            self.errors.add(&offset, 0.0);
            self.push(Direction::Forward, 0.0, &offset);
            return TrackingStatus::Arrived;
        };
        let mut leg = Leg {
            stretch: first,
            begin_m: 0.0,
            driven_before_m: 0.0,
            offset: Offset::new(first, self.vehicle.state().pose, 0.0),
        };
        // The wheels point along the path before the drive begins.
        let curvature_per_m = first.direction.sign() * first.curvature_at(0.0);
        self.vehicle
            .turn_wheels((self.axles.wheelbase_m * curvature_per_m).atan());
        self.errors.add(&leg.offset, 0.0);
        self.record(&leg);
        let mut at = 0;
        loop {
            self.look(&leg, eyes, controller);
            for _ in 0..N_SUBSTEPS {
                self.step(&mut leg);
            }
            if self.vehicle.t_s() >= self.next_record_s {
                self.record(&leg);
            }
            if let Some(status) = self.ending(&leg, at + 1 == stretches.len()) {
                self.record(&leg);
                return status;
            }
            if self.is_at_end(&leg) && at + 1 < stretches.len() {
                let begin_m = leg.begin_m + leg.stretch.length_m();
                at += 1;
                self.n_gear_changes = at;
                self.stands_since_s = self.vehicle.t_s();
                leg = Leg {
                    stretch: &stretches[at],
                    begin_m,
                    driven_before_m: self.driven_m,
                    offset: Offset::new(&stretches[at], self.vehicle.state().pose, 0.0),
                };
                self.record(&leg);
            }
        }
    }

    fn look(
        &mut self,
        leg: &Leg,
        eyes: Option<&(&ObstacleMap, Body)>,
        controller: &mut dyn DriveController,
    ) {
        let clearance_m = eyes.map_or(f64::INFINITY, |(obstacles, body)| {
            obstacles.clearance_m(body, obstacles.frame().to_grid(self.vehicle.state().pose))
        });
        let pending = self.vehicle.pending();
        let command = controller.command(&DriveMoment {
            t_s: self.vehicle.t_s(),
            state: self.vehicle.state(),
            pending: &pending,
            reference: self.timed,
            s_m: leg.s_m(),
            stretch_m: [leg.begin_m, leg.begin_m + leg.stretch.length_m()],
            direction: leg.stretch.direction,
            clearance_m,
            limits: *self.vehicle.limits(),
            stretch: leg.stretch,
            foot_m: leg.offset.foot_m,
            driven_m: self.driven_m - leg.driven_before_m,
        });
        self.vehicle.give(command);
    }

    /// A step of the simulation: the wheels are held while the vehicle rolls.
    fn step(&mut self, leg: &mut Leg) {
        let limits = *self.vehicle.limits();
        let drive = self
            .vehicle
            .step(limits.control_period_s / f64::from(N_SUBSTEPS));
        let signed_m = drive.signed_length_m;
        self.roll(&drive);
        let state = self.vehicle.state();
        if state.speed_mps.abs() > STANDS_MPS {
            self.stands_since_s = self.vehicle.t_s();
        }
        leg.offset = Offset::new(leg.stretch, state.pose, leg.offset.foot_m);
        self.errors.add(&leg.offset, signed_m.abs());
        let asked_rad = self.vehicle.command().steer_rad.abs();
        if asked_rad > limits.max_steer_rad * 1.01 {
            self.saturated_m += signed_m.abs();
        }
    }

    fn roll(&mut self, drive: &Drive) {
        let signed_m = drive.signed_length_m;
        if signed_m == 0.0 {
            return;
        }
        let (start, curvature_per_m) = (drive.start, drive.curvature_per_m);
        self.driven_m += signed_m.abs();
        let steer_rad = self.vehicle.state().steer_rad;
        self.most_steer_rad = self.most_steer_rad.max(steer_rad.abs());
        let direction = if signed_m > 0.0 {
            Direction::Forward
        } else {
            Direction::Reverse
        };
        match self.driven.last_mut() {
            Some(last)
                if last.curvature_per_m == curvature_per_m && last.direction == direction =>
            {
                last.length_m += signed_m.abs();
            }
            _ => self.driven.push(CurveSegment {
                start,
                curvature_per_m,
                curvature_rate_per_m2: 0.0,
                length_m: signed_m.abs(),
                direction,
            }),
        }
    }

    fn is_at_end(&self, leg: &Leg) -> bool {
        let stands = self.vehicle.state().speed_mps.abs() < STANDS_MPS;
        let left_m = leg.left_m(f64::INFINITY);
        stands && (left_m < END_M || self.is_late_and_stands() && left_m < 10.0 * END_M)
    }

    fn is_late_and_stands(&self) -> bool {
        self.vehicle.t_s() - self.stands_since_s > PATIENCE_S
    }

    fn ending(&self, leg: &Leg, is_last: bool) -> Option<TrackingStatus> {
        let end = self.timed.end();
        let stands = self.vehicle.state().speed_mps.abs() < STANDS_MPS;
        let is_there = leg.left_m(end.s_m) < END_M;
        let is_over = self.vehicle.t_s() >= end.t_s;
        let ends_here = is_last || end.s_m <= leg.begin_m + leg.stretch.length_m();
        if ends_here && is_over && stands && (is_there || self.is_late_and_stands()) {
            return Some(TrackingStatus::Arrived);
        }
        if leg.offset.cross_track_m.abs() > self.config.give_up_error_m {
            return Some(TrackingStatus::LeftPath);
        }
        let is_long = self.vehicle.t_s() > GIVE_UP_RATIO * end.t_s + GIVE_UP_S;
        is_long.then_some(TrackingStatus::GaveUp)
    }

    fn record(&mut self, leg: &Leg) {
        self.push(leg.stretch.direction, leg.s_m(), &leg.offset);
    }

    fn push(&mut self, direction: Direction, s_m: f64, offset: &Offset) {
        let (left_wheel_rad, right_wheel_rad) = self
            .axles
            .front_wheel_angles(self.vehicle.state().steer_rad);
        let point = TracePoint {
            t_s: self.vehicle.t_s(),
            driven_m: self.driven_m,
            s_m,
            pose: self.vehicle.state().pose.wrapped(),
            direction,
            steer_rad: self.vehicle.state().steer_rad,
            left_wheel_rad,
            right_wheel_rad,
            cross_track_error_m: offset.cross_track_m,
            heading_error_rad: offset.heading_rad,
            speed_mps: Some(self.vehicle.state().speed_mps),
        };
        if self.trace.last() != Some(&point) {
            self.trace.push(point);
        }
        let half_s = 0.5 * self.vehicle.limits().control_period_s;
        self.next_record_s = self.vehicle.t_s() + self.config.record_interval_s - half_s;
    }

    fn conclude(
        mut self,
        vehicle: &Vehicle,
        status: TrackingStatus,
        n_controller_failures: usize,
    ) -> Tracking {
        let first = self
            .driven
            .first()
            .map_or(self.vehicle.state().pose, |s| s.start);
        let driven = CurvePath::from_segments(first, mem::take(&mut self.driven));
        let (last, goal) = (self.vehicle.state().pose, self.timed.path().end());
        let (rms_cross_track_error_m, rms_heading_error_rad) = self.errors.rms();
        let (left, right) = self.axles.front_wheel_angles(self.most_steer_rad);
        let share = if self.driven_m > 0.0 {
            self.saturated_m / self.driven_m
        } else {
            0.0
        };
        Tracking {
            status,
            summary: TrackingSummary {
                duration_s: self.vehicle.t_s(),
                driven_m: self.driven_m,
                n_gear_changes: self.n_gear_changes,
                max_cross_track_error_m: self.errors.max_cross_track_m,
                rms_cross_track_error_m,
                max_heading_error_rad: self.errors.max_heading_rad,
                rms_heading_error_rad,
                goal_error_m: last.position().distance(goal.position()),
                goal_error_rad: angle_difference(last.heading, goal.heading).abs(),
                max_steer_rad: self.most_steer_rad,
                max_wheel_rad: left.abs().max(right.abs()),
                steering_saturated_share: share,
                swept_area_m2: swept_area_m2(vehicle, &driven),
                n_controller_failures,
            },
            trace: self.trace,
            driven,
            config: self.config,
        }
    }
}
