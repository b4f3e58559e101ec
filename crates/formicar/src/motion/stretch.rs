//! The lattice of a stretch: its units of length, its speeds, and the moves between them.
//!
//! In a time step d the speed changes by whole multiples of q, evenly. Then every place that is
//! reached is a multiple of `q d / 2` away from the beginning of the stretch: the lattice is closed.
//! With bounded jerk the acceleration changes evenly too, by multiples of `A = 2 q / d`, and places
//! are multiples of `q d / 3`. The quantum q of each stretch is chosen such that its end is on the
//! lattice.

use super::steps::{Step, Steps};
use crate::path::SpeedLimits;

/// Speed and acceleration in quanta.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Mode {
    pub(super) speed: i64,
    pub(super) acceleration: i64,
}

/// A time step from one mode to another.
#[derive(Clone, Copy, Debug)]
pub(super) struct Move {
    pub(super) from: usize,
    pub(super) to: usize,
    /// Units driven.
    pub(super) advance: usize,
    /// The larger of the two speeds, which bounds the speed of the whole step.
    pub(super) speed: usize,
}

/// A stretch between two stops.
#[derive(Clone, Debug)]
pub(super) struct Stretch {
    pub(super) begin_m: f64,
    pub(super) end_m: f64,
    pub(super) n_units: usize,
    pub(super) unit_m: f64,
    pub(super) speed_step_mps: f64,
    pub(super) acceleration_step_mps2: f64,
    /// The first is rest.
    pub(super) modes: Vec<Mode>,
    pub(super) moves: Vec<Move>,
    /// For each speed the ranges of units on which it is too fast.
    pub(super) too_fast: Vec<Vec<[usize; 2]>>,
    /// The time that the vehicle stands before it, seconds.
    pub(super) stands_s: f64,
}

/// How a stretch begins.
#[derive(Clone, Copy, Debug)]
pub(super) struct Begin {
    pub(super) s_m: f64,
    pub(super) speed_mps: f64,
    /// The units of the stretch, where they are known: those that fit a time step to a speed.
    pub(super) n_units: Option<usize>,
}

impl Begin {
    /// Standing at a place.
    pub(super) fn at_rest(s_m: f64) -> Self {
        Self {
            s_m,
            speed_mps: 0.0,
            n_units: None,
        }
    }
}

/// Time quanta of acceleration: so many changes of speed in a step at full acceleration.
const LEVELS: f64 = 3.0;
/// The same where the jerk is bounded, since acceleration has to build up.
const JERK_LEVELS: f64 = 4.0;
/// Room for the rounding of the quantum to the length of the stretch.
const SLACK: f64 = 1.03;
/// The least number of speeds.
const MIN_SPEEDS: f64 = 8.0;
/// The most changes of speed that one step offers to either side.
const MAX_CHANGE: f64 = 12.0;
/// So many quanta are tried for a speed.
const MAX_TRIES: usize = 1000;
/// Bounds that differ by less, relative to the larger, are one.
const SAME: f64 = 1e-9;

/// The quantum of speed for a stretch of a top speed.
fn speed_step_mps(top_mps: f64, limits: &SpeedLimits, time_step_s: f64) -> f64 {
    let least_mps2 = limits.max_acceleration_mps2.min(limits.braking_mps2());
    let per_step_mps = least_mps2 * time_step_s / SLACK;
    let most_mps = match limits.max_jerk_mps3 {
        None => per_step_mps / LEVELS,
        Some(jerk) => (per_step_mps / JERK_LEVELS).min(0.5 * jerk * time_step_s * time_step_s),
    };
    let n_speeds = (top_mps / most_mps).ceil().max(MIN_SPEEDS);
    // With jerk only even multiples are driven evenly.
    let n_speeds = match limits.max_jerk_mps3 {
        None => n_speeds,
        Some(_) => 2.0 * (0.5 * n_speeds).ceil(),
    };
    top_mps / n_speeds
}

/// A beginning that needs a shorter time step than this share of the one given is not fitted: so
/// short a stretch is driven without a choice.
const FINEST: f64 = 1.0 / 64.0;
/// The largest speed at the end of a time step over the mean speed within it, with a speed that is
/// a square of time.
const MOST_OVER_MEAN: f64 = 3.0;

/// The time step with which a beginning in motion is on the lattice, at most the one given, and the
/// beginning with the units that it fits.
pub(super) fn fitted(
    steps: &[Step],
    begin: Begin,
    limits: &SpeedLimits,
    time_step_s: f64,
) -> (f64, Begin) {
    if begin.speed_mps <= 0.0 {
        return (time_step_s, begin);
    }
    let top_mps = top_mps(steps).max(begin.speed_mps);
    let end_m = steps.last().map_or(begin.s_m, Step::end_m);
    let grain = Grain::of(limits);
    let quantum = speed_step_mps(top_mps, limits, time_step_s);
    let first = grain.speed_quanta(begin.speed_mps, quantum);
    // The shorter time step must still allow a change of the acceleration by one.
    let fits = (0..MAX_TRIES).map(|i| {
        let n_quanta = first + i * grain.even_speed;
        let quantum = begin.speed_mps / n_quanta as f64;
        let unit_m = quantum * time_step_s / grain.per_unit;
        let n_units = grain.units((end_m - begin.s_m) / unit_m, n_quanta);
        let fitting_s = (end_m - begin.s_m) * grain.per_unit / (quantum * n_units as f64);
        (quantum, n_units, fitting_s)
    });
    let is_smooth = |&(quantum, _, fitting_s): &(f64, usize, f64)| {
        let jerk = limits.max_jerk_mps3.unwrap_or(f64::INFINITY);
        quantum <= 0.5 * jerk * fitting_s * fitting_s
    };
    let is_long = |&(.., fitting_s): &(f64, usize, f64)| fitting_s >= FINEST * time_step_s;
    let mut fits = fits.filter(is_smooth).filter(is_long);
    let Some((_, n_units, fitting_s)) = fits.next() else {
        return (time_step_s, begin);
    };
    let begin = Begin {
        n_units: Some(n_units),
        ..begin
    };
    (fitting_s, begin)
}

fn top_mps(steps: &[Step]) -> f64 {
    steps
        .iter()
        .fold(0.0, |top: f64, step| top.max(step.cap_mps))
}

/// What the arithmetic of the lattice allows.
struct Grain {
    /// Units per quantum of speed and time step.
    per_unit: f64,
    /// Lengths from rest to rest are multiples of it.
    modulus: usize,
    /// Speeds without acceleration are multiples of it.
    even_speed: usize,
    least_units: usize,
}

impl Grain {
    fn of(limits: &SpeedLimits) -> Self {
        match limits.max_jerk_mps3 {
            // The units driven are the sum of v + v' over the steps: twice a sum, less the first.
            None => Self {
                per_unit: 2.0,
                modulus: 2,
                even_speed: 1,
                least_units: 2,
            },
            // They are the sum of 3 v + 2 a + a', where v and a are both odd or both even.
            Some(_) => Self {
                per_unit: 3.0,
                modulus: 6,
                even_speed: 2,
                least_units: 12,
            },
        }
    }

    fn speed_quanta(&self, speed_mps: f64, quantum: f64) -> usize {
        let even = self.even_speed as f64;
        (speed_mps / (even * quantum) * (1.0 - SAME))
            .ceil()
            .max(1.0) as usize
            * self.even_speed
    }

    /// The least number of units of at most a size that can be driven from a speed to rest.
    fn units(&self, at_least: f64, n_quanta: usize) -> usize {
        let remainder = if self.even_speed == 1 {
            n_quanta % 2
        } else {
            0
        };
        let least = (at_least * (1.0 - SAME))
            .ceil()
            .max(self.least_units as f64) as usize;
        let over = (least + self.modulus - remainder) % self.modulus;
        if over == 0 {
            least
        } else {
            least + self.modulus - over
        }
    }
}

impl Stretch {
    /// The lattice of the steps of a stretch.
    pub(super) fn new(
        steps: &[Step],
        begin: Begin,
        limits: &SpeedLimits,
        time_step_s: f64,
    ) -> Self {
        let grain = Grain::of(limits);
        let end_m = steps.last().map_or(begin.s_m, Step::end_m);
        let length_m = end_m - begin.s_m;
        let top_mps = top_mps(steps).max(begin.speed_mps);
        let n_units = begin.n_units.unwrap_or_else(|| {
            let quantum = speed_step_mps(top_mps, limits, time_step_s);
            grain.units(length_m * grain.per_unit / (quantum * time_step_s), 0)
        });
        let unit_m = length_m / n_units as f64;
        let speed_step_mps = grain.per_unit * unit_m / time_step_s;
        // In a time step the speed rises to no more than three times the mean: on a short stretch
        // the top speed is out of reach.
        let reachable = MOST_OVER_MEAN * n_units as f64 / grain.per_unit + 1.0;
        let n_speeds = (top_mps / speed_step_mps * (1.0 + SAME)).min(reachable);
        let n_speeds = n_speeds.floor().max(1.0) as i64;
        let (modes, moves) = match limits.max_jerk_mps3 {
            None => plain(n_speeds, limits, time_step_s / speed_step_mps),
            Some(jerk) => {
                let step_mps2 = 2.0 * speed_step_mps / time_step_s;
                smooth(n_speeds, limits, step_mps2, jerk * time_step_s / step_mps2)
            }
        };
        let mut stretch = Self {
            begin_m: begin.s_m,
            end_m,
            n_units,
            unit_m,
            speed_step_mps,
            acceleration_step_mps2: 2.0 * speed_step_mps / time_step_s,
            modes,
            moves,
            too_fast: Vec::new(),
            stands_s: steps.first().and_then(|s| s.stands_s).unwrap_or(0.0),
        };
        stretch.too_fast = (0..=n_speeds)
            .map(|speed| stretch.faster_than_bounds(steps, speed))
            .collect();
        stretch
    }

    /// The mode of a speed without acceleration.
    pub(super) fn steady(&self, speed_mps: f64) -> Option<usize> {
        let speed = (speed_mps / self.speed_step_mps).round() as i64;
        let wanted = Mode {
            speed,
            acceleration: 0,
        };
        self.modes.iter().position(|&mode| mode == wanted)
    }

    /// The place of a unit.
    pub(super) fn place_m(&self, unit: usize) -> f64 {
        if unit == self.n_units {
            self.end_m
        } else {
            self.begin_m + unit as f64 * self.unit_m
        }
    }

    /// The units, each from one place to the next, that a range of places reaches into.
    pub(super) fn units_of(&self, [from_m, to_m]: [f64; 2]) -> [usize; 2] {
        let unit = |s_m: f64| (s_m - self.begin_m) / self.unit_m;
        let low = (unit(from_m) + SAME_UNIT).floor().max(0.0) as usize;
        let high = (unit(to_m) - SAME_UNIT).ceil().max(0.0) as usize;
        [low.min(self.n_units), high.min(self.n_units)]
    }

    fn faster_than_bounds(&self, steps: &[Step], speed: i64) -> Vec<[usize; 2]> {
        let speed_mps = speed as f64 * self.speed_step_mps * (1.0 - SAME);
        let slow = steps.iter().filter(|step| step.cap_mps < speed_mps);
        let mut runs: Vec<[usize; 2]> = Vec::new();
        for [low, high] in slow.map(|step| self.units_of([step.begin_m, step.end_m()])) {
            match runs.last_mut() {
                Some(last) if low <= last[1] => last[1] = last[1].max(high),
                _ if low < high => runs.push([low, high]),
                _ => {}
            }
        }
        runs
    }
}

/// What is nearer to a border of two units is on it.
const SAME_UNIT: f64 = 1e-6;

/// Speeds alone; the moves that change them least come first.
fn plain(n_speeds: i64, limits: &SpeedLimits, per_mps2: f64) -> (Vec<Mode>, Vec<Move>) {
    let changes = |mps2: f64| (mps2 * per_mps2 + SAME).floor().clamp(1.0, MAX_CHANGE) as i64;
    let (up, down) = (
        changes(limits.max_acceleration_mps2),
        changes(limits.braking_mps2()),
    );
    let modes = (0..=n_speeds).map(|speed| Mode {
        speed,
        acceleration: 0,
    });
    let mut changes: Vec<i64> = (-down..=up).collect();
    changes.sort_by_key(|change| change.abs());
    let moves = changes.into_iter().flat_map(|change| {
        (0..=n_speeds)
            .filter(move |speed| (0..=n_speeds).contains(&(speed + change)))
            .map(move |speed| Move {
                from: speed as usize,
                to: (speed + change) as usize,
                advance: (2 * speed + change) as usize,
                speed: speed.max(speed + change) as usize,
            })
    });
    (modes.collect(), moves.collect())
}

/// Speeds and accelerations; within a step the acceleration keeps its sign, so that the speed has
/// its extremes at the ends.
fn smooth(
    n_speeds: i64,
    limits: &SpeedLimits,
    step_mps2: f64,
    changes: f64,
) -> (Vec<Mode>, Vec<Move>) {
    let levels = |mps2: f64| (mps2 / step_mps2 + SAME).floor().clamp(1.0, MAX_CHANGE) as i64;
    let accelerations = -levels(limits.braking_mps2())..=levels(limits.max_acceleration_mps2);
    let most = (changes + SAME).floor().clamp(1.0, MAX_CHANGE) as i64;
    let mut modes = vec![Mode {
        speed: 0,
        acceleration: 0,
    }];
    for speed in 1..=n_speeds {
        let same_parity = accelerations.clone().filter(|a| (a + speed) % 2 == 0);
        modes.extend(same_parity.map(|acceleration| Mode {
            speed,
            acceleration,
        }));
    }
    let mut moves = Vec::new();
    let mut changes: Vec<i64> = (-most..=most).collect();
    changes.sort_by_key(|change| change.abs());
    for change in changes {
        for (from, mode) in modes.iter().enumerate() {
            let (a, b) = (mode.acceleration, mode.acceleration + change);
            let next = Mode {
                speed: mode.speed + a + b,
                acceleration: b,
            };
            let to = modes.iter().position(|&mode| mode == next);
            let advance = 3 * mode.speed + 2 * a + b;
            if let (Some(to), true) = (to, a * b >= 0 && advance >= 0) {
                moves.push(Move {
                    from,
                    to,
                    advance: advance as usize,
                    speed: mode.speed.max(next.speed) as usize,
                });
            }
        }
    }
    (modes, moves)
}

/// The steps of each stretch between stops, the part of the first from a place on.
pub(super) fn between_stops(steps: &Steps, from_m: f64) -> Vec<Vec<Step>> {
    let mut stretches: Vec<Vec<Step>> = Vec::new();
    let ahead = steps.as_slice().iter().filter(|step| step.end_m() > from_m);
    for &step in ahead.filter(|step| step.length_m > 0.0) {
        match stretches.last_mut() {
            Some(last) if step.stands_s.is_none() => last.push(step),
            _ => stretches.push(vec![step]),
        }
    }
    stretches
}
