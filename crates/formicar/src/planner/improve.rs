//! The flagship: a race for a first path, then improvement until it ceases to gain.

use super::race::{Rules, Won, WonStage, race};
use super::run::{Ended, Found};
use super::{PlanError, Planner};
use crate::colony::drive::DriveColony;
use crate::geometry::{Arc, Point2, Pose2};
use crate::numeric::Seed;
use crate::progress::{Event, Limits, Status};
use crate::scenario::Request;
use crate::search::{DriveProblem, Driven, Side, hybrid_astar};
use crate::smoothing::{ImproveConfig, ImproveProblem, Improver};
use crate::validation::judge;

/// Another path is improved where it is at most so many times as long as the best one.
const WORTH_RATIO: f64 = 1.3;
/// Tries that the way of an ant is given at first,
const GLANCE_TRIES: u64 = 300;
/// and how much dearer than the best path it may then be to be improved further.
const PROMISING_RATIO: f64 = 1.03;
/// Where the best path costs at least so many times the way along the goal field, which knows no
/// turns, there may be better ways around: ants look for them,
const GOOD_RATIO: f64 = 1.25;
/// and hybrid A* has so many times its steps.
const MORE_STEPS: u64 = 4;

impl Planner {
    /// Finds a path and improves it.
    pub(super) fn drive_and_improve(
        &mut self,
        request: &Request,
        seed: Seed,
        limits: &mut Limits,
    ) -> Result<Result<Found, Ended>, PlanError> {
        let ground = self.drive_ground()?;
        let problem = DriveProblem::new(&ground, &self.config.hybrid_astar, request);
        limits.tell(&Event::SearchStarted);
        let rules = self.rules(seed);
        let won = match race(&problem, &rules, limits) {
            Ok(won) => won,
            Err(status) => return Ok(Err(status.into())),
        };
        let improved = self.improve(Some(request), won, (&problem, &rules), limits);
        improved
            .found(self, request)
            .map_or_else(|ended| Ok(Err(ended)), |found| Ok(Ok(found)))
    }

    /// How this planner races for a seed.
    pub(super) fn rules(&self, seed: Seed) -> Rules<'_> {
        Rules {
            config: &self.config.drive,
            seed,
            n_threads: self.n_threads,
        }
    }

    /// Improves the first path, and others that hybrid A* and ants still find. The observer is
    /// told of paths that the judge certifies for a request, where one is given.
    pub(super) fn improve(
        &self,
        told: Option<&Request>,
        won: Won,
        (problem, rules): (&DriveProblem, &Rules),
        limits: &mut Limits,
    ) -> Improvement {
        let soft = self.soft_costs.as_deref();
        let price = |position: Point2| soft.map_or(0.0, |costs| costs.price_at(position));
        let task = ImproveProblem {
            obstacles: &self.obstacles,
            body: problem.map().body(),
            radius_m: problem.map().radius_m(),
            gears: problem.gears(),
            cost: &self.config.cost,
            soft: soft.is_some().then_some(&price),
        };
        let glance = ImproveConfig {
            max_tries: self.config.improve.max_tries.min(GLANCE_TRIES),
            ..self.config.improve.clone()
        };
        let mut best = Best {
            planner: self,
            told,
            improver: Improver::new(&task, &self.config.improve),
            glance: Improver::new(&task, &glance),
            path: won.path.clone(),
            cost_m: f64::INFINITY,
            seed: rules.seed,
            n_tried: 0,
        };
        best.tell(won.path.0, &won.path.1, limits);
        let ended = best.run(won, problem, rules, limits).err();
        Improvement {
            path: best.path,
            cost_m: best.cost_m,
            ended,
        }
    }

    /// Tells the observer of a path that the judge certifies.
    pub(super) fn tell_if_certified(
        &self,
        request: &Request,
        (start, arcs): (Pose2, &[Arc]),
        limits: &mut Limits,
    ) {
        let path = self.driven(request, start, arcs).path;
        let report = judge(&self.obstacles, &self.vehicle, request, &path);
        if report.certify().is_ok() {
            limits.tell_improved(&path);
        }
    }
}

/// What came of an improvement.
pub(super) struct Improvement {
    pub(super) path: Driven,
    pub(super) cost_m: f64,
    /// What ended it before it ceased to gain.
    pub(super) ended: Option<Status>,
}

impl Improvement {
    /// The path for a request; a cancel leaves none.
    pub(super) fn found(&self, planner: &Planner, request: &Request) -> Result<Found, Ended> {
        if self.ended == Some(Status::Cancelled) {
            return Err(Status::Cancelled.into());
        }
        let mut found = planner.driven(request, self.path.0, &self.path.1);
        found.cut_by = self.ended;
        Ok(found)
    }
}

/// The best path so far, and what makes paths better.
struct Best<'a> {
    planner: &'a Planner,
    told: Option<&'a Request>,
    improver: Improver<'a>,
    /// One that tells soon whether a path is worth more.
    glance: Improver<'a>,
    path: Driven,
    cost_m: f64,
    seed: Seed,
    n_tried: u64,
}

impl Best<'_> {
    fn run(
        &mut self,
        won: Won,
        problem: &DriveProblem,
        rules: &Rules,
        limits: &mut Limits,
    ) -> Result<(), Status> {
        self.offer(won.path, limits)?;
        self.heed_soft_costs(problem, rules, limits)?;
        let Some(WonStage {
            problem,
            mut guide,
            hybrid,
        }) = won.stage
        else {
            return Ok(());
        };
        let start = problem.starts().first().map(|pose| pose.position());
        let least_m = start.and_then(|start| guide.estimate_m(&problem, start));
        let is_good = |cost_m: f64| least_m.is_some_and(|least_m| cost_m < GOOD_RATIO * least_m);
        if let Some(mut hybrid) = hybrid {
            let doubts = if is_good(self.cost_m) { 1 } else { MORE_STEPS };
            match hybrid.run(&mut guide, doubts * rules.config.second_steps, limits) {
                Ok(Some(path)) => self.offer(path, limits)?,
                Ok(None) | Err(Status::NoPath) => {}
                Err(status) => return Err(status),
            }
        }
        let sends_none = rules.config.n_stalled == 0 || rules.config.n_ants == 0;
        if is_good(self.cost_m) || sends_none || problem.side() == Side::Goal {
            return Ok(());
        }
        let ants = (rules.seed, rules.n_threads);
        let (ended, _) = DriveColony::with(&problem, rules.config, ants, guide, |colony| {
            self.send_ants(colony, rules.config.n_stalled, limits)
        });
        ended
    }

    /// Where soft costs are given, a path that hybrid A* finds with them: local search alone would
    /// not find the way around what is unwanted.
    fn heed_soft_costs(
        &mut self,
        problem: &DriveProblem,
        rules: &Rules,
        limits: &mut Limits,
    ) -> Result<(), Status> {
        let Some(costs) = self.planner.soft_costs.as_deref() else {
            return Ok(());
        };
        let problem = problem.clone().with_soft_costs(Some(costs));
        let n_steps = MORE_STEPS * rules.config.second_steps;
        match limits.within(n_steps, |limits| hybrid_astar(&problem, limits)) {
            Ok(path) => self.offer(path, limits),
            Err(status @ (Status::TimedOut | Status::Cancelled)) => Err(status),
            Err(_) => Ok(()),
        }
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
                self.glance_at((start, way), limits)?;
            }
            n_idle = if self.cost_m < before_m * (1.0 - self.planner.config.improve.stall_gain) {
                0
            } else {
                n_idle + 1
            };
        }
        Ok(())
    }

    /// Improves a path, and keeps it where it is the cheapest.
    fn offer(&mut self, (start, arcs): Driven, limits: &mut Limits) -> Result<(), Status> {
        let length_m = |arcs: &[Arc]| arcs.iter().map(|arc| arc.length_m()).sum::<f64>();
        let is_long = length_m(&arcs) > WORTH_RATIO * length_m(&self.path.1);
        if self.cost_m.is_finite() && is_long && self.planner.soft_costs.is_none() {
            return Ok(());
        }
        let seed = self.next_seed();
        let is_first = self.cost_m.is_infinite();
        let (planner, told) = (self.planner, self.told.filter(|_| is_first));
        let mut tell = |arcs: &[Arc], limits: &mut Limits| {
            if let Some(request) = told {
                planner.tell_if_certified(request, (start, arcs), limits);
            }
        };
        let improved = self
            .improver
            .improve((start, &arcs), seed, limits, &mut tell);
        if improved.cost_m < self.cost_m {
            self.cost_m = improved.cost_m;
            self.path = (start, improved.arcs);
            if !is_first {
                self.tell(start, &self.path.1, limits);
            }
        }
        improved.ended.map_or(Ok(()), Err)
    }

    /// Improves the way of an ant a little, and then as any path where it comes near the best.
    fn glance_at(&mut self, (start, arcs): Driven, limits: &mut Limits) -> Result<(), Status> {
        let seed = self.next_seed();
        let seen = self
            .glance
            .improve((start, &arcs), seed, limits, &mut |_, _| {});
        match seen.ended {
            Some(status) => Err(status),
            None if seen.cost_m < PROMISING_RATIO * self.cost_m => {
                self.offer((start, seen.arcs), limits)
            }
            None => Ok(()),
        }
    }

    fn next_seed(&mut self) -> Seed {
        self.n_tried += 1;
        Seed(self.seed.stream([self.n_tried, 1]).next_u64())
    }

    fn tell(&self, start: Pose2, arcs: &[Arc], limits: &mut Limits) {
        if let Some(request) = self.told {
            self.planner
                .tell_if_certified(request, (start, arcs), limits);
        }
    }
}
