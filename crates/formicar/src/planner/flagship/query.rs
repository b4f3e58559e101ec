//! One query of `formicar`: what its steps share.

use super::config::FormicarParameters;
use super::improve::{Announce, Improvement};
use super::race::{FirstPath, Origin, Rules};
use crate::geometry::{Arc, Point2, Pose2};
use crate::objective::{DriveMeter, VehicleCost};
use crate::path::CurvePath;
use crate::planner::{Ended, Found, Task};
use crate::progress::{Limits, Status};
use crate::search::{DriveProblem, Driven};
use crate::validation::judge_while;

/// A request with the parameters and the prepared problem.
pub(super) struct Query<'a> {
    pub(super) task: &'a Task<'a>,
    pub(super) parameters: &'a FormicarParameters,
    /// What driving costs the vehicle.
    pub(super) cost: VehicleCost,
    pub(super) problem: &'a DriveProblem<'a>,
}

impl Query<'_> {
    /// The rules of a race for this query.
    pub(super) fn rules(&self) -> Rules<'_> {
        Rules {
            config: &self.parameters.drive,
            cost: self.cost,
            seed: self.task.seed(),
            n_threads: self.task.n_threads(),
        }
    }

    /// An improved path as found; a cancel leaves none.
    pub(super) fn found(&self, improved: &Improvement) -> Result<Found, Ended> {
        if improved.ended == Some(Status::Cancelled) {
            return Err(Status::Cancelled.into());
        }
        let mut found = self.task.driven(improved.path.0, &improved.path.1);
        found.cut_by = improved.ended;
        Ok(found)
    }

    /// The cost of a driven path by some weights, with soft costs, meters.
    pub(super) fn path_m(&self, cost: &VehicleCost, start: Pose2, arcs: &[Arc]) -> f64 {
        let meter = DriveMeter::new(self.task.obstacles(), self.problem.map().body(), cost);
        let Some(costs) = self.task.soft_costs() else {
            return meter.path_m(start, arcs);
        };
        let price = |position: Point2| costs.price_at(position);
        meter.with_soft_cost(&price).path_m(start, arcs)
    }

    /// The least clearance of a driven path, meters, at most the wish.
    pub(super) fn least_clearance_m(&self, start: Pose2, arcs: &[Arc]) -> f64 {
        let body = self.problem.map().body();
        let meter = DriveMeter::new(self.task.obstacles(), body, &self.cost);
        meter.path_least_clearance_m(start, arcs)
    }

    /// Announces a path to the observer where the judge certifies it.
    pub(super) fn announce_if_certified(&self, start: Pose2, arcs: &[Arc], limits: &mut Limits) {
        let path = self.task.driven(start, arcs).path;
        if self.certifies(&path, limits) {
            limits.tell_improved(&path);
        }
    }

    /// The path, announced to the observer, where the judge certifies it.
    pub(super) fn announced(&self, path: Option<Driven>, limits: &mut Limits) -> Option<Driven> {
        let driven = path?;
        let path = self.task.driven(driven.0, &driven.1).path;
        if !self.certifies(&path, limits) {
            return None;
        }
        limits.tell_improved(&path);
        Some(driven)
    }

    /// True where the judge certifies a path before a limit ends the query.
    pub(super) fn certifies(&self, path: &CurvePath, limits: &mut Limits) -> bool {
        let car = (self.task.obstacles().as_ref(), self.task.vehicle());
        let report = limits.keeping_time(|limits| {
            let goes_on = &mut || limits.look().is_ok();
            judge_while(car, self.task.request(), path, goes_on)
        });
        report.is_some_and(|report| report.certify().is_ok())
    }

    /// Improves a mended path and one planned anew, and takes the better one, the mended one with
    /// an advantage. The observer knows of the mended one, so that it alone is announced while it
    /// improves.
    pub(super) fn better_of(
        &self,
        mended: Option<Driven>,
        anew: Result<FirstPath, Status>,
        limits: &mut Limits,
    ) -> Result<Found, Ended> {
        let Some(path) = mended else {
            let improved = self.improve(anew?, Announce::Certified, limits);
            return self.found(&improved);
        };
        let mended = FirstPath {
            path,
            origin: Origin::Mended,
        };
        let old = self.improve(mended, Announce::Certified, limits);
        let mut found = self.found(&old)?;
        let anew = match anew {
            Ok(anew) => anew,
            Err(status) => {
                let is_cut = status == Status::TimedOut || !limits.has_steps_left();
                found.cut_by = found.cut_by.or(is_cut.then_some(status));
                return Ok(found);
            }
        };
        let new = self.improve(anew, Announce::Nothing, limits);
        let cut_by = old.ended.or(new.ended);
        if self.parameters.replan.prefers_new(old.cost_m, new.cost_m) {
            found = self.found(&new)?;
        } else if new.ended == Some(Status::Cancelled) {
            return Err(Status::Cancelled.into());
        }
        Ok(Found { cut_by, ..found })
    }
}
