//! The fastest drive that keeps its distance.

use super::config::{MotionConfig, MotionProblem};
use super::error::MotionError;
use super::forbidden::Forbidden;
use super::lattice::{Lattice, REST, Reached, State};
use super::outcome::{MotionPlan, MotionStatus, ProfileSource};
use super::steps::Steps;
use super::stretch::Begin;
use super::swept_path::SweptPath;
use super::{bits, forbidden};
use crate::path::{Phase, Spacing, TimedPath, TimedState};

/// Plans the speed along a path.
///
/// The drive begins with the present speed and ends standing, at the end of the path or, where a
/// prediction stays in the way up to the horizon, before it. All the time it keeps the wished
/// distance from every prediction, also while it waits at its end.
///
/// What is proven: where the fastest drive of [`fastest`](super::fastest()) meets no forbidden
/// region, it is the answer. Otherwise, on the lattice of the time step (speeds in equal steps,
/// evenly accelerated), every profile that keeps out of the forbidden regions is looked at, so that
/// the profile found is the fastest of them up to the last moment at which regions change; from the
/// earliest moment at which the fastest drive is free, that is taken. Regions are closed
/// conservatively: by up to a time step and 5 cm earlier and longer than exact ones.
///
/// The cost is proportional to horizon, speeds and length, each in steps of the lattice; places are
/// bits, 64 of which move at once.
///
/// # Errors
/// Parameters out of range, a present speed that is too fast to begin the path with, or an obstacle
/// that comes too near whatever the vehicle does.
///
/// ```
/// use formicar::motion::{MotionConfig, MotionProblem, plan_motion};
/// use formicar::path::Direction;
/// use formicar::scenario::{MovingObstacle, ObstacleMotion, ObstacleShape, Predictions};
/// use formicar::{CurvePath, Pose2, Vehicle};
///
/// let mut path = CurvePath::new(Pose2::default());
/// path.push(0.0, 10.0, Direction::Forward);
/// let walker = MovingObstacle {
///     name: None,
///     shape: ObstacleShape::Disc { radius_m: 0.3 },
///     motion: ObstacleMotion::Velocity { pose: [6.0, -6.0, 0.0], velocity_mps: [0.0, 1.0] },
///     growth_mps: 0.0,
/// };
/// let predictions = Predictions::new(vec![walker], 20.0)?;
/// let vehicle = Vehicle::warehouse_amr();
/// let problem = MotionProblem { path: &path, vehicle: &vehicle, predictions: &predictions, zones: None };
/// let plan = plan_motion(&problem, &MotionConfig::default())?;
/// assert!(plan.timed.arrives() && plan.lost_s() > 0.5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn plan_motion(
    problem: &MotionProblem,
    config: &MotionConfig,
) -> Result<MotionPlan, MotionError> {
    config.check()?;
    let limits = &config.limits;
    let spacing = Spacing::from(SPACING_M);
    let steps = Steps::new(
        problem.path,
        problem.vehicle,
        limits,
        problem.zones,
        &spacing,
    );
    let start = TimedState {
        speed_mps: config.present_speed_mps,
        ..TimedState::default()
    };
    let unhindered =
        steps
            .fastest(start, steps.length_m())
            .ok_or_else(|| MotionError::TooFast {
                speed_mps: config.present_speed_mps,
                limit_mps: steps.fastest_begin_mps(),
            })?;
    let unhindered = TimedPath::new(problem.path.clone(), unhindered);
    let run = Run {
        problem,
        config,
        swept: SweptPath::new(problem.path, problem.vehicle),
        steps,
        unhindered_s: unhindered.duration_s(),
    };
    run.plan(unhindered)
}

/// Most that two bounds of the speed lie apart.
const SPACING_M: f64 = 0.1;
/// Most words of all layers: 128 MB.
const MAX_WORDS: usize = 1 << 24;
/// By how much the time step grows while the layers do not fit.
const COARSER: f64 = 1.5;
/// Speeds below this share of the top speed are braked to a stand before anything else.
const CRAWL: f64 = 0.02;

struct Run<'a> {
    problem: &'a MotionProblem<'a>,
    config: &'a MotionConfig,
    steps: Steps,
    swept: SweptPath,
    unhindered_s: f64,
}

/// The beginning of the lattice: what is driven before it, and where it begins.
struct Lead {
    phases: Vec<Phase>,
    begin: Begin,
    layer: usize,
}

impl Run<'_> {
    fn plan(&self, unhindered: TimedPath) -> Result<MotionPlan, MotionError> {
        if self.is_alone() {
            return Ok(self.undisturbed(unhindered));
        }
        let (time_step_s, begin) = self.fitted()?;
        let distance_m = self.config.distance_m;
        let forbidden = Forbidden::new(
            &self.swept,
            self.problem.predictions,
            distance_m,
            time_step_s,
        );
        let is_smooth = self.config.limits.max_jerk_mps3.is_some();
        if !is_smooth && forbidden.is_free(&unhindered) {
            return Ok(self.found(unhindered, ProfileSource::Fastest, forbidden));
        }
        let lead = Lead {
            begin,
            ..self.lead(time_step_s)
        };
        let lattice = Lattice::new(
            &self.steps,
            &self.config.limits,
            time_step_s,
            (lead.begin, lead.layer),
        );
        let lattice = lattice.and_then(|lattice| lattice.starting_at(lead.begin.speed_mps));
        let Some(lattice) = lattice else {
            // There is no way to drive: the vehicle stands where it is.
            return if forbidden.is_free(&unhindered) {
                Ok(self.found(unhindered, ProfileSource::Fastest, forbidden))
            } else {
                Err(self.unavoidable(&forbidden, 0))
            };
        };
        let slabs = 0..lead.layer;
        let lead_to_m = lead.begin.s_m;
        if !slabs
            .into_iter()
            .all(|i| forbidden.is_open(i, [0.0, lead_to_m]))
        {
            return Err(self.unavoidable(&forbidden, 0));
        }
        let mut reached = Reached::new(&lattice, &forbidden);
        // One step more: what is left then is outside of what stays closed.
        while reached.last() <= forbidden.settled().max(lead.layer) {
            reached.advance();
            if !reached.is_alive() {
                return Err(self.unavoidable(&forbidden, reached.last() - 1));
            }
        }
        let phases = if is_smooth {
            self.smooth_end(&lattice, &forbidden, &mut reached)
        } else {
            self.fastest_end(&lattice, &forbidden, &reached)
        };
        let phases = phases.ok_or_else(|| self.unavoidable(&forbidden, reached.last()))?;
        let phases = lead.phases.into_iter().chain(phases).collect();
        let timed = TimedPath::new(self.problem.path.clone(), phases);
        Ok(self.found(timed, ProfileSource::Lattice, forbidden))
    }

    /// True where no lattice is needed: nothing moves, and the jerk is not bounded.
    fn is_alone(&self) -> bool {
        let is_smooth = self.config.limits.max_jerk_mps3.is_some();
        !is_smooth && self.problem.predictions.obstacles().is_empty()
    }

    fn undisturbed(&self, timed: TimedPath) -> MotionPlan {
        MotionPlan {
            timed,
            status: MotionStatus::Arrives,
            source: ProfileSource::Fastest,
            unhindered_s: self.unhindered_s,
            regions: Vec::new(),
            time_step_s: self.config.time_step_s,
        }
    }

    /// The time step at which all layers fit into memory, and the beginning on its lattice.
    fn fitted(&self) -> Result<(f64, Begin), MotionError> {
        let (limits, speed_mps) = (&self.config.limits, self.config.present_speed_mps);
        let crawl_mps = CRAWL * limits.max_speed_mps;
        if limits.max_jerk_mps3.is_some() && speed_mps > 0.0 && speed_mps < crawl_mps {
            return Err(MotionError::TooSlow {
                speed_mps,
                limit_mps: crawl_mps,
            });
        }
        let mut wished_s = self.config.time_step_s;
        loop {
            let begin = self.lead(wished_s).begin;
            let (time_step_s, begin) = Lattice::fitted(&self.steps, limits, begin, wished_s);
            let lattice = Lattice::new(&self.steps, limits, time_step_s, (begin, 0));
            let n_layers = self.problem.predictions.horizon_s() / time_step_s + 2.0;
            let n_words = lattice.map_or(0, |lattice| lattice.n_words());
            if n_words as f64 * n_layers <= MAX_WORDS as f64 {
                return Ok((time_step_s, begin));
            }
            wished_s *= COARSER;
        }
    }

    /// A vehicle that hardly moves stops first: its speed is no quantum.
    fn lead(&self, time_step_s: f64) -> Lead {
        let limits = &self.config.limits;
        let speed_mps = self.config.present_speed_mps;
        let crawls = speed_mps > 0.0 && speed_mps < CRAWL * limits.max_speed_mps;
        if !crawls || limits.max_jerk_mps3.is_some() {
            return Lead {
                phases: Vec::new(),
                begin: Begin {
                    speed_mps,
                    ..Begin::at_rest(0.0)
                },
                layer: 0,
            };
        }
        let braking = Phase {
            speed_mps,
            acceleration_mps2: -limits.braking_mps2(),
            duration_s: speed_mps / limits.braking_mps2(),
            ..Phase::default()
        };
        let (stop, layer) = (braking.end(), (braking.duration_s / time_step_s).ceil());
        let standing = Phase {
            t_s: stop.t_s,
            s_m: stop.s_m,
            duration_s: layer * time_step_s - stop.t_s,
            ..Phase::default()
        };
        Lead {
            phases: vec![braking, standing],
            begin: Begin::at_rest(stop.s_m),
            layer: layer as usize,
        }
    }

    /// Once nothing changes any more, the fastest drive on from the best state.
    fn fastest_end(
        &self,
        lattice: &Lattice,
        forbidden: &Forbidden,
        reached: &Reached,
    ) -> Option<Vec<Phase>> {
        let last = reached.last();
        let way = if reached.contains(lattice.end(last)) {
            reached.way_to(arrival(lattice, forbidden, reached))
        } else {
            let (state, _) = self.best_to_go_on(lattice, forbidden, reached)?;
            reached.way_to(state)
        };
        // The earliest state from which the fastest drive is free is the best to leave the lattice.
        let leaving = way.iter().enumerate().find_map(|(i, &state)| {
            let tail = self.tail(lattice, forbidden, state)?;
            let timed = TimedPath::new(self.problem.path.clone(), tail);
            let is_free = forbidden.is_free_from(&timed, lattice.timed(state).t_s);
            is_free.then(|| (i, timed.phases().to_vec()))
        });
        let (i, tail) = leaving.unwrap_or_else(|| (way.len() - 1, Vec::new()));
        let mut phases = lattice.phases(&way[..=i]);
        phases.extend(tail);
        Some(phases)
    }

    /// The state of the last layer from which a drive ends best: at the end of the path, then as far
    /// as possible, then early.
    ///
    /// Of states of one speed v the foremost is never later: from its place on it is the slower one
    /// at every place, if at all, until both have the same speed w somewhere; it has got there by
    /// accelerating all the time, in (w - v) / a, and nothing gets from v to w sooner.
    fn best_to_go_on(
        &self,
        lattice: &Lattice,
        forbidden: &Forbidden,
        reached: &Reached,
    ) -> Option<(State, TimedState)> {
        let modes = lattice.stretches.iter().enumerate();
        let modes = modes.flat_map(|(i, stretch)| (0..stretch.modes.len()).map(move |m| (i, m)));
        let foremost = modes.filter_map(|mode| self.foremost(lattice, forbidden, reached, mode));
        foremost.reduce(|best, other| {
            let (old, new) = (best.1, other.1);
            let same = (new.s_m - old.s_m).abs() <= forbidden::SAME_PLACE_M;
            let is_better = if same {
                new.t_s < old.t_s
            } else {
                new.s_m > old.s_m
            };
            if is_better { other } else { best }
        })
    }

    /// The foremost state of a mode in the last layer from which a drive can end, and its end.
    fn foremost(
        &self,
        lattice: &Lattice,
        forbidden: &Forbidden,
        reached: &Reached,
        (stretch, mode): (usize, usize),
    ) -> Option<(State, TimedState)> {
        let layer = reached.last();
        let places = reached.places(layer, stretch, mode);
        let mut at_most = Some(lattice.stretches[stretch].n_units);
        let states = std::iter::from_fn(|| {
            let unit = bits::highest(places, at_most?)?;
            at_most = unit.checked_sub(1);
            Some(State {
                layer,
                stretch,
                mode,
                unit,
            })
        });
        let mut ends = states.filter_map(|state| {
            let end = self.tail(lattice, forbidden, state)?.last()?.end();
            Some((state, end))
        });
        ends.next()
    }

    /// The fastest drive from a state as far as the way stays open.
    fn tail(&self, lattice: &Lattice, forbidden: &Forbidden, state: State) -> Option<Vec<Phase>> {
        let from = lattice.timed(state);
        let stretch = &lattice.stretches[state.stretch];
        let to_m = forbidden.closed_for_good_m(from.s_m);
        let to_m = to_m.map_or(self.steps.length_m(), |to_m| {
            to_m.min(self.steps.length_m())
        });
        let is_last = state.stretch + 1 == lattice.stretches.len();
        let must_turn = state.unit == stretch.n_units && !is_last;
        if must_turn && to_m > from.s_m + forbidden::SAME_PLACE_M {
            // The wheels have yet to turn here; a later state has done so.
            return None;
        }
        let is_inside = !forbidden.is_open(usize::MAX, [from.s_m, from.s_m]);
        let ahead_m = (to_m - from.s_m).max(0.0) + forbidden::SAME_PLACE_M;
        let braking_m = 0.5 * from.speed_mps.powi(2) / self.config.limits.braking_mps2();
        if is_inside || braking_m > ahead_m {
            return None;
        }
        self.steps.fastest(from, to_m.max(from.s_m))
    }

    /// With bounded jerk the lattice goes on to the end.
    fn smooth_end(
        &self,
        lattice: &Lattice,
        forbidden: &Forbidden,
        reached: &mut Reached,
    ) -> Option<Vec<Phase>> {
        let limits = &self.config.limits;
        let jerk_mps3 = limits.max_jerk_mps3.unwrap_or(f64::INFINITY);
        let build_up_s = (limits.max_acceleration_mps2 + limits.braking_mps2()) / jerk_mps3;
        let n_stretches = lattice.stretches.len() as f64;
        let more_s = 2.0 * self.unhindered_s + 10.0 * n_stretches * (1.0 + build_up_s);
        let n_words = lattice.n_words().max(1);
        let most = reached.last() + (more_s / lattice.time_step_s).ceil() as usize;
        let most = most.min(reached.last().max(2 * MAX_WORDS / n_words));
        let closed_m = forbidden.closed_for_good_m(0.0);
        while reached.last() < most && !reached.contains(lattice.end(reached.last())) {
            if closed_m.is_some_and(|_| has_stopped(lattice, forbidden, reached)) {
                break;
            }
            reached.advance();
        }
        let last = reached.last();
        let state = if reached.contains(lattice.end(last)) {
            arrival(lattice, forbidden, reached)
        } else {
            foremost_rest(lattice, reached, last)?
        };
        let mut phases = lattice.phases(&reached.way_to(state));
        let end = lattice.timed(state);
        phases.push(Phase {
            t_s: end.t_s,
            s_m: end.s_m,
            ..Phase::default()
        });
        Some(phases)
    }

    fn found(&self, timed: TimedPath, source: ProfileSource, forbidden: Forbidden) -> MotionPlan {
        let status = if timed.arrives() {
            MotionStatus::Arrives
        } else {
            MotionStatus::Waits
        };
        MotionPlan {
            timed,
            status,
            source,
            unhindered_s: self.unhindered_s,
            time_step_s: forbidden.time_step_s,
            regions: forbidden.regions,
        }
    }

    /// The obstacle that leaves no way out of a slab: the first one that closes something then.
    fn unavoidable(&self, forbidden: &Forbidden, slab: usize) -> MotionError {
        let time_step_s = forbidden.time_step_s;
        let begin_s = slab as f64 * time_step_s;
        let then = forbidden.regions.iter();
        let mut then = then.filter(|r| r.from_s <= begin_s + 0.5 * time_step_s && r.to_s > begin_s);
        let obstacles = self.problem.predictions.obstacles();
        let obstacle = then
            .next()
            .and_then(|region| obstacles.get(region.obstacle));
        MotionError::Unavoidable {
            obstacle: obstacle.map_or_else(String::new, |o| o.name().to_owned()),
            distance_m: self.config.distance_m,
            t_s: begin_s + time_step_s,
        }
    }
}

/// The earliest state at the end of the path from which the vehicle stands there up to the last
/// layer.
fn arrival(lattice: &Lattice, forbidden: &Forbidden, reached: &Reached) -> State {
    let mut layer = reached.last();
    let end_m = lattice.timed(lattice.end(0)).s_m;
    while layer > 0
        && reached.contains(lattice.end(layer - 1))
        && forbidden.is_open(layer - 1, [end_m, end_m])
    {
        layer -= 1;
    }
    lattice.end(layer)
}

/// The foremost state at rest in a layer.
fn foremost_rest(lattice: &Lattice, reached: &Reached, layer: usize) -> Option<State> {
    (0..lattice.stretches.len()).rev().find_map(|stretch| {
        let places = reached.places(layer, stretch, REST);
        let unit = bits::highest(places, lattice.stretches[stretch].n_units)?;
        Some(State {
            layer,
            stretch,
            mode: REST,
            unit,
        })
    })
}

/// True if the vehicle can stand as near to what stays closed as the lattice allows.
fn has_stopped(lattice: &Lattice, forbidden: &Forbidden, reached: &Reached) -> bool {
    let state = foremost_rest(lattice, reached, reached.last());
    state.is_some_and(|state| {
        let s_m = lattice.timed(state).s_m;
        let stretch = &lattice.stretches[state.stretch];
        let closed_m = forbidden.closed_for_good_m(s_m);
        // Rest is on every sixth unit.
        closed_m.is_some_and(|closed_m| closed_m - s_m < 6.0 * stretch.unit_m)
    })
}
