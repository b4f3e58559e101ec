//! The choice between a mended path and one planned anew.

use crate::planner::Planner;
use crate::planner::improve::Improvement;
use crate::planner::race::{Rules, Won};
use crate::planner::run::{Ended, Found};
use crate::progress::{Limits, Status};
use crate::scenario::Request;
use crate::search::{DriveProblem, Driven};

/// What both paths are for.
pub(super) struct Choice<'a> {
    pub(super) planner: &'a Planner,
    pub(super) request: &'a Request,
    pub(super) problem: &'a DriveProblem<'a>,
    pub(super) rules: &'a Rules<'a>,
}

impl Choice<'_> {
    /// Improves both and takes the better one, the mended one with an advantage. The observer,
    /// who knows of the mended one, is told while it improves: it is what stands.
    pub(super) fn take(
        &self,
        mended: Option<Driven>,
        anew: Result<Won, Status>,
        limits: &mut Limits,
    ) -> Result<Found, Ended> {
        let (planner, told) = (self.planner, Some(self.request));
        let Some(path) = mended else {
            return self
                .improved(told, anew?, limits)
                .found(planner, self.request);
        };
        let mended = Won { path, stage: None };
        let old = self.improved(told, mended, limits);
        let mut found = old.found(planner, self.request)?;
        let anew = match anew {
            Ok(anew) => anew,
            Err(status) => {
                let is_cut = status == Status::TimedOut || !limits.has_steps_left();
                found.cut_by = found.cut_by.or(is_cut.then_some(status));
                return Ok(found);
            }
        };
        let new = self.improved(None, anew, limits);
        let cut_by = old.ended.or(new.ended);
        if planner.is_worth_it([old.cost_m, new.cost_m]) {
            found = new.found(planner, self.request)?;
        } else if new.ended == Some(Status::Cancelled) {
            return Err(Status::Cancelled.into());
        }
        Ok(Found { cut_by, ..found })
    }

    fn improved(&self, told: Option<&Request>, won: Won, limits: &mut Limits) -> Improvement {
        let work = (self.problem, self.rules);
        self.planner.improve(told, won, work, limits)
    }
}
