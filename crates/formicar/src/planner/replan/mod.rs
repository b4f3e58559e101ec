//! Planning again after the map has changed: the previous path is mended and improved, and gives
//! way only to one that is clearly cheaper.

mod bridge;
mod choice;
mod config;
mod kept;
mod mend;

pub use config::ReplanConfig;

use super::race::race;
use super::run::{Ended, Found};
use super::{Outcome, PlanError, Planner, PlannerName};
use crate::geometry::{Arc, Point2, Pose2};
use crate::numeric::Seed;
use crate::objective::DriveMeter;
use crate::path::CurvePath;
use crate::progress::{Event, Limits, Observer, Status};
use crate::scenario::{GoalHeading, GoalTolerance, Request, StartHeading};
use crate::search::{DriveProblem, Driven, HybridAstarConfig};
use crate::validation::judge;
use crate::vehicle::Motion;
use choice::Choice;
use mend::Mender;

/// Steps that a search over a gap may take, at least; else as many as planning anew took.
const LEAST_DETOUR_STEPS: u64 = 2000;
/// How exactly a search over a gap must end, metres and radians: by a curve.
const DETOUR_TOLERANCE: GoalTolerance = GoalTolerance {
    xy_m: 1e-9,
    yaw_rad: 1e-9,
};

impl Planner {
    /// Plans a request again, mostly after [`Planner::update_map`]: from where the vehicle is now,
    /// and with what is left of the path that it drives.
    ///
    /// The part of the previous path ahead of the start is kept where it is still free, met from
    /// the start by a free curve, and bridged where it is broken: by curves or, where none is
    /// free, by a search between the ends of the gap. What comes of it is improved like any first
    /// path. A path planned anew, which is that of [`Planner::plan`], takes its place only where it
    /// is cheaper by more than [`ReplanConfig::consistency`]. Where nothing can be mended, the
    /// answer is that of [`Planner::plan`].
    ///
    /// With via points, those still ahead, the mended path is not improved.
    ///
    /// Same map, vehicle, configuration, request, previous path and seed: same path.
    ///
    /// # Errors
    /// As [`Planner::plan`]; and a planner other than `formicar`.
    pub fn replan(
        &mut self,
        request: &Request,
        previous: &CurvePath,
        seed: Seed,
        observer: &mut dyn Observer,
    ) -> Result<Outcome, PlanError> {
        let planner = self.config.planner;
        if planner != PlannerName::Formicar {
            return Err(PlanError::CannotReplan { planner });
        }
        if self.vehicle.motion() != Motion::Car {
            return Err(PlanError::NeedsACar { planner });
        }
        let mut limits = self.begin(request, observer)?;
        let found = if let Some(sealed) = self.sealed_off(request) {
            Err(sealed)
        } else if request.via.is_empty() {
            self.renew(request, previous, seed, &mut limits)?
        } else {
            self.renew_legs(request, previous, seed, &mut limits)?
        };
        Ok(self.conclude(request, seed, found, &mut limits))
    }

    /// Plans without via points.
    fn renew(
        &mut self,
        request: &Request,
        previous: &CurvePath,
        seed: Seed,
        limits: &mut Limits,
    ) -> Result<Result<Found, Ended>, PlanError> {
        let ground = self.drive_ground()?;
        let problem = DriveProblem::new(&ground, &self.config.hybrid_astar, request);
        limits.tell(&Event::SearchStarted);
        let mender = self.mender(&problem, previous);
        let mended = mender.as_ref().and_then(|mender| mender.mend(None));
        let mut mended = self.told_if_certified(request, mended, limits);
        let n_before = limits.n_steps();
        let rules = self.rules(seed);
        let anew = race(&problem, &rules, limits);
        if matches!(anew, Err(Status::Cancelled)) {
            return Ok(Err(Status::Cancelled.into()));
        }
        if let (None, Some(mender), Ok(_)) = (&mended, &mender, &anew) {
            let most_steps = (limits.n_steps() - n_before).max(LEAST_DETOUR_STEPS);
            let path = self.mend_by_search(request, mender, (seed, most_steps), limits);
            mended = self.told_if_certified(request, path, limits);
        }
        let choice = Choice {
            planner: self,
            request,
            problem: &problem,
            rules: &rules,
        };
        Ok(choice.take(mended, anew, limits))
    }

    fn mender<'a>(
        &'a self,
        problem: &'a DriveProblem<'a>,
        previous: &CurvePath,
    ) -> Option<Mender<'a>> {
        let frame = self.obstacles.frame();
        let previous = previous.map_poses(|pose| frame.to_grid(pose));
        Mender::new(problem, &self.config.cost, &previous)
    }

    /// Mends a path, with searches over its gaps that take so many steps together.
    fn mend_by_search(
        &self,
        request: &Request,
        mender: &Mender,
        (seed, most_steps): (Seed, u64),
        limits: &mut Limits,
    ) -> Option<Driven> {
        let frame = self.obstacles.frame();
        let ground = mender.problem.map();
        let end = limits.n_steps().saturating_add(most_steps);
        let mut search = |from: Pose2, to: Pose2| {
            let config = HybridAstarConfig {
                max_iterations: end.checked_sub(limits.n_steps()).filter(|&n| n > 0)?,
                ..self.config.hybrid_astar.clone()
            };
            let gap = Request {
                start: frame.to_world(from),
                start_heading: StartHeading::Exact,
                goal_heading: GoalHeading::Exact,
                goal_tolerance: DETOUR_TOLERANCE,
                other_goals: Vec::new(),
                ..request.with_goal(frame.to_world(to))
            };
            let problem = DriveProblem::new(ground, &config, &gap);
            let found = race(&problem, &self.rules(seed), limits);
            found.ok().map(|won| won.path.1)
        };
        mender.mend(Some(&mut search))
    }

    /// A path that the judge certifies, of which the observer is told.
    fn told_if_certified(
        &self,
        request: &Request,
        path: Option<Driven>,
        limits: &mut Limits,
    ) -> Option<Driven> {
        let path = path.filter(|path| self.is_certified(request, path))?;
        self.tell_if_certified(request, (path.0, &path.1), limits);
        Some(path)
    }

    fn is_certified(&self, request: &Request, (start, arcs): &Driven) -> bool {
        let path = self.driven(request, *start, arcs).path;
        judge(&self.obstacles, &self.vehicle, request, &path)
            .certify()
            .is_ok()
    }

    /// Plans past via points, and takes the previous path as it is mended where that is not much
    /// dearer.
    fn renew_legs(
        &mut self,
        request: &Request,
        previous: &CurvePath,
        seed: Seed,
        limits: &mut Limits,
    ) -> Result<Result<Found, Ended>, PlanError> {
        let anew = limits.in_parts(|limits| self.search_legs(request, seed, limits))?;
        if matches!(&anew, Err(ended) if ended.status == Status::Cancelled) {
            return Ok(anew);
        }
        let ground = self.drive_ground()?;
        let problem = DriveProblem::new(&ground, &self.config.hybrid_astar, request);
        let mender = self.mender(&problem, previous);
        let mended = mender.and_then(|mender| mender.mend(None));
        let Some(mended) = mended.filter(|path| self.is_certified(request, path)) else {
            return Ok(anew);
        };
        let old = self.driven(request, mended.0, &mended.1);
        let Ok(anew) = anew else {
            return Ok(Ok(old));
        };
        let costs_m = [&old, &anew].map(|found| self.cost_m(&problem, &found.path));
        Ok(Ok(if self.is_worth_it(costs_m) { anew } else { old }))
    }

    /// Whether a new path is cheaper than an old one by enough to take its place.
    fn is_worth_it(&self, [old_m, new_m]: [f64; 2]) -> bool {
        new_m < old_m * (1.0 - self.config.replan.consistency)
    }

    fn cost_m(&self, problem: &DriveProblem, path: &CurvePath) -> f64 {
        let ground = problem.map();
        let meter = DriveMeter::new(
            &self.obstacles,
            ground.body(),
            &self.config.cost,
            ground.radius_m(),
        );
        let soft = self.soft_costs.as_deref();
        let price = |position: Point2| soft.map_or(0.0, |costs| costs.price_at(position));
        let meter = if soft.is_some() {
            meter.with_soft_cost(&price)
        } else {
            meter
        };
        let arcs: Vec<Arc> = path.segments().iter().map(kept::arc_of).collect();
        meter.path_m(self.obstacles.frame().to_grid(path.start()), &arcs)
    }
}
