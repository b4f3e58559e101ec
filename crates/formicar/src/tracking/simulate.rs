//! The simulation: look, turn the wheels, roll a step.

use super::controller::Controller;
use super::errors::Offset;
use super::record::{DriveRecord, Ending, Sighting};
use super::stretch::{Stretch, faced, stretches};
use super::view::View;
use super::{Tracking, TrackingConfig, TrackingError, TrackingStatus};
use crate::geometry::Pose2;
use crate::path::{CurvePath, CurveSegment, Direction};
use crate::vehicle::{AckermannAxles, BicycleInput, BicycleState, Vehicle};

/// Most steps of a drive.
const MAX_STEPS: u32 = 5_000_000;
/// A stretch ends where less than this share of a step is left of it.
const LEAST_STEP: f64 = 0.01;
/// By how much, relative to the limit, a controller may ask for more before that counts: less is
/// the trembling about an arc that takes the limit itself.
const SATURATED: f64 = 0.01;
/// The largest distance of a driven arc's end from the simulated pose where the arc stands for
/// several steps, meters.
const SAME_ARC_M: f64 = 1e-9;

/// Drives a vehicle along a path.
///
/// The same path, vehicle and configuration give the same drive, to the last bit. The cost is
/// proportional to driven length / (speed * time step).
///
/// # Errors
/// A vehicle that does not steer or whose wheelbase is unknown, a parameter out of its range, a
/// path that jumps or has numbers that are none, or one that would take more than 5 million steps.
///
/// ```
/// use formicar::path::Direction::Forward;
/// use formicar::tracking::{TrackingConfig, TrackingStatus, track};
/// use formicar::{CurvePath, Pose2, Vehicle};
///
/// let mut path = CurvePath::new(Pose2::default());
/// path.push(0.0, 3.0, Forward);
/// path.push(0.5, 2.0, Forward);
/// let driven = track(&path, &Vehicle::warehouse_amr(), &TrackingConfig::default())?;
/// assert_eq!(driven.status, TrackingStatus::Arrived);
/// assert!(driven.summary.max_cross_track_error_m < 0.1);
/// # Ok::<(), formicar::tracking::TrackingError>(())
/// ```
pub fn track(
    path: &CurvePath,
    vehicle: &Vehicle,
    config: &TrackingConfig,
) -> Result<Tracking, TrackingError> {
    let config = config.for_vehicle(vehicle)?;
    if config.controller.needs_time() {
        let controller = config.controller.name();
        return Err(TrackingError::NeedsTime { controller });
    }
    let stretches = stretches(path)?;
    let mut run = Run::new(path, vehicle, config)?;
    let status = run.drive(path, &stretches);
    Ok(run.conclude(path, vehicle, status))
}

/// A drive under way.
struct Run {
    record: DriveRecord,
    wheelbase_m: f64,
    max_steer_rad: f64,
    /// Length of a whole step, and driven length at which to give up.
    step_m: f64,
    give_up_m: f64,
    state: BicycleState,
    t_s: f64,
    n_steps: u32,
}

/// The stretch that is driven, and how far.
struct Leg<'a> {
    stretch: &'a Stretch,
    /// Arc length of the path where the stretch begins.
    begin_m: f64,
    driven_m: f64,
    offset: Offset,
}

impl Run {
    fn new(
        path: &CurvePath,
        vehicle: &Vehicle,
        config: TrackingConfig,
    ) -> Result<Self, TrackingError> {
        let axles = AckermannAxles::of(vehicle).ok_or(TrackingError::NeedsAWheelbase)?;
        let step_m = config.speed() * config.time_step_s;
        let way_m = path.length_m() + vehicle.min_turning_radius_m();
        let give_up_m = config.give_up_length_ratio * way_m;
        let n_steps = give_up_m / step_m;
        let limit = f64::from(MAX_STEPS);
        if n_steps > limit {
            return Err(TrackingError::TooLong { n_steps, limit });
        }
        Ok(Self {
            wheelbase_m: axles.wheelbase_m,
            max_steer_rad: (axles.wheelbase_m * vehicle.max_curvature_per_m()).atan(),
            step_m,
            give_up_m,
            state: BicycleState {
                pose: config.start_offset.beside(path.start()),
                ..BicycleState::default()
            },
            t_s: 0.0,
            n_steps: 0,
            record: DriveRecord::new(axles, config),
        })
    }

    fn config(&self) -> &TrackingConfig {
        self.record.config()
    }

    fn drive(&mut self, path: &CurvePath, stretches: &[Stretch]) -> TrackingStatus {
        if stretches.is_empty() {
            self.stand(path.start());
        }
        let mut begin_m = 0.0;
        for (i, stretch) in stretches.iter().enumerate() {
            self.record.n_gear_changes = i;
            let mut leg = Leg {
                stretch,
                begin_m,
                driven_m: 0.0,
                offset: Offset::new(stretch, self.state.pose, 0.0),
            };
            if i == 0 {
                self.record.measure(&leg.offset, 0.0, false);
                self.note(&leg);
            }
            self.turn_standing(&leg);
            if let Err(status) = self.follow(&mut leg) {
                self.note(&leg);
                return status;
            }
            self.note(&leg);
            begin_m += stretch.length_m();
        }
        TrackingStatus::Arrived
    }

    /// The only point of a path without length.
    fn stand(&mut self, on_path: Pose2) {
        let offset = Offset::beside(on_path, self.state.pose);
        self.record.measure(&offset, 0.0, false);
        self.note_beside(Direction::Forward, 0.0, &offset);
    }

    /// Turns the wheels to what the controller asks for first.
    fn turn_standing(&mut self, leg: &Leg) {
        let before_rad = self.state.steer_rad;
        self.turn_wheels(leg, f64::INFINITY);
        if let Some(rate) = self.config().max_steer_rate_rad_per_s {
            self.t_s += (self.state.steer_rad - before_rad).abs() / rate;
        }
        self.note(leg);
    }

    fn follow(&mut self, leg: &mut Leg) -> Result<(), TrackingStatus> {
        while let Some(length_m) = self.step_length_m(leg) {
            let is_saturated = self.turn_wheels(leg, length_m / self.config().speed());
            self.roll(leg.stretch.direction, length_m);
            leg.driven_m += length_m;
            leg.offset = Offset::new(leg.stretch, self.state.pose, leg.offset.foot_m);
            self.record.measure(&leg.offset, length_m, is_saturated);
            if self.record.is_due(self.t_s) {
                self.note(leg);
            }
            if leg.offset.cross_track_m.abs() > self.config().give_up_error_m {
                return Err(TrackingStatus::LeftPath);
            }
            if self.record.driven_m > self.give_up_m || self.n_steps > 2 * MAX_STEPS {
                return Err(TrackingStatus::GaveUp);
            }
        }
        Ok(())
    }

    /// The length to roll next; 0 at the end of the stretch. Without a look at the vehicle the
    /// end is where the driven length says, and a step ends where the path's steering changes.
    fn step_length_m(&self, leg: &Leg) -> Option<f64> {
        let length_m = leg.stretch.length_m();
        let [left_m, to_joint_m, least_m] = if self.config().controller == Controller::OpenLoop {
            let joint_m = leg.stretch.next_joint_m(leg.driven_m);
            [length_m - leg.driven_m, joint_m - leg.driven_m, 0.0]
        } else {
            let least_m = LEAST_STEP * self.step_m;
            [length_m - leg.offset.foot_m, f64::INFINITY, least_m]
        };
        (left_m > least_m).then(|| self.step_m.min(left_m).min(to_joint_m))
    }

    /// Turns the wheels as far towards what the controller asks for as limit and rate allow in a
    /// time; returns whether it asked for more than the limit.
    fn turn_wheels(&mut self, leg: &Leg, duration_s: f64) -> bool {
        let direction = leg.stretch.direction;
        let asked_rad = self.config().controller.steer_rad(&View {
            stretch: leg.stretch,
            driven_m: leg.driven_m,
            foot_m: leg.offset.foot_m,
            pose: faced(self.state.pose, direction),
            wheelbase_m: self.wheelbase_m,
            speed_mps: self.config().speed(),
        });
        let limit = self.max_steer_rad;
        let asked = direction.sign() * asked_rad;
        let now = self.state.steer_rad;
        let rate = self.config().max_steer_rate_rad_per_s;
        let most = rate.map_or(f64::INFINITY, |rate| rate * duration_s);
        self.state.steer_rad = asked.clamp(-limit, limit).clamp(now - most, now + most);
        asked.abs() > limit * (1.0 + SATURATED)
    }

    fn roll(&mut self, direction: Direction, length_m: f64) {
        let start = self.state.pose;
        self.state.speed_mps = direction.sign() * self.config().speed();
        let duration_s = length_m / self.config().speed();
        self.state = self
            .state
            .step(self.wheelbase_m, BicycleInput::default(), duration_s);
        self.lengthen(CurveSegment {
            start,
            curvature_per_m: self.state.steer_rad.tan() / self.wheelbase_m,
            curvature_rate_per_m2: 0.0,
            length_m,
            direction,
        });
        self.t_s += duration_s;
        self.n_steps += 1;
        self.record.roll(length_m, self.state.steer_rad);
    }

    /// Adds what was driven: wheels that are held over several steps drive one arc.
    fn lengthen(&mut self, step: CurveSegment) {
        if let Some(last) = self.record.driven.last_mut() {
            let longer = CurveSegment {
                length_m: last.length_m + step.length_m,
                ..*last
            };
            let goes_on =
                (last.curvature_per_m, last.direction) == (step.curvature_per_m, step.direction);
            let miss_m = longer.end().position().distance(self.state.pose.position());
            if goes_on && miss_m < SAME_ARC_M {
                *last = longer;
                return;
            }
        }
        self.record.driven.push(step);
    }

    fn note(&mut self, leg: &Leg) {
        let on_stretch_m = leg.offset.foot_m.clamp(0.0, leg.stretch.length_m());
        let s_m = leg.begin_m + on_stretch_m;
        self.note_beside(leg.stretch.direction, s_m, &leg.offset);
    }

    fn note_beside(&mut self, direction: Direction, s_m: f64, offset: &Offset) {
        let step_s = self.config().time_step_s;
        self.record.note(&Sighting {
            t_s: self.t_s,
            state: &self.state,
            speed_mps: None,
            direction,
            s_m,
            offset,
            step_s,
        });
    }

    fn conclude(self, path: &CurvePath, vehicle: &Vehicle, status: TrackingStatus) -> Tracking {
        let end = Ending {
            status,
            t_s: self.t_s,
            pose: self.state.pose,
            goal: path.end(),
            n_controller_failures: 0,
        };
        self.record.conclude(vehicle, &end)
    }
}
