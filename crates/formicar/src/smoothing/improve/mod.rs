//! Improvement of driven paths: a free chain of arcs becomes a cheaper one from the same start to
//! the same end or, where that has a tolerance, to a better one.
//!
//! Local search with four operators: connect two places of the path by another curve, move a place
//! and connect it anew on both sides, replace a change of gear with its surroundings, move the end. Curves are
//! Dubins and Reeds-Shepp words, arcs of two different radii along a common tangent, and rounded
//! corners. Lower bounds reject most curves after a few operations; the cost of the others is
//! integrated along their path, and those that still gain are checked exactly.

mod chain;
mod config;
mod joins;
mod operators;
mod task;
mod window;

pub use config::ImproveConfig;

use crate::collision::{Body, ObstacleMap};
use crate::geometry::{Arc, Pose2, angle_difference};
use crate::numeric::{RandomStream, Seed};
use crate::objective::{DriveMeter, SoftCost, VehicleCost};
use crate::progress::{Limits, Status};
use crate::scenario::GoalRegion;
use crate::vehicle::Gears;
use chain::Chain;
use operators::Attempt;
use task::ImproveTask;

/// The map, the vehicle and the cost that a path is improved for; grid coordinates.
#[derive(Clone, Copy)]
pub struct ImproveProblem<'a> {
    /// The map.
    pub obstacles: &'a ObstacleMap,
    /// The vehicle's body.
    pub body: &'a Body,
    /// Gears that may be used.
    pub gears: Gears,
    /// The poses at which paths may end; none where they end as they do.
    pub end: Option<&'a GoalRegion>,
    /// Cost of driving.
    pub cost: &'a VehicleCost,
    /// Additional cost of positions.
    pub soft: Option<SoftCost<'a>>,
}

/// An improved path.
#[derive(Clone, Debug, PartialEq)]
pub struct Improved {
    /// Its arcs, from the start pose that was given.
    pub arcs: Vec<Arc>,
    /// Cost before, meters.
    pub start_cost_m: f64,
    /// Cost now, meters.
    pub cost_m: f64,
    /// Tries made; each is a step of the limits.
    pub n_tries: u64,
    /// The limit that ended the search early: budget, deadline or cancel; none if tries ceased to
    /// gain.
    pub ended: Option<Status>,
}

/// Improves driven paths on a map.
pub struct Improver<'a> {
    task: ImproveTask<'a>,
}

/// Tries between two looks at whether there is something to report.
const TRIES_PER_ROUND: u64 = 64;
/// The least gain that is worth reporting, relative to the cost.
const REPORT_GAIN: f64 = 1e-4;
/// Largest distance of the end of a chain from its goal by rounding, meters and radians.
const END_TOLERANCE: f64 = 1e-9;
/// Tries to move the end in a systematic pass.
const END_TRIES: usize = 16;
/// Numbers of pieces that a systematic pass replaces at once, in this order.
const SPANS: [usize; 6] = [32, 16, 8, 4, 3, 2];

impl<'a> Improver<'a> {
    /// Prepares the improvement of paths; parameters are taken as checked.
    pub fn new(problem: &ImproveProblem<'a>, config: &'a ImproveConfig) -> Self {
        let ImproveProblem {
            obstacles,
            body,
            gears,
            end,
            cost,
            soft,
        } = *problem;
        let meter = DriveMeter::new(obstacles, body, cost);
        let meter = soft.map_or(meter, |soft| meter.with_soft_cost(soft));
        Self {
            task: ImproveTask {
                obstacles,
                body,
                radius_m: cost.radius_m,
                gears,
                end,
                meter,
                config,
            },
        }
    }

    /// Makes a free chain of arcs cheaper until tries cease to gain or a limit ends the search.
    /// Every chain that `on_improved` receives is free, is cheaper than the one before, and ends
    /// where the first one ends, within 1e-9, or where the problem allows it to end.
    pub fn improve(
        &self,
        (start, arcs): (Pose2, &[Arc]),
        seed: Seed,
        limits: &mut Limits,
        on_improved: &mut dyn FnMut(&[Arc], &mut Limits),
    ) -> Improved {
        let best = DriveMeter::merged(arcs);
        let goal = best.iter().fold(start, |pose, arc| arc.end_from(pose));
        let mut run = LocalSearch {
            task: &self.task,
            chain: Chain::new(&self.task, start, &best),
            start,
            goal,
            best_m: 0.0,
            best,
            seed,
            n_tries: 0,
            limits,
            on_improved,
        };
        run.best_m = run.chain.cost_m;
        let start_cost_m = run.best_m;
        let ended = if run.best.is_empty() {
            None
        } else {
            run.search().err()
        };
        run.report();
        Improved {
            start_cost_m,
            cost_m: run.best_m,
            n_tries: run.n_tries,
            arcs: run.best,
            ended,
        }
    }
}

/// The improvement of one path.
struct LocalSearch<'a, 'b, 'c> {
    task: &'a ImproveTask<'a>,
    chain: Chain,
    start: Pose2,
    goal: Pose2,
    /// The last chain that was checked as a whole, and its cost.
    best: Vec<Arc>,
    best_m: f64,
    seed: Seed,
    n_tries: u64,
    limits: &'a mut Limits<'b>,
    on_improved: &'c mut dyn FnMut(&[Arc], &mut Limits),
}

impl LocalSearch<'_, '_, '_> {
    fn search(&mut self) -> Result<(), Status> {
        self.polish()?;
        self.try_at_random()?;
        self.polish()
    }

    /// Random tries until they cease to gain.
    fn try_at_random(&mut self) -> Result<(), Status> {
        let config = self.task.config;
        let mut reference_m = self.chain.cost_m;
        let mut n_stalled = 0;
        while self.n_tries < config.max_tries && n_stalled < self.patience() {
            let mut stream = self.begin()?;
            let cusps_m = self.chain.cusps_m();
            let shares = [
                config.shortcut_share,
                config.shift_share,
                if cusps_m.is_empty() {
                    0.0
                } else {
                    config.cusp_share
                },
                if self.task.end.is_some() {
                    config.end_share
                } else {
                    0.0
                },
            ];
            let mut drawn = stream.range(0.0, shares.iter().sum());
            let mut attempt = self.attempt(stream);
            if drawn < shares[0] {
                attempt.shortcut();
            } else {
                drawn -= shares[0];
                if drawn < shares[1] {
                    attempt.shift();
                } else if drawn < shares[1] + shares[2] {
                    attempt.without_cusp(&cusps_m);
                } else if shares[3] > 0.0 {
                    attempt.move_end();
                }
            }
            n_stalled += 1;
            if self.chain.cost_m < reference_m * (1.0 - config.stall_gain) {
                reference_m = self.chain.cost_m;
                n_stalled = 0;
            }
        }
        Ok(())
    }

    /// Tries without a gain after which to stop.
    fn patience(&self) -> u64 {
        let radii = (self.chain.length_m / self.task.radius_m).max(1.0);
        (f64::from(self.task.config.stall_tries_per_radius) * radii) as u64
    }

    /// Replaces neighboring pieces, many at once first, as long as that gains.
    fn polish(&mut self) -> Result<(), Status> {
        for _ in 0..self.task.config.polish_passes {
            let before_m = self.chain.cost_m;
            for span in SPANS {
                self.pass(span)?;
            }
            self.move_end()?;
            if self.chain.cost_m >= before_m * (1.0 - self.task.config.stall_gain) {
                break;
            }
        }
        Ok(())
    }

    /// Tries other ends, where the path may end elsewhere.
    fn move_end(&mut self) -> Result<(), Status> {
        if self.task.end.is_none() || self.task.config.end_share == 0.0 {
            return Ok(());
        }
        for _ in 0..END_TRIES {
            if self.n_tries >= self.task.config.max_tries || self.chain.pieces.is_empty() {
                break;
            }
            let stream = self.begin()?;
            self.attempt(stream).move_end();
        }
        Ok(())
    }

    /// Tries to replace all stretches of so many pieces.
    fn pass(&mut self, span: usize) -> Result<(), Status> {
        let mut first = 0;
        while first + 1 < self.chain.pieces.len() && self.n_tries < self.task.config.max_tries {
            let stream = self.begin()?;
            let last = (first + span).min(self.chain.pieces.len()) - 1;
            let [from, to] = [first, last].map(|i| self.chain.pieces[i]);
            let to_m = to.from_m + to.arc.length_m();
            self.attempt(stream).join([from.from_m, to_m], false);
            first += (span / 4).max(1);
        }
        Ok(())
    }

    /// Counts a try and gives it its random numbers.
    fn begin(&mut self) -> Result<RandomStream, Status> {
        self.limits.long_step()?;
        if self.n_tries.is_multiple_of(TRIES_PER_ROUND) {
            self.report();
        }
        self.n_tries += 1;
        Ok(self.seed.stream([self.n_tries, 0]))
    }

    fn attempt(&mut self, stream: RandomStream) -> Attempt<'_> {
        Attempt {
            task: self.task,
            chain: &mut self.chain,
            stream,
        }
    }

    /// Keeps and reports a path that is noticeably cheaper. Replaced stretches meet the path to
    /// rounding; driven from the start on, that adds up, so that the whole is checked once more.
    fn report(&mut self) {
        if self.chain.cost_m >= self.best_m * (1.0 - REPORT_GAIN) {
            return;
        }
        let arcs = self.chain.arcs();
        if self.holds(&arcs) {
            self.best_m = self.chain.cost_m;
            self.best = arcs;
            (self.on_improved)(&self.best, self.limits);
        } else {
            self.chain = Chain::new(self.task, self.start, &self.best);
        }
    }

    fn holds(&self, arcs: &[Arc]) -> bool {
        let mut pose = self.start;
        let is_free = arcs.iter().all(|&arc| {
            let start = pose;
            pose = arc.end_from(pose);
            self.task.is_free(start, arc)
        });
        if let Some(end) = self.task.end {
            return is_free && end.contains(pose);
        }
        let apart_m = pose.position().distance(self.goal.position());
        let apart_rad = angle_difference(pose.heading, self.goal.heading).abs();
        is_free && apart_m <= END_TOLERANCE && apart_rad <= END_TOLERANCE
    }
}
