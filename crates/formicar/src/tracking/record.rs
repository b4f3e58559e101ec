//! What is noted of a drive while it is simulated.

use super::errors::{Errors, Offset};
use super::swept_area::swept_area_m2;
use super::{TracePoint, Tracking, TrackingConfig, TrackingStatus, TrackingSummary};
use crate::geometry::{Pose2, angle_difference};
use crate::path::{CurvePath, CurveSegment, Direction};
use crate::vehicle::{AckermannAxles, BicycleState, Vehicle};

/// Lengths, errors and the trace of a drive.
pub(super) struct DriveRecord {
    axles: AckermannAxles,
    config: TrackingConfig,
    pub(super) driven_m: f64,
    pub(super) n_gear_changes: usize,
    saturated_m: f64,
    most_steer_rad: f64,
    errors: Errors,
    /// The driven path.
    pub(super) driven: Vec<CurveSegment>,
    trace: Vec<TracePoint>,
    next_record_s: f64,
}

/// A vehicle at a moment, beside its path.
pub(super) struct Sighting<'a> {
    pub(super) t_s: f64,
    pub(super) state: &'a BicycleState,
    /// The speed where it is part of the simulation, m/s.
    pub(super) speed_mps: Option<f64>,
    pub(super) direction: Direction,
    pub(super) s_m: f64,
    pub(super) offset: &'a Offset,
    /// Time between two moments, seconds.
    pub(super) step_s: f64,
}

/// The ending of a drive.
pub(super) struct Ending {
    pub(super) status: TrackingStatus,
    pub(super) t_s: f64,
    pub(super) pose: Pose2,
    /// The end of the path.
    pub(super) goal: Pose2,
    pub(super) n_controller_failures: usize,
}

impl DriveRecord {
    pub(super) fn new(axles: AckermannAxles, config: TrackingConfig) -> Self {
        Self {
            axles,
            config,
            driven_m: 0.0,
            n_gear_changes: 0,
            saturated_m: 0.0,
            most_steer_rad: 0.0,
            errors: Errors::default(),
            driven: Vec::new(),
            trace: Vec::new(),
            next_record_s: 0.0,
        }
    }

    pub(super) fn config(&self) -> &TrackingConfig {
        &self.config
    }

    /// Counts a length that was driven at a steering angle.
    pub(super) fn roll(&mut self, length_m: f64, steer_rad: f64) {
        self.driven_m += length_m;
        self.most_steer_rad = self.most_steer_rad.max(steer_rad.abs());
    }

    /// Counts where the vehicle is after a length, and whether more than the steering limit was
    /// asked for on it.
    pub(super) fn measure(&mut self, offset: &Offset, length_m: f64, is_saturated: bool) {
        self.errors.add(offset, length_m);
        self.saturated_m += if is_saturated { length_m } else { 0.0 };
    }

    /// True once the trace wants its next point.
    pub(super) fn is_due(&self, t_s: f64) -> bool {
        t_s >= self.next_record_s
    }

    /// Adds a point to the trace.
    pub(super) fn note(&mut self, at: &Sighting) {
        let steer_rad = at.state.steer_rad;
        let (left_wheel_rad, right_wheel_rad) = self.axles.front_wheel_angles(steer_rad);
        let point = TracePoint {
            t_s: at.t_s,
            driven_m: self.driven_m,
            s_m: at.s_m,
            pose: at.state.pose.wrapped(),
            direction: at.direction,
            steer_rad,
            left_wheel_rad,
            right_wheel_rad,
            cross_track_error_m: at.offset.cross_track_m,
            heading_error_rad: at.offset.heading_rad,
            speed_mps: at.speed_mps,
        };
        if self.trace.last() != Some(&point) {
            self.trace.push(point);
        }
        // The step that ends nearest to the interval, whichever way the sum of steps is rounded.
        self.next_record_s = at.t_s + self.config.record_interval_s - 0.5 * at.step_s;
    }

    /// The drive as a value.
    pub(super) fn conclude(self, vehicle: &Vehicle, end: &Ending) -> Tracking {
        let (rms_cross_track_error_m, rms_heading_error_rad) = self.errors.rms();
        let (left, right) = self.axles.front_wheel_angles(self.most_steer_rad);
        let steering_saturated_share = if self.driven_m > 0.0 {
            self.saturated_m / self.driven_m
        } else {
            0.0
        };
        let first = self.driven.first().map_or(end.pose, |s| s.start);
        let driven = CurvePath::from_segments(first, self.driven);
        Tracking {
            status: end.status,
            summary: TrackingSummary {
                duration_s: end.t_s,
                driven_m: self.driven_m,
                n_gear_changes: self.n_gear_changes,
                max_cross_track_error_m: self.errors.max_cross_track_m,
                rms_cross_track_error_m,
                max_heading_error_rad: self.errors.max_heading_rad,
                rms_heading_error_rad,
                goal_error_m: end.pose.position().distance(end.goal.position()),
                goal_error_rad: angle_difference(end.pose.heading, end.goal.heading).abs(),
                max_steer_rad: self.most_steer_rad,
                max_wheel_rad: left.abs().max(right.abs()),
                steering_saturated_share,
                swept_area_m2: swept_area_m2(vehicle, &driven),
                n_controller_failures: end.n_controller_failures,
            },
            trace: self.trace,
            driven,
            config: self.config,
        }
    }
}
