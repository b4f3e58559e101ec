//! A path cut into short steps, each with a bound of the speed, and the fastest drive over them.

use crate::path::{CurvePath, CurveSegment, Phase, Spacing, SpeedLimits, TimedState};
use crate::scenario::SpeedZones;
use crate::vehicle::Vehicle;

/// A stretch between two samples.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    /// Arc length where it begins, as [`CurvePath::sample`] has it.
    pub(super) begin_m: f64,
    pub(super) length_m: f64,
    /// Bound of the speed on it.
    pub(super) cap_mps: f64,
    /// The time that the vehicle stands before it, if it does.
    pub(super) stands_s: Option<f64>,
}

impl Step {
    pub(super) fn end_m(&self) -> f64 {
        self.begin_m + self.length_m
    }
}

/// A path in steps.
#[derive(Clone, Debug)]
pub(super) struct Steps {
    all: Vec<Step>,
    length_m: f64,
    acceleration_mps2: f64,
    braking_mps2: f64,
}

/// Speeds that differ by less, relative to the larger, are one.
const SAME_SPEED: f64 = 1e-9;
/// Phases that are shorter are left out, seconds.
const LEAST_PHASE_S: f64 = 1e-12;
/// Rests of a step that are shorter are none, meters.
const LEAST_STEP_M: f64 = 1e-9;

impl Steps {
    pub(super) fn new(
        path: &CurvePath,
        vehicle: &Vehicle,
        limits: &SpeedLimits,
        zones: Option<&SpeedZones>,
        spacing: &Spacing,
    ) -> Self {
        let wheels = Wheels::new(vehicle, limits);
        let mut steps = Vec::new();
        let mut before: Option<&CurveSegment> = None;
        let mut begin_m = 0.0;
        // The joint as the sample before it has it, to the last bit.
        let mut joint_m = 0.0;
        for segment in path.segments() {
            let n_steps = segment.n_steps(spacing);
            let place_m = |i: usize| begin_m + segment.length_m * i as f64 / n_steps as f64;
            for i in 0..n_steps {
                let cap_mps = wheels.cap_mps(segment, [i, i + 1], n_steps, limits);
                let zone_mps = zones.map(|zones| {
                    let ends = [i, i + 1].map(|i| segment.length_m * i as f64 / n_steps as f64);
                    zones.limit_between_mps(segment, ends, limits.max_speed_mps)
                });
                steps.push(Step {
                    begin_m: if i == 0 { joint_m } else { place_m(i) },
                    length_m: segment.length_m / n_steps as f64,
                    cap_mps: zone_mps.map_or(cap_mps, |zone_mps| cap_mps.min(zone_mps)),
                    stands_s: (i == 0)
                        .then(|| wheels.standing_s(before, segment))
                        .flatten(),
                });
            }
            joint_m = place_m(n_steps);
            begin_m += segment.length_m;
            before = Some(segment);
        }
        Self {
            all: steps,
            length_m: joint_m,
            acceleration_mps2: limits.max_acceleration_mps2,
            braking_mps2: limits.braking_mps2(),
        }
    }

    pub(super) fn as_slice(&self) -> &[Step] {
        &self.all
    }

    pub(super) fn length_m(&self) -> f64 {
        self.length_m
    }

    /// The fastest speed with which the path can begin.
    pub(super) fn fastest_begin_mps(&self) -> f64 {
        let mut square = 0.0_f64;
        for step in self.all.iter().rev() {
            let stops = square + 2.0 * self.braking_mps2 * step.length_m;
            square = stops.min(step.cap_mps * step.cap_mps);
            if step.stands_s.is_some() && step.begin_m > 0.0 {
                square = 0.0;
            }
        }
        square.sqrt()
    }

    /// The fastest drive from a state to a stand at a place; none where the vehicle drives faster
    /// than the bounds allow, or cannot stop in time. Wheels that have to turn before the first step
    /// have turned already.
    pub(super) fn fastest(&self, from: TimedState, to_m: f64) -> Option<Vec<Phase>> {
        let steps = self.between(from.s_m, to_m);
        let speeds = self.speeds(&steps, from.speed_mps)?;
        let mut time_s = from.t_s;
        let mut phases = Vec::new();
        for (step, pair) in steps.iter().zip(speeds.windows(2)) {
            if let Some(stands_s) = step.stands_s.filter(|&stands_s| stands_s > 0.0) {
                phases.push(Phase {
                    t_s: time_s,
                    s_m: step.begin_m,
                    duration_s: stands_s,
                    ..Phase::default()
                });
                time_s += stands_s;
            }
            let pieces = self.pieces(step, [pair[0], pair[1]]);
            self.push(&mut phases, step, time_s, &pieces);
            time_s += pieces.duration_s;
        }
        phases.push(Phase {
            t_s: time_s,
            s_m: steps.last().map_or(from.s_m, |_| to_m),
            ..Phase::default()
        });
        Some(phases)
    }

    /// The steps between two places; the first and the last may be parts.
    fn between(&self, from_m: f64, to_m: f64) -> Vec<Step> {
        let is_whole = from_m <= 0.0 && to_m >= self.length_m;
        let inside = |step: &&Step| {
            is_whole || (step.end_m() > from_m + LEAST_STEP_M && step.begin_m < to_m - LEAST_STEP_M)
        };
        let mut steps: Vec<_> = self.all.iter().filter(inside).copied().collect();
        if is_whole {
            return steps;
        }
        if let Some(first) = steps.first_mut() {
            let end_m = first.end_m();
            first.begin_m = first.begin_m.max(from_m);
            first.length_m = end_m - first.begin_m;
            first.stands_s = None;
        }
        if let Some(last) = steps.last_mut() {
            last.length_m = last.end_m().min(to_m) - last.begin_m;
        }
        steps
    }

    /// Speeds at the ends of the steps: forward from a speed, and back from standing.
    fn speeds(&self, steps: &[Step], first_mps: f64) -> Option<Vec<f64>> {
        let n = steps.len();
        if n == 0 {
            return (first_mps <= SAME_SPEED).then(|| vec![0.0]);
        }
        let mut squares = vec![0.0; n + 1];
        squares[0] = first_mps * first_mps;
        for i in 1..n {
            let cap = match steps[i].stands_s {
                Some(_) => 0.0,
                None => steps[i - 1].cap_mps.min(steps[i].cap_mps),
            };
            let reached = squares[i - 1] + 2.0 * self.acceleration_mps2 * steps[i - 1].length_m;
            squares[i] = reached.min(cap * cap);
        }
        for i in (0..n).rev() {
            let stops = squares[i + 1] + 2.0 * self.braking_mps2 * steps[i].length_m;
            squares[i] = squares[i].min(stops);
        }
        let is_fast = |bound_mps: f64| first_mps > bound_mps * (1.0 + SAME_SPEED) + SAME_SPEED;
        if is_fast(squares[0].sqrt()) || is_fast(steps[0].cap_mps) {
            return None;
        }
        Some(squares.into_iter().map(f64::sqrt).collect())
    }

    /// Accelerate, drive at the bound where there is room, brake.
    fn pieces(&self, step: &Step, [first, last]: [f64; 2]) -> Pieces {
        let peak = self.peak_mps(step.length_m, [first, last]);
        let top = peak.min(step.cap_mps).max(first).max(last);
        let (changing_s, changing_m) = self.changing(top, [first, last]);
        let left_m = (step.length_m - changing_m).max(0.0);
        Pieces {
            first,
            last,
            top,
            left_m,
            duration_s: changing_s + if left_m > 0.0 { left_m / top } else { 0.0 },
        }
    }

    /// The speed at which braking has to begin where nothing else bounds it. Where acceleration and
    /// braking are one, the numbers keep the bits of the simpler formula.
    fn peak_mps(&self, length_m: f64, [first, last]: [f64; 2]) -> f64 {
        let (a, b) = (self.acceleration_mps2, self.braking_mps2);
        if a == b {
            return (0.5 * (first * first + last * last) + a * length_m).sqrt();
        }
        let weighted = b * first * first + a * last * last + 2.0 * a * b * length_m;
        (weighted / (a + b)).sqrt()
    }

    /// Time and length of speeding up to a top speed and of braking from it.
    fn changing(&self, top: f64, [first, last]: [f64; 2]) -> (f64, f64) {
        let (a, b) = (self.acceleration_mps2, self.braking_mps2);
        if a == b {
            let squares = 2.0 * top * top - first * first - last * last;
            return ((2.0 * top - first - last) / a, squares / (2.0 * a));
        }
        let (up, down) = (top * top - first * first, top * top - last * last);
        let changing_s = (top - first) / a + (top - last) / b;
        (changing_s, 0.5 * (up / a + down / b))
    }

    /// Adds the phases of a step that begins at a time; pieces without duration are left out.
    fn push(&self, phases: &mut Vec<Phase>, step: &Step, begin_s: f64, pieces: &Pieces) {
        let Pieces {
            first, last, top, ..
        } = *pieces;
        let (a, b) = (self.acceleration_mps2, self.braking_mps2);
        let rolls_s = if pieces.left_m > 0.0 {
            pieces.left_m / top
        } else {
            0.0
        };
        let (mut t_s, mut s_m) = (begin_s, step.begin_m);
        let n_before = phases.len();
        for (speed_mps, acceleration_mps2, duration_s) in [
            (first, a, (top - first) / a),
            (top, 0.0, rolls_s),
            (top, -b, (top - last) / b),
        ] {
            // The first begins exactly where and as fast as the step does; what rounding leaves of
            // the others is no phase.
            let is_first = phases.len() == n_before;
            if duration_s > LEAST_PHASE_S && (is_first || s_m < step.end_m()) {
                let phase = Phase {
                    t_s,
                    s_m,
                    speed_mps: if is_first { first } else { speed_mps },
                    acceleration_mps2,
                    jerk_mps3: 0.0,
                    duration_s,
                };
                phases.push(phase);
                (t_s, s_m) = (t_s + duration_s, phase.end().s_m);
            }
        }
    }
}

/// How a step is driven.
struct Pieces {
    first: f64,
    last: f64,
    top: f64,
    /// Length driven at the top speed.
    left_m: f64,
    duration_s: f64,
}

/// The steered wheels.
struct Wheels {
    wheelbase_m: f64,
    rate_rad_per_s: Option<f64>,
}

impl Wheels {
    /// The wheels turn about the vehicle's own axles; where its wheelbase is unknown they do not
    /// bound the speed.
    fn new(vehicle: &Vehicle, limits: &SpeedLimits) -> Self {
        let rate_rad_per_s = limits.max_steer_rate_rad_per_s;
        Self {
            wheelbase_m: vehicle.wheelbase_m().unwrap_or(0.0),
            rate_rad_per_s: rate_rad_per_s.filter(|_| vehicle.wheelbase_m().is_some()),
        }
    }

    /// The bound of the speed on one of the equal steps of a segment.
    fn cap_mps(
        &self,
        segment: &CurveSegment,
        ends: [usize; 2],
        n_steps: usize,
        limits: &SpeedLimits,
    ) -> f64 {
        let length_m = segment.length_m / n_steps as f64;
        let curvatures = ends.map(|i| segment.curvature_at(i as f64 * length_m));
        let steepest = curvatures[0].abs().max(curvatures[1].abs());
        let lateral = (limits.max_lateral_mps2 / steepest).sqrt();
        let steering = self.steering_cap_mps(curvatures, segment.curvature_rate_per_m2);
        limits.max_speed_mps.min(lateral).min(steering)
    }

    /// The speed at which the wheels just keep up with a change of curvature.
    fn steering_cap_mps(&self, curvatures: [f64; 2], rate_per_m2: f64) -> f64 {
        let Some(rate) = self.rate_rad_per_s else {
            return f64::INFINITY;
        };
        // The wheels turn fastest where they point ahead most.
        let [a, b] = curvatures;
        let least = if a * b <= 0.0 {
            0.0
        } else {
            a.abs().min(b.abs())
        };
        let steer = self.wheelbase_m * least;
        rate * (1.0 + steer * steer) / (self.wheelbase_m * rate_per_m2.abs())
    }

    /// The time that the vehicle stands before a segment; none where it drives on. The wheels are
    /// straight at first or turned already: what they did before the path is not known.
    fn standing_s(&self, before: Option<&CurveSegment>, next: &CurveSegment) -> Option<f64> {
        const SAME_CURVATURE_PER_M: f64 = 1e-9;
        let Some(before) = before else {
            return Some(0.0);
        };
        let (from, to) = (before.end_curvature_per_m(), next.curvature_per_m);
        let jumps = self.rate_rad_per_s.is_some() && (to - from).abs() > SAME_CURVATURE_PER_M;
        (jumps || before.direction != next.direction).then(|| self.turning_s(from, to))
    }

    /// The time in which the wheels of a standing vehicle turn from one curvature to another.
    fn turning_s(&self, from: f64, to: f64) -> f64 {
        let steer = |curvature: f64| (self.wheelbase_m * curvature).atan();
        let turn = (steer(to) - steer(from)).abs();
        self.rate_rad_per_s.map_or(0.0, |rate| turn / rate)
    }
}
