//! The choice between a mended path and one planned anew.

use crate::numeric::Seed;
use crate::planner::Planner;
use crate::planner::race::Driven;
use crate::planner::run::{Ended, Found};
use crate::progress::{Limits, Status};
use crate::scenario::Request;
use crate::search::DriveProblem;

/// What both paths are for.
pub(super) struct Choice<'a> {
    pub(super) planner: &'a Planner,
    pub(super) request: &'a Request,
    pub(super) problem: &'a DriveProblem<'a>,
    pub(super) seed: Seed,
}

impl Choice<'_> {
    /// Improves both and takes the better one, the mended one with an advantage. The observer,
    /// who knows of the mended one, is told while it improves: it is what stands.
    pub(super) fn take(
        &self,
        mended: Option<Driven>,
        anew: Result<Driven, Status>,
        limits: &mut Limits,
    ) -> Result<Found, Ended> {
        let told = Some(self.request);
        let Some(mended) = mended else {
            let anew = anew?;
            let first = (anew.0, &anew.1[..]);
            self.planner.tell_if_certified(self.request, first, limits);
            return self.improved(&anew, told, limits).map(|(found, _)| found);
        };
        let (mut old, old_m) = self.improved(&mended, told, limits)?;
        let anew = match anew {
            Ok(anew) => anew,
            Err(status) => {
                let is_cut = status == Status::TimedOut || !limits.has_steps_left();
                old.cut_by = old.cut_by.or(is_cut.then_some(status));
                return Ok(old);
            }
        };
        let (new, new_m) = self.improved(&anew, None, limits)?;
        let cut_by = old.cut_by.or(new.cut_by);
        let is_worth_it = self.planner.is_worth_it([old_m, new_m]);
        let found = if is_worth_it { new } else { old };
        Ok(Found { cut_by, ..found })
    }

    /// A path improved, with what it costs.
    fn improved(
        &self,
        first: &Driven,
        told: Option<&Request>,
        limits: &mut Limits,
    ) -> Result<(Found, f64), Ended> {
        let (planner, request) = (self.planner, self.request);
        let improved = planner.improve(self.problem, first, (told, self.seed), limits);
        if improved.ended == Some(Status::Cancelled) {
            return Err(Status::Cancelled.into());
        }
        let mut found = planner.driven(request, first.0, &improved.arcs);
        found.cut_by = improved.ended;
        Ok((found, improved.cost_m))
    }
}
