//! The flagship: a race for a first path, then improvement until it ceases to gain.

use super::race::{Driven, first_path};
use super::run::{Ended, Found};
use super::{PlanError, Planner};
use crate::geometry::{Arc, Point2, Pose2};
use crate::numeric::Seed;
use crate::progress::{Event, Limits, Status};
use crate::scenario::Request;
use crate::search::DriveProblem;
use crate::smoothing::{ImproveProblem, Improved, Improver};
use crate::validation::judge;

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
        let first = match first_path(&problem, &self.config.drive, seed, limits) {
            Ok(first) => first,
            Err(status) => return Ok(Err(status.into())),
        };
        self.tell_if_certified(request, (first.0, &first.1), limits);
        let improved = self.improve(&problem, &first, (Some(request), seed), limits);
        if improved.ended == Some(Status::Cancelled) {
            return Ok(Err(Status::Cancelled.into()));
        }
        let mut found = self.driven(request, first.0, &improved.arcs);
        found.cut_by = improved.ended;
        Ok(Ok(found))
    }

    /// Improves a path; a budget or deadline that ends it leaves what is reached. The observer is
    /// told of paths for a request, where one is given.
    pub(super) fn improve(
        &self,
        problem: &DriveProblem,
        (start, arcs): &Driven,
        (told, seed): (Option<&Request>, Seed),
        limits: &mut Limits,
    ) -> Improved {
        let soft = self.soft_costs.as_deref();
        let price = |position: Point2| soft.map_or(0.0, |costs| costs.price_at(position));
        let task = ImproveProblem {
            obstacles: &self.obstacles,
            body: problem.ground().body(),
            radius_m: problem.ground().radius_m(),
            motion: problem.motion(),
            cost: &self.config.cost,
            soft: soft.is_some().then_some(&price),
        };
        Improver::new(&task, &self.config.improve).improve(
            (*start, arcs),
            seed,
            limits,
            &mut |arcs, limits| {
                if let Some(request) = told {
                    self.tell_if_certified(request, (*start, arcs), limits);
                }
            },
        )
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
            let (length_m, n_steps) = (path.length_m(), limits.n_steps());
            limits.tell(&Event::Improved { length_m, n_steps });
        }
    }
}
