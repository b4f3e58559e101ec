//! The simulation in time: command, delay, actuators, roll.

use super::actuated::ActuatedVehicle;
use super::controller::{DriveController, DriveLimits, DriveMoment};
use super::laws::Scheduled;
use crate::collision::{Body, ClearanceAlong, Drive, ObstacleMap};
use crate::path::{CurveSegment, Direction, TimedPath};
use crate::tracking::errors::Offset;
use crate::tracking::record::{DriveRecord, Ending, Sighting};
use crate::tracking::stretch::{Stretch, stretches};
use crate::tracking::{Controller, Tracking, TrackingConfig, TrackingError, TrackingStatus};
use crate::vehicle::{AckermannAxles, BicycleState, Vehicle};

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
    let body = Body::new(vehicle);
    let eyes = obstacles.map(|obstacles| ClearanceAlong::new(obstacles, &body));
    let mut run = Run::new(timed, vehicle, config)?;
    let status = run.drive(&stretches, eyes, controller);
    Ok(run.conclude(vehicle, status, controller.n_failures()))
}

/// A drive under way.
struct Run<'a> {
    timed: &'a TimedPath,
    record: DriveRecord,
    vehicle: ActuatedVehicle,
    stands_since_s: f64,
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
        let rate = config.max_steer_rate_rad_per_s;
        let limits = DriveLimits::of(vehicle, &config.actuators, rate)?;
        let start = BicycleState {
            pose: config.start_offset.beside(timed.path().start()),
            ..BicycleState::default()
        };
        Ok(Self {
            vehicle: ActuatedVehicle::new(limits, start),
            timed,
            record: DriveRecord::new(axles, config),
            stands_since_s: 0.0,
        })
    }

    fn drive(
        &mut self,
        stretches: &[Stretch],
        mut eyes: Option<ClearanceAlong>,
        controller: &mut dyn DriveController,
    ) -> TrackingStatus {
        let Some(first) = stretches.first() else {
            let offset = Offset::beside(self.timed.path().start(), self.vehicle.state().pose);
            self.record.measure(&offset, 0.0, false);
            self.note_beside(Direction::Forward, 0.0, &offset);
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
        let wheelbase_m = self.vehicle.limits().wheelbase_m;
        self.vehicle
            .turn_wheels((wheelbase_m * curvature_per_m).atan());
        self.record.measure(&leg.offset, 0.0, false);
        self.note(&leg);
        let mut at = 0;
        loop {
            self.look(&leg, eyes.as_mut(), controller);
            for _ in 0..N_SUBSTEPS {
                self.step(&mut leg);
            }
            if self.record.is_due(self.vehicle.t_s()) {
                self.note(&leg);
            }
            if let Some(status) = self.ending(&leg, at + 1 == stretches.len()) {
                self.note(&leg);
                return status;
            }
            if self.is_at_end(&leg) && at + 1 < stretches.len() {
                let begin_m = leg.begin_m + leg.stretch.length_m();
                at += 1;
                self.record.n_gear_changes = at;
                self.stands_since_s = self.vehicle.t_s();
                leg = Leg {
                    stretch: &stretches[at],
                    begin_m,
                    driven_before_m: self.record.driven_m,
                    offset: Offset::new(&stretches[at], self.vehicle.state().pose, 0.0),
                };
                self.note(&leg);
            }
        }
    }

    fn look(
        &mut self,
        leg: &Leg,
        eyes: Option<&mut ClearanceAlong>,
        controller: &mut dyn DriveController,
    ) {
        let pose = self.vehicle.state().pose;
        let clearance_m = eyes.map_or(f64::INFINITY, |eyes| eyes.at_m(pose));
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
            driven_m: self.record.driven_m - leg.driven_before_m,
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
        let asked_rad = self.vehicle.command().steer_rad.abs();
        let is_saturated = asked_rad > limits.max_steer_rad * 1.01;
        self.record
            .measure(&leg.offset, signed_m.abs(), is_saturated);
    }

    fn roll(&mut self, drive: &Drive) {
        let signed_m = drive.signed_length_m;
        if signed_m == 0.0 {
            return;
        }
        let (start, curvature_per_m) = (drive.start, drive.curvature_per_m);
        let steer_rad = self.vehicle.state().steer_rad;
        self.record.roll(signed_m.abs(), steer_rad);
        let direction = if signed_m > 0.0 {
            Direction::Forward
        } else {
            Direction::Reverse
        };
        match self.record.driven.last_mut() {
            Some(last)
                if last.curvature_per_m == curvature_per_m && last.direction == direction =>
            {
                last.length_m += signed_m.abs();
            }
            _ => self.record.driven.push(CurveSegment {
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
        if leg.offset.cross_track_m.abs() > self.record.config().give_up_error_m {
            return Some(TrackingStatus::LeftPath);
        }
        let is_long = self.vehicle.t_s() > GIVE_UP_RATIO * end.t_s + GIVE_UP_S;
        is_long.then_some(TrackingStatus::GaveUp)
    }

    fn note(&mut self, leg: &Leg) {
        self.note_beside(leg.stretch.direction, leg.s_m(), &leg.offset);
    }

    fn note_beside(&mut self, direction: Direction, s_m: f64, offset: &Offset) {
        let state = self.vehicle.state();
        self.record.note(&Sighting {
            t_s: self.vehicle.t_s(),
            state: &state,
            speed_mps: Some(state.speed_mps),
            direction,
            s_m,
            offset,
            step_s: self.vehicle.limits().control_period_s,
        });
    }

    fn conclude(
        self,
        vehicle: &Vehicle,
        status: TrackingStatus,
        n_controller_failures: usize,
    ) -> Tracking {
        let end = Ending {
            status,
            t_s: self.vehicle.t_s(),
            pose: self.vehicle.state().pose,
            goal: self.timed.path().end(),
            n_controller_failures,
        };
        self.record.conclude(vehicle, &end)
    }
}
