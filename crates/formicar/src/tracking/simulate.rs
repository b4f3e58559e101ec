//! The simulation: look, turn the wheels, roll a step.

use super::controller::Controller;
use super::errors::{Errors, Offset};
use super::stretch::{Stretch, faced, stretches};
use super::swept_area::swept_area_m2;
use super::view::View;
use super::{TracePoint, Tracking, TrackingConfig, TrackingError, TrackingStatus, TrackingSummary};
use crate::geometry::{Pose2, angle_difference};
use crate::path::{CurvePath, CurveSegment, Direction};
use crate::vehicle::{AckermannAxles, BicycleInput, BicycleState, Vehicle};
use std::mem;

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
    config: TrackingConfig,
    axles: AckermannAxles,
    max_steer_rad: f64,
    /// Length of a whole step, and driven length at which to give up.
    step_m: f64,
    give_up_m: f64,
    state: BicycleState,
    t_s: f64,
    driven_m: f64,
    n_steps: u32,
    n_gear_changes: usize,
    saturated_m: f64,
    most_steer_rad: f64,
    errors: Errors,
    driven: Vec<CurveSegment>,
    trace: Vec<TracePoint>,
    next_record_s: f64,
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
        let offset = config.start_offset;
        let beside = Pose2::new(offset.along_m, offset.lateral_m, offset.heading_rad);
        Ok(Self {
            axles,
            max_steer_rad: (axles.wheelbase_m * vehicle.max_curvature_per_m()).atan(),
            step_m,
            give_up_m,
            state: BicycleState {
                pose: path.start().compose(beside),
                ..BicycleState::default()
            },
            config,
            t_s: 0.0,
            driven_m: 0.0,
            n_steps: 0,
            n_gear_changes: 0,
            saturated_m: 0.0,
            most_steer_rad: 0.0,
            errors: Errors::default(),
            driven: Vec::new(),
            trace: Vec::new(),
            next_record_s: 0.0,
        })
    }

    fn drive(&mut self, path: &CurvePath, stretches: &[Stretch]) -> TrackingStatus {
        if stretches.is_empty() {
            self.stand(path.start());
        }
        let mut begin_m = 0.0;
        for (i, stretch) in stretches.iter().enumerate() {
            self.n_gear_changes = i;
            let mut leg = Leg {
                stretch,
                begin_m,
                driven_m: 0.0,
                offset: Offset::new(stretch, self.state.pose, 0.0),
            };
            if i == 0 {
                self.errors.add(&leg.offset, 0.0);
                self.record(&leg);
            }
            self.turn_standing(&leg);
            if let Err(status) = self.follow(&mut leg) {
                self.record(&leg);
                return status;
            }
            self.record(&leg);
            begin_m += stretch.length_m();
        }
        TrackingStatus::Arrived
    }

    /// The only point of a path without length.
    fn stand(&mut self, on_path: Pose2) {
        let offset = Offset::beside(on_path, self.state.pose);
        self.errors.add(&offset, 0.0);
        self.push(Direction::Forward, 0.0, &offset);
    }

    /// Turns the wheels to what the controller asks for first.
    fn turn_standing(&mut self, leg: &Leg) {
        let before_rad = self.state.steer_rad;
        self.turn_wheels(leg, f64::INFINITY);
        if let Some(rate) = self.config.max_steer_rate_rad_per_s {
            self.t_s += (self.state.steer_rad - before_rad).abs() / rate;
        }
        self.record(leg);
    }

    fn follow(&mut self, leg: &mut Leg) -> Result<(), TrackingStatus> {
        while let Some(length_m) = self.step_length_m(leg) {
            let is_saturated = self.turn_wheels(leg, length_m / self.config.speed());
            self.saturated_m += if is_saturated { length_m } else { 0.0 };
            self.roll(leg.stretch.direction, length_m);
            leg.driven_m += length_m;
            leg.offset = Offset::new(leg.stretch, self.state.pose, leg.offset.foot_m);
            self.errors.add(&leg.offset, length_m);
            if self.t_s >= self.next_record_s {
                self.record(leg);
            }
            if leg.offset.cross_track_m.abs() > self.config.give_up_error_m {
                return Err(TrackingStatus::LeftPath);
            }
            if self.driven_m > self.give_up_m || self.n_steps > 2 * MAX_STEPS {
                return Err(TrackingStatus::GaveUp);
            }
        }
        Ok(())
    }

    /// The length to roll next; 0 at the end of the stretch. Without a look at the vehicle the
    /// end is where the driven length says, and a step ends where the path's steering changes.
    fn step_length_m(&self, leg: &Leg) -> Option<f64> {
        let length_m = leg.stretch.length_m();
        let [left_m, to_joint_m, least_m] = if self.config.controller == Controller::OpenLoop {
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
        let asked_rad = self.config.controller.steer_rad(&View {
            stretch: leg.stretch,
            driven_m: leg.driven_m,
            foot_m: leg.offset.foot_m,
            pose: faced(self.state.pose, direction),
            wheelbase_m: self.axles.wheelbase_m,
            speed_mps: self.config.speed(),
        });
        let limit = self.max_steer_rad;
        let asked = direction.sign() * asked_rad;
        let now = self.state.steer_rad;
        let rate = self.config.max_steer_rate_rad_per_s;
        let most = rate.map_or(f64::INFINITY, |rate| rate * duration_s);
        self.state.steer_rad = asked.clamp(-limit, limit).clamp(now - most, now + most);
        asked.abs() > limit * (1.0 + SATURATED)
    }

    fn roll(&mut self, direction: Direction, length_m: f64) {
        let start = self.state.pose;
        self.state.speed_mps = direction.sign() * self.config.speed();
        let duration_s = length_m / self.config.speed();
        self.state = self
            .state
            .step(self.axles.wheelbase_m, BicycleInput::default(), duration_s);
        self.lengthen(CurveSegment {
            start,
            curvature_per_m: self.state.steer_rad.tan() / self.axles.wheelbase_m,
            curvature_rate_per_m2: 0.0,
            length_m,
            direction,
        });
        self.t_s += duration_s;
        self.driven_m += length_m;
        self.n_steps += 1;
        self.most_steer_rad = self.most_steer_rad.max(self.state.steer_rad.abs());
    }

    /// Adds what was driven: wheels that are held over several steps drive one arc.
    fn lengthen(&mut self, step: CurveSegment) {
        if let Some(last) = self.driven.last_mut() {
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
        self.driven.push(step);
    }

    fn record(&mut self, leg: &Leg) {
        let on_stretch_m = leg.offset.foot_m.clamp(0.0, leg.stretch.length_m());
        let s_m = leg.begin_m + on_stretch_m;
        self.push(leg.stretch.direction, s_m, &leg.offset);
    }

    fn push(&mut self, direction: Direction, s_m: f64, offset: &Offset) {
        let (left_wheel_rad, right_wheel_rad) = self.axles.front_wheel_angles(self.state.steer_rad);
        let point = TracePoint {
            t_s: self.t_s,
            driven_m: self.driven_m,
            s_m,
            pose: self.state.pose.wrapped(),
            direction,
            steer_rad: self.state.steer_rad,
            left_wheel_rad,
            right_wheel_rad,
            cross_track_error_m: offset.cross_track_m,
            heading_error_rad: offset.heading_rad,
            speed_mps: None,
        };
        if self.trace.last() != Some(&point) {
            self.trace.push(point);
        }
        // The step that ends nearest to the interval, whichever way the sum of steps is rounded.
        let TrackingConfig {
            record_interval_s,
            time_step_s,
            ..
        } = self.config;
        self.next_record_s = self.t_s + record_interval_s - 0.5 * time_step_s;
    }

    fn conclude(mut self, path: &CurvePath, vehicle: &Vehicle, status: TrackingStatus) -> Tracking {
        let first = self.driven.first().map_or(self.state.pose, |s| s.start);
        let driven = CurvePath::from_segments(first, mem::take(&mut self.driven));
        Tracking {
            status,
            summary: self.summary(path, swept_area_m2(vehicle, &driven)),
            trace: self.trace,
            driven,
            config: self.config,
        }
    }

    fn summary(&self, path: &CurvePath, swept_area_m2: f64) -> TrackingSummary {
        let (last, goal) = (self.state.pose, path.end());
        let (rms_cross_track_error_m, rms_heading_error_rad) = self.errors.rms();
        let (left, right) = self.axles.front_wheel_angles(self.most_steer_rad);
        let share = |part_m: f64| {
            if self.driven_m > 0.0 {
                part_m / self.driven_m
            } else {
                0.0
            }
        };
        TrackingSummary {
            duration_s: self.t_s,
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
            steering_saturated_share: share(self.saturated_m),
            swept_area_m2,
            n_controller_failures: 0,
        }
    }
}
