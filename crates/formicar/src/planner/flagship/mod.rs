//! `formicar`: a race for a first path, then improvement until it ceases to gain.

mod config;
mod improve;
mod query;
mod race;
mod replan;

pub use config::{FormicarParameters, ReplanConfig};

use super::family::Family;
use super::hybrid::{DRIVES, HINTS};
use super::{Abilities, Found, Halt, Hints, Task};
use crate::objective::DriveCost;
use crate::path::CurvePath;
use crate::progress::{Event, Limits};
use crate::search::DriveProblem;
use improve::Announce;
use query::Query;
use race::race;

impl Family for FormicarParameters {
    /// Finds a path and improves it.
    fn find(&self, task: &mut Task<'_>, limits: &mut Limits<'_>) -> Result<Found, Halt> {
        let ground = task.drive_ground(&self.hybrid_astar)?;
        limits.look()?;
        let cost = self.cost.of_vehicle(task.vehicle());
        let query = Query {
            task,
            parameters: self,
            cost,
            problem: &DriveProblem::new(&ground, &self.hybrid_astar, &cost, task.request()),
        };
        limits.tell(&Event::SearchStarted);
        let first = race(query.problem, &query.rules(), limits)?;
        let improved = query.improve(first, Announce::Certified, limits);
        Ok(query.found(&improved)?)
    }

    fn replan(
        &self,
        task: &mut Task<'_>,
        previous: &CurvePath,
        limits: &mut Limits<'_>,
    ) -> Result<Found, Halt> {
        if task.request().via.is_empty() {
            replan::mend_or_find(self, task, previous, limits)
        } else {
            replan::mend_or_find_legs(self, task, previous, limits)
        }
    }

    fn abilities(&self) -> Abilities {
        Abilities {
            replans: true,
            ..DRIVES
        }
    }

    fn hints(&self) -> Hints {
        HINTS
    }

    fn cost(&self) -> &DriveCost {
        &self.cost
    }
}
