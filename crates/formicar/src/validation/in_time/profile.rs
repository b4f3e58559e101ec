//! The profile by itself: phases that join, stops where they must be, limits.

use super::report::{TimedReport, TimedViolation, TimedViolationKind as Kind};
use super::rules::DriveRules;
use crate::path::{CurveSegment, Phase, TimedPath, TimedState, steer_rate_rad_per_s};

/// Gaps between phases: meters, seconds, m/s.
const JOINT_TOLERANCE: f64 = 1e-6;
/// The share of a limit by which a value may exceed it: rounding of profiles that reach it.
const LIMIT_TOLERANCE: f64 = 1e-6;
/// A vehicle that is slower stands: it gets there within the tolerance of a joint.
const STANDS_MPS: f64 = 2e-3;
/// Curvatures that differ by less are one.
const SAME_CURVATURE_PER_M: f64 = 1e-9;
/// Halvings of a piece until a bound that exceeds a limit, while no value does, is rounding.
const MAX_HALVINGS: u32 = 24;
/// Zones are looked at so often, meters.
const ZONE_SPACING_M: f64 = 0.01;

pub(super) struct Profile<'a> {
    rules: &'a DriveRules<'a>,
    timed: &'a TimedPath,
}

/// A part of a phase on one segment.
#[derive(Clone, Copy)]
struct Piece<'a> {
    phase: &'a Phase,
    segment: &'a CurveSegment,
    /// Arc length where the segment begins.
    begin_m: f64,
    /// Times since the phase began.
    from_s: f64,
    to_s: f64,
}

impl<'a> Profile<'a> {
    pub(super) fn new(rules: &'a DriveRules<'a>, timed: &'a TimedPath) -> Self {
        Self { rules, timed }
    }

    /// Adds extremes and violations to a report.
    pub(super) fn check(&self, report: &mut TimedReport) {
        self.check_form(report);
        if !report.violations.is_empty() {
            return;
        }
        self.check_joints(report);
        self.check_phases(report);
        self.check_stops(report);
        self.check_bends(report);
        self.check_zones(report);
    }

    fn violation(
        &self,
        kind: Kind,
        state: TimedState,
        [amount, limit]: [f64; 2],
        what: &str,
    ) -> TimedViolation {
        TimedViolation {
            kind,
            t_s: state.t_s,
            s_m: state.s_m,
            pose: self.timed.path().pose_at(state.s_m).wrapped(),
            amount,
            limit,
            message: format!(
                "{what} at {:.2} s, {:.2} m along the path: {amount:.4}, allowed {limit:.4}",
                state.t_s, state.s_m
            ),
        }
    }

    fn check_form(&self, report: &mut TimedReport) {
        let numbers = |p: &Phase| {
            [
                p.t_s,
                p.s_m,
                p.speed_mps,
                p.acceleration_mps2,
                p.jerk_mps3,
                p.duration_s,
                p.end().s_m,
            ]
        };
        for phase in self.timed.phases() {
            let is_finite = numbers(phase).iter().all(|number| number.is_finite());
            let is_forward = [0.0, 0.25, 0.5, 0.75, 1.0].iter().all(|share| {
                let elapsed_s = share * phase.duration_s;
                let (a, j) = (phase.acceleration_mps2, phase.jerk_mps3);
                phase.speed_mps + elapsed_s * (a + 0.5 * elapsed_s * j) >= -JOINT_TOLERANCE
            });
            if !(is_finite && phase.duration_s >= 0.0 && is_forward) {
                let state = TimedState {
                    t_s: phase.t_s,
                    ..TimedState::default()
                };
                let what = "a phase is no number, runs back or has a negative duration";
                let numbers = [phase.duration_s, 0.0];
                report
                    .violations
                    .push(self.violation(Kind::Malformed, state, numbers, what));
                return;
            }
        }
    }

    /// The first phase begins at rest or at the present speed, each begins where the one before it
    /// ends, and the last one ends standing on the path.
    fn check_joints(&self, report: &mut TimedReport) {
        let phases = self.timed.phases();
        let begin = TimedState {
            speed_mps: self.rules.present_speed_mps,
            ..TimedState::default()
        };
        let mut before = begin;
        for (i, phase) in phases.iter().enumerate() {
            let here = phase.after(0.0);
            let gaps = [
                here.t_s - before.t_s,
                here.s_m - before.s_m,
                here.speed_mps - before.speed_mps,
            ];
            let is_smooth = self.rules.limits.max_jerk_mps3.is_some() && i > 0;
            let jump_mps2 = here.acceleration_mps2 - before.acceleration_mps2;
            if let Some(gap) = gaps.iter().find(|gap| gap.abs() > JOINT_TOLERANCE) {
                let numbers = [gap.abs(), JOINT_TOLERANCE];
                let what = "two phases do not join";
                report
                    .violations
                    .push(self.violation(Kind::Discontinuity, here, numbers, what));
            } else if is_smooth && jump_mps2.abs() > JOINT_TOLERANCE {
                let numbers = [jump_mps2.abs(), 0.0];
                let what = "the acceleration jumps (m/s^2)";
                report
                    .violations
                    .push(self.violation(Kind::Jerk, here, numbers, what));
            }
            before = phase.end();
        }
        let length_m = self.timed.path().length_m();
        if before.speed_mps > STANDS_MPS || before.s_m > length_m + JOINT_TOLERANCE {
            let numbers = [before.speed_mps, 0.0];
            let what = "the drive does not end standing on the path (m/s)";
            report
                .violations
                .push(self.violation(Kind::Discontinuity, before, numbers, what));
        }
    }

    fn check_phases(&self, report: &mut TimedReport) {
        let limits = self.rules.limits;
        for phase in self.timed.phases().iter().filter(|p| p.duration_s > 0.0) {
            let vertex_s = -phase.acceleration_mps2 / phase.jerk_mps3;
            let inside = (vertex_s > 0.0 && vertex_s < phase.duration_s).then_some(vertex_s);
            let moments = [Some(0.0), inside, Some(phase.duration_s)];
            for state in moments.into_iter().flatten().map(|s| phase.after(s)) {
                let acceleration = state.acceleration_mps2;
                report.max_speed_mps = report.max_speed_mps.max(state.speed_mps);
                report.max_acceleration_mps2 = report.max_acceleration_mps2.max(acceleration);
                report.max_braking_mps2 = report.max_braking_mps2.max(-acceleration);
                let found = [
                    (
                        Kind::Speed,
                        state.speed_mps,
                        limits.max_speed_mps,
                        "speed (m/s)",
                    ),
                    (
                        Kind::Acceleration,
                        acceleration,
                        limits.max_acceleration_mps2,
                        "acceleration (m/s^2)",
                    ),
                    (
                        Kind::Acceleration,
                        -acceleration,
                        limits.braking_mps2(),
                        "deceleration (m/s^2)",
                    ),
                ];
                for (kind, amount, limit, what) in found {
                    self.hold(report, (kind, what), state, [amount, limit]);
                }
            }
            report.max_jerk_mps3 = report.max_jerk_mps3.max(phase.jerk_mps3.abs());
            if let Some(limit) = limits.max_jerk_mps3 {
                let numbers = [phase.jerk_mps3.abs(), limit];
                self.hold(
                    report,
                    (Kind::Jerk, "jerk (m/s^3)"),
                    phase.after(0.0),
                    numbers,
                );
            }
        }
    }

    /// Adds a violation where a value exceeds a limit.
    fn hold(
        &self,
        report: &mut TimedReport,
        (kind, what): (Kind, &str),
        state: TimedState,
        [amount, limit]: [f64; 2],
    ) {
        if amount > limit * (1.0 + LIMIT_TOLERANCE) {
            let violation = self.violation(kind, state, [amount, limit], what);
            report.violations.push(violation);
        }
    }

    /// Where the gear changes the vehicle stands, and where the curvature jumps its wheels turn
    /// standing, if it is known how fast they do.
    fn check_stops(&self, report: &mut TimedReport) {
        let limits = self.rules.limits;
        let rate = limits.max_steer_rate_rad_per_s;
        let steering = self.rules.vehicle.wheelbase_m().zip(rate);
        let segments = self.timed.path().segments().iter();
        let segments: Vec<_> = segments.filter(|s| s.length_m > 0.0).collect();
        let end_m = self.timed.end().s_m;
        let mut joint_m = 0.0;
        for pair in segments.windows(2) {
            joint_m += pair[0].length_m;
            if joint_m >= end_m - JOINT_TOLERANCE {
                return;
            }
            let (from, to) = (pair[0].end_curvature_per_m(), pair[1].curvature_per_m);
            let jumps = (to - from).abs() > SAME_CURVATURE_PER_M;
            let turning_s = steering.filter(|_| jumps).map(|(wheelbase_m, rate)| {
                let steer = |curvature: f64| (wheelbase_m * curvature).atan();
                (steer(to) - steer(from)).abs() / rate
            });
            let changes_gear = pair[0].direction != pair[1].direction;
            if !changes_gear && turning_s.is_none() {
                continue;
            }
            let (state, stands_s) = self.standing_at(joint_m);
            let kind = if changes_gear {
                Kind::Cusp
            } else {
                Kind::SteerRate
            };
            if state.speed_mps > STANDS_MPS {
                let what = "the vehicle moves where it has to stand (m/s)";
                let violation = self.violation(kind, state, [state.speed_mps, 0.0], what);
                report.violations.push(violation);
            } else if let Some(needed_s) = turning_s.filter(|s| *s > stands_s + JOINT_TOLERANCE) {
                let what = "the vehicle stands too short for its wheels to turn (s)";
                let numbers = [stands_s, needed_s];
                let violation = self.violation(Kind::SteerRate, state, numbers, what);
                report.violations.push(violation);
            }
        }
    }

    /// The slowest state at a place, and the time that the vehicle stands there.
    fn standing_at(&self, s_m: f64) -> (TimedState, f64) {
        let is_here = |state: &TimedState| (state.s_m - s_m).abs() <= JOINT_TOLERANCE;
        let mut stands_s = 0.0;
        let mut slowest: Option<TimedState> = None;
        for phase in self.timed.phases() {
            let ends = [phase.after(0.0), phase.end()];
            if ends.iter().all(is_here) && phase.is_standing() {
                stands_s += phase.duration_s;
            }
            for end in ends.into_iter().filter(is_here) {
                if slowest.is_none_or(|slowest| end.speed_mps < slowest.speed_mps) {
                    slowest = Some(end);
                }
            }
        }
        // No phase ends there: the vehicle passes.
        let passing = self.timed.reached(s_m);
        let passing = TimedState {
            t_s: passing.time_s,
            s_m,
            speed_mps: passing.speed_mps,
            acceleration_mps2: passing.acceleration_mps2,
        };
        (slowest.unwrap_or(passing), stands_s)
    }

    /// Lateral acceleration and steering rate, on each part of a phase that lies on one segment.
    fn check_bends(&self, report: &mut TimedReport) {
        let path = self.timed.path();
        let mut begin_m = 0.0;
        for segment in path.segments().iter().filter(|s| s.length_m > 0.0) {
            let end_m = begin_m + segment.length_m;
            let phases = self.timed.phases();
            let first = phases.partition_point(|phase| phase.end().s_m <= begin_m);
            let on_it = phases[first..].iter();
            for phase in on_it.take_while(|phase| phase.s_m < end_m) {
                let piece = Piece {
                    phase,
                    segment,
                    begin_m,
                    from_s: time_at(phase, begin_m),
                    to_s: time_at(phase, end_m),
                };
                if piece.to_s > piece.from_s {
                    self.check_lateral(report, &piece, 0);
                    self.check_steering(report, &piece, 0);
                }
            }
            begin_m = end_m;
        }
    }

    fn check_lateral(&self, report: &mut TimedReport, piece: &Piece, depth: u32) {
        let limit = self.rules.limits.max_lateral_mps2;
        let at_ends = piece.ends().map(|(state, curvature)| {
            let amount = state.speed_mps * state.speed_mps * curvature.abs();
            (state, amount)
        });
        let what = (Kind::Lateral, "lateral acceleration (m/s^2)");
        let top_mps = piece.top_mps();
        let bound = top_mps * top_mps * piece.max_curvature();
        for (_, amount) in at_ends {
            report.max_lateral_mps2 = report.max_lateral_mps2.max(amount);
        }
        if self.settle(report, what, at_ends, [bound, limit]) || depth >= MAX_HALVINGS {
            return;
        }
        for half in piece.halves() {
            self.check_lateral(report, &half, depth + 1);
        }
    }

    fn check_steering(&self, report: &mut TimedReport, piece: &Piece, depth: u32) {
        let Some(wheelbase_m) = self.rules.vehicle.wheelbase_m() else {
            return;
        };
        let rate_per_m2 = piece.segment.curvature_rate_per_m2;
        let steer_rate = |speed_mps: f64, curvature_per_m: f64| {
            steer_rate_rad_per_s(wheelbase_m, speed_mps, curvature_per_m, rate_per_m2).abs()
        };
        let at_ends = piece.ends().map(|(state, curvature)| {
            let amount = steer_rate(state.speed_mps, curvature);
            (state, amount)
        });
        let largest = report.max_steer_rate_rad_per_s.get_or_insert(0.0);
        for (_, amount) in at_ends {
            *largest = largest.max(amount);
        }
        let Some(limit) = self.rules.limits.max_steer_rate_rad_per_s else {
            return;
        };
        let what = (Kind::SteerRate, "steering rate (rad/s)");
        let bound = steer_rate(piece.top_mps(), piece.min_curvature());
        if self.settle(report, what, at_ends, [bound, limit]) || depth >= MAX_HALVINGS {
            return;
        }
        for half in piece.halves() {
            self.check_steering(report, &half, depth + 1);
        }
    }

    /// True if a bound keeps the limit, or an end does not; such an end is reported.
    fn settle(
        &self,
        report: &mut TimedReport,
        (kind, what): (Kind, &str),
        at_ends: [(TimedState, f64); 2],
        [bound, limit]: [f64; 2],
    ) -> bool {
        let allowed = limit * (1.0 + LIMIT_TOLERANCE);
        if bound <= allowed {
            return true;
        }
        let worst = at_ends.into_iter().max_by(|a, b| a.1.total_cmp(&b.1));
        if let Some((state, amount)) = worst.filter(|(_, amount)| *amount > allowed) {
            let is_known = report
                .violations
                .iter()
                .any(|v| v.kind == kind && (v.s_m - state.s_m).abs() < 0.1);
            if !is_known {
                let violation = self.violation(kind, state, [amount, limit], what);
                report.violations.push(violation);
            }
            return true;
        }
        false
    }

    fn check_zones(&self, report: &mut TimedReport) {
        let Some(zones) = self.rules.zones else {
            return;
        };
        let top_mps = self.rules.limits.max_speed_mps;
        let end_m = self.timed.end().s_m;
        for at in self.timed.path().sample(ZONE_SPACING_M) {
            if at.s_m > end_m {
                return;
            }
            let timed = self.timed.reached(at.s_m);
            let limit = zones.limit_mps(at.pose.position(), top_mps);
            let state = TimedState {
                t_s: timed.time_s,
                s_m: at.s_m,
                speed_mps: timed.speed_mps,
                acceleration_mps2: timed.acceleration_mps2,
            };
            let is_last = report.violations.last();
            let follows = is_last
                .is_some_and(|v| v.kind == Kind::Speed && at.s_m - v.s_m <= 10.0 * ZONE_SPACING_M);
            if !follows {
                let what = (Kind::Speed, "speed in a zone (m/s)");
                self.hold(report, what, state, [timed.speed_mps, limit]);
            }
        }
    }
}

/// The time since a phase began at which it reaches a place, within its duration.
fn time_at(phase: &Phase, s_m: f64) -> f64 {
    let (mut low, mut high) = (0.0, phase.duration_s);
    if phase.s_m >= s_m {
        return 0.0;
    }
    if phase.end().s_m <= s_m {
        return high;
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if phase.after(middle).s_m < s_m {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

impl Piece<'_> {
    /// States and curvatures at both ends.
    fn ends(&self) -> [(TimedState, f64); 2] {
        [self.from_s, self.to_s].map(|elapsed_s| {
            let state = self.phase.after(elapsed_s);
            let driven_m = (state.s_m - self.begin_m).clamp(0.0, self.segment.length_m);
            (state, self.segment.curvature_at(driven_m))
        })
    }

    /// A bound of the speed: that at the ends, and by how much a parabola stands above its chord.
    fn top_mps(&self) -> f64 {
        let [(a, _), (b, _)] = self.ends();
        let duration_s = self.to_s - self.from_s;
        a.speed_mps.max(b.speed_mps) + 0.125 * self.phase.jerk_mps3.abs() * duration_s * duration_s
    }

    fn max_curvature(&self) -> f64 {
        let [(_, a), (_, b)] = self.ends();
        a.abs().max(b.abs())
    }

    fn min_curvature(&self) -> f64 {
        let [(_, a), (_, b)] = self.ends();
        if a * b <= 0.0 {
            0.0
        } else {
            a.abs().min(b.abs())
        }
    }

    fn halves(&self) -> [Self; 2] {
        let middle_s = 0.5 * (self.from_s + self.to_s);
        let (mut first, mut second) = (*self, *self);
        first.to_s = middle_s;
        second.from_s = middle_s;
        [first, second]
    }
}
