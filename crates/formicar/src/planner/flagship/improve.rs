//! The improvement of the first path, and of others that hybrid A* and ants still find.

use super::query::Query;
use super::race::{FirstPath, Origin, RaceStage};
use crate::colony::drive::DriveColony;
use crate::geometry::{Arc, Point2};
use crate::numeric::Seed;
use crate::progress::{Limits, Status};
use crate::search::{DriveProblem, Driven, Side, hybrid_astar};
use crate::smoothing::{ImproveConfig, ImproveProblem, Improver};

/// Another path is improved where on open ground it would cost at most so many times what the
/// best one costs.
const WORTH_RATIO: f64 = 1.3;
/// Tries that the path of an ant is given at first,
const QUICK_TRIES: u64 = 300;
/// and how much dearer than the best path it may then be to be improved further.
const PROMISING_RATIO: f64 = 1.1;
/// A best path that costs at least so many times the way along the goal field, which knows no
/// turns, may not be the best way around: ants look for others,
const GOOD_RATIO: f64 = 1.25;
/// and hybrid A* has so many times its steps.
const MORE_STEPS: u64 = 4;
/// Clearances at which paths are sought that keep more than the best one,
const N_ROOMS: i32 = 4;
/// by so much.
const MORE_ROOM: f64 = 1.2;
/// A second search has so many steps from either end,
const SECOND_STEPS: u64 = 5_000;
/// or those of the first path divided by this, whichever is more;
const SECOND_SHARE: u64 = 4;
/// on the refined lattice, so many.
const REFINED_SECOND_STEPS: u64 = 20_000;

/// Paths that are announced to the observer while they improve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Announce {
    /// Those that the judge certifies.
    Certified,
    /// No path: another one stands.
    Nothing,
}

/// An improved path.
pub(super) struct Improvement {
    pub(super) path: Driven,
    pub(super) cost_m: f64,
    /// The limit that ended the improvement before it ceased to gain.
    pub(super) ended: Option<Status>,
}

impl Query<'_> {
    /// Improves the first path, and others that hybrid A* and ants still find.
    pub(super) fn improve(
        &self,
        first: FirstPath,
        announce: Announce,
        limits: &mut Limits,
    ) -> Improvement {
        let soft = self.task.soft_costs();
        let price = |position: Point2| soft.map_or(0.0, |costs| costs.price_at(position));
        let ground = self.problem.map();
        let task = ImproveProblem {
            obstacles: self.task.obstacles(),
            body: ground.body(),
            gears: self.problem.gears(),
            end: Some(self.problem.region()).filter(|region| region.has_room()),
            cost: &self.cost,
            soft: soft.is_some().then_some(&price),
        };
        let thorough = &self.parameters.improve;
        let quick = ImproveConfig {
            max_tries: thorough.max_tries.min(QUICK_TRIES),
            ..thorough.clone()
        };
        let mut best = Best {
            query: self,
            announce,
            improver: Improver::new(&task, thorough),
            quick_improver: Improver::new(&task, &quick),
            path: first.path.clone(),
            cost_m: f64::INFINITY,
            seed: self.task.seed(),
            n_tried: 0,
        };
        best.announce(&best.path, limits);
        let ended = best.run(first, limits);
        Improvement {
            path: best.path,
            cost_m: best.cost_m,
            ended: ended.err(),
        }
    }
}

/// The best path so far, and what makes paths better.
struct Best<'a> {
    query: &'a Query<'a>,
    announce: Announce,
    improver: Improver<'a>,
    /// One that tells soon whether a path is worth more.
    quick_improver: Improver<'a>,
    path: Driven,
    cost_m: f64,
    seed: Seed,
    n_tried: u64,
}

impl Best<'_> {
    fn run(&mut self, first: FirstPath, limits: &mut Limits) -> Result<(), Status> {
        let n_steps = SECOND_STEPS.max(limits.n_steps() / SECOND_SHARE);
        self.offer(first.path, limits)?;
        self.heed_soft_costs(limits)?;
        let query = self.query;
        match first.origin {
            Origin::Mended => Ok(()),
            Origin::Curve => {
                self.doubt_a_curve(n_steps, limits)?;
                if self.least_clearance_m() >= 0.5 * query.cost.clearance_wish_m {
                    return Ok(());
                }
                self.search_with_room(query.problem, n_steps, limits)
            }
            Origin::Stage(stage) => {
                let problem = stage.problem.clone();
                self.search_on(*stage, n_steps, limits)?;
                self.search_with_room(&problem, n_steps, limits)
            }
        }
    }

    /// Searches by the whole cost where the first path, a single curve, is dear beside the cheapest
    /// curve on open ground.
    fn doubt_a_curve(&mut self, n_steps: u64, limits: &mut Limits) -> Result<(), Status> {
        let least_m = self.query.problem.least_curve_m(&self.query.cost);
        if self.summed_m() < GOOD_RATIO * least_m {
            return Ok(());
        }
        let query = self.query;
        self.search_by_higher_cost(query.problem, n_steps, limits)
            .map(|_| ())
    }

    /// Goes on with the stage that found the first path: hybrid A* where ants were faster, a search
    /// by the whole cost and focused ants where the best path is still dear.
    fn search_on(
        &mut self,
        stage: RaceStage,
        n_steps: u64,
        limits: &mut Limits,
    ) -> Result<(), Status> {
        let rules = self.query.rules();
        let RaceStage {
            problem,
            mut guide,
            hybrid,
        } = stage;
        let start = problem.starts().first().map(|pose| pose.position());
        let least_m = start.and_then(|start| guide.estimate_m(&problem, start));
        let is_good = |best: &Self| least_m.is_some_and(|m| best.summed_m() < GOOD_RATIO * m);
        if let Some(mut hybrid) = hybrid {
            let doubts = if is_good(self) { 1 } else { MORE_STEPS };
            match hybrid.run(&mut guide, doubts * rules.config.second_steps, limits) {
                Ok(Some(path)) => self.offer(path, limits)?,
                Ok(None) | Err(Status::NoPath) => {}
                Err(status) => return Err(status),
            }
        }
        if is_good(self) || self.search_by_higher_cost(&problem, n_steps, limits)? {
            return Ok(());
        }
        let sends_none = rules.config.n_stalled == 0 || rules.config.n_ants == 0;
        if is_good(self) || sends_none || problem.side() == Side::Goal {
            return Ok(());
        }
        let ants = (rules.seed, rules.n_threads);
        let (ended, _) = DriveColony::with(&problem, rules.config, ants, guide, |colony| {
            self.send_ants(colony, rules.config.n_stalled, limits)
        });
        ended
    }

    /// The cost of the best path without the price of its least clearance: what can be compared
    /// with a length.
    fn summed_m(&self) -> f64 {
        let (start, arcs) = &self.path;
        let cost = self.query.cost.without_least_clearance();
        self.query.path_m(&cost, *start, arcs)
    }

    /// With soft costs, offers a path that hybrid A* finds by them: local search alone would not
    /// find the way around unwanted ground.
    fn heed_soft_costs(&mut self, limits: &mut Limits) -> Result<(), Status> {
        let Some(costs) = self.query.task.soft_costs() else {
            return Ok(());
        };
        let problem = self.query.problem.clone().with_soft_costs(Some(costs));
        let n_steps = MORE_STEPS * self.query.rules().config.second_steps;
        match search_within(n_steps, &problem, limits)? {
            Some(path) => self.offer(path, limits),
            None => Ok(()),
        }
    }

    /// Offers the paths that hybrid A* finds from either end at a higher cost: the first path may
    /// be a maneuver that local search does not leave. Returns whether there were any.
    fn search_by_higher_cost(
        &mut self,
        problem: &DriveProblem,
        n_steps: u64,
        limits: &mut Limits,
    ) -> Result<bool, Status> {
        let mut is_found = false;
        let n_steps = if problem.is_refined() {
            n_steps.max(REFINED_SECOND_STEPS)
        } else {
            n_steps
        };
        let dearer = problem.at_higher_cost();
        let other_end = problem.swapped().filter(|_| problem.is_refined());
        let problems = [other_end, dearer.swapped(), Some(dearer)];
        for problem in problems.into_iter().flatten() {
            if let Some(path) = search_within(n_steps, &problem, limits)? {
                is_found = true;
                self.offer(path, limits)?;
            }
        }
        Ok(is_found)
    }

    /// Offers the paths that hybrid A* finds from either end where motions keep a clearance: half
    /// the wish, or by halves less. The most that the ends allow is always tried, since a guide
    /// that keeps off obstacles may know another way around; less only if the best path keeps less
    /// still.
    ///
    /// The lattice is that on which the first path was found.
    fn search_with_room(
        &mut self,
        problem: &DriveProblem,
        n_steps: u64,
        limits: &mut Limits,
    ) -> Result<(), Status> {
        if !self.query.cost.counts_least_clearance() {
            return Ok(());
        }
        let wish_m = self.query.cost.clearance_wish_m;
        let rooms_m = (1..=N_ROOMS).map(|n| 0.5_f64.powi(n) * wish_m);
        let problems = rooms_m.filter_map(|room_m| Some((room_m, problem.keeping(room_m)?)));
        for (place, (room_m, problem)) in problems.enumerate() {
            if place > 0 && room_m < MORE_ROOM * self.least_clearance_m() {
                break;
            }
            for problem in [problem.swapped(), Some(problem)].into_iter().flatten() {
                if let Some(path) = search_within(n_steps, &problem, limits)? {
                    self.try_quickly(path, limits)?;
                }
            }
        }
        Ok(())
    }

    /// The least clearance of the best path, meters, at most the wish.
    fn least_clearance_m(&self) -> f64 {
        let (start, arcs) = &self.path;
        self.query.least_clearance_m(*start, arcs)
    }

    /// Sends focused ants until so many generations gained nothing.
    fn send_ants(
        &mut self,
        colony: &mut DriveColony,
        n_stalled: u32,
        limits: &mut Limits,
    ) -> Result<(), Status> {
        let mut n_idle = 0;
        while n_idle < n_stalled {
            let before_m = self.cost_m;
            let (start, arcs) = self.path.clone();
            for way in colony.focus((start, &arcs), self.seed, limits)? {
                self.try_quickly((start, way), limits)?;
            }
            let stall_gain = self.query.parameters.improve.stall_gain;
            n_idle = if self.cost_m < before_m * (1.0 - stall_gain) {
                0
            } else {
                n_idle + 1
            };
        }
        Ok(())
    }

    /// Improves a path, and keeps it where it is the cheapest.
    fn offer(&mut self, (start, arcs): Driven, limits: &mut Limits) -> Result<(), Status> {
        let is_dear = self.query.cost.open_path_m(&arcs) > WORTH_RATIO * self.cost_m;
        if self.cost_m.is_finite() && is_dear && self.query.task.soft_costs().is_none() {
            return Ok(());
        }
        let seed = self.next_seed();
        let is_first = self.cost_m.is_infinite();
        let (query, is_told) = (self.query, is_first && self.announce == Announce::Certified);
        let mut tell = |arcs: &[Arc], limits: &mut Limits| {
            if is_told {
                query.announce_if_certified(start, arcs, limits);
            }
        };
        let improved = self
            .improver
            .improve((start, &arcs), seed, limits, &mut tell);
        if improved.cost_m < self.cost_m {
            self.cost_m = improved.cost_m;
            self.path = (start, improved.arcs);
            if !is_first {
                self.announce(&self.path, limits);
            }
        }
        improved.ended.map_or(Ok(()), Err)
    }

    /// Improves the path of an ant a little, and then as any path where it comes near the best.
    fn try_quickly(&mut self, (start, arcs): Driven, limits: &mut Limits) -> Result<(), Status> {
        let seed = self.next_seed();
        let tried = self
            .quick_improver
            .improve((start, &arcs), seed, limits, &mut |_, _| {});
        match tried.ended {
            Some(status) => Err(status),
            None if tried.cost_m < PROMISING_RATIO * self.cost_m => {
                self.offer((start, tried.arcs), limits)
            }
            None => Ok(()),
        }
    }

    fn next_seed(&mut self) -> Seed {
        self.n_tried += 1;
        Seed(self.seed.stream([self.n_tried, 1]).next_u64())
    }

    fn announce(&self, (start, arcs): &Driven, limits: &mut Limits) {
        if self.announce == Announce::Certified {
            self.query.announce_if_certified(*start, arcs, limits);
        }
    }
}

/// Searches for some steps; none where they do not suffice.
///
/// # Errors
/// Budget, deadline or cancel.
fn search_within(
    n_steps: u64,
    problem: &DriveProblem,
    limits: &mut Limits,
) -> Result<Option<Driven>, Status> {
    match limits.within(n_steps, |limits| hybrid_astar(problem, limits)) {
        Ok(path) => Ok(Some(path)),
        Err(status @ (Status::TimedOut | Status::Cancelled)) => Err(status),
        Err(_) if limits.is_exhausted() => Err(Status::BudgetExhausted),
        Err(_) => Ok(None),
    }
}
