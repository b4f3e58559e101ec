//! One verdict on a drive.

use super::distance::Distances;
use super::profile::Profile;
use super::report::{TimedReport, TimedViolation, TimedViolationKind};
use super::rules::DriveRules;
use crate::path::TimedPath;

/// Judges a drive in time: that its phases join, that the vehicle stands where its gear changes and
/// where its wheels turn, that it keeps the limits, and that its body keeps its distance from every
/// prediction, over the whole drive and the whole horizon. Standing obstacles are the business of
/// [`judge`](crate::validation::judge), since a path that is free of them is so at any speed.
///
/// The distance is proven, not sampled. At a moment it is the widest gap between the two convex
/// shapes over all directions that can be widest: normals of their edges, and lines through two of
/// their corners. Between two moments it changes no faster than the fastest points of both move;
/// spans of time are halved, the least certain first, until that bound is within 0.1 mm of what is
/// found and decides about the wished distance. How the speed was planned is not known here.
///
/// The cost grows with the logarithm of the precision, and with the number of obstacles that come
/// near.
pub fn judge_in_time(rules: &DriveRules, timed: &TimedPath) -> TimedReport {
    let mut report = TimedReport {
        valid: false,
        arrives: timed.arrives(),
        duration_s: timed.duration_s(),
        horizon_s: rules.predictions.horizon_s(),
        distance_m: rules.distance_m,
        min_distance_m: None,
        nearest: None,
        max_speed_mps: 0.0,
        max_acceleration_mps2: 0.0,
        max_braking_mps2: 0.0,
        max_lateral_mps2: 0.0,
        max_steer_rate_rad_per_s: rules.vehicle.wheelbase_m().map(|_| 0.0),
        max_jerk_mps3: 0.0,
        violations: Vec::new(),
    };
    let profile = Profile::new(rules, timed);
    profile.check(&mut report);
    let is_malformed = |v: &TimedViolation| v.kind == TimedViolationKind::Malformed;
    if !report.violations.iter().any(is_malformed) {
        Distances::new(rules, timed).check(&mut report);
    }
    report.violations.sort_by(|a, b| a.t_s.total_cmp(&b.t_s));
    report.valid = report.violations.is_empty();
    report
}
