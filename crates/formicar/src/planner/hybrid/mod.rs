//! `hybrid-astar`: hybrid A* over motion primitives.

use super::family::{Family, sections};
use super::{Abilities, Found, Halt, Hints, SeveralGoals, Task, Vehicles};
use crate::layers::SoftCosts;
use crate::objective::DriveCost;
use crate::progress::{Event, Limits, Status};
use crate::search::{DriveProblem, HybridAstarConfig, hybrid_astar};

sections! {
    /// Parameters of `hybrid-astar`.
    #[derive(Default)]
    HybridAstarParameters {
        /// Parameters of the search.
        hybrid_astar: HybridAstarConfig,
        /// Cost of driving: of motions, and of transitions where a request asks for continuous
        /// curvature.
        cost: DriveCost,
    }
}

/// Advice where a search over motions finds no path.
pub(super) const HINTS: Hints = Hints {
    turning: "a smaller hybrid_astar.step_radii searches a finer lattice",
    own_limit: "a smaller hybrid_astar.step_radii searches a finer lattice, a larger hybrid_astar.max_iterations longer",
};

/// The abilities of searches that drive from pose to pose.
pub(super) const DRIVES: Abilities = Abilities {
    goals: SeveralGoals::AtOnce,
    vehicles: Vehicles::Cars,
    heeds_soft_costs: true,
    replans: false,
    sends_ants: false,
};

impl Family for HybridAstarParameters {
    /// Searches; where soft costs are given, again with these. A preference fails no search:
    /// without a path that heeds them, the first one stays.
    fn find(&self, task: &mut Task<'_>, limits: &mut Limits<'_>) -> Result<Found, Halt> {
        limits.tell(&Event::SearchStarted);
        let plain = self.search(None, task, limits)?;
        let Some(costs) = task.soft_costs() else {
            return Ok(plain);
        };
        match self.search(Some(costs), task, limits) {
            Err(Halt::Ended(ended)) if ended.status != Status::Cancelled => Ok(plain),
            preferred => preferred,
        }
    }

    fn abilities(&self) -> Abilities {
        DRIVES
    }

    fn hints(&self) -> Hints {
        HINTS
    }

    fn cost(&self) -> &DriveCost {
        &self.cost
    }
}

impl HybridAstarParameters {
    fn search(
        &self,
        costs: Option<&SoftCosts>,
        task: &mut Task,
        limits: &mut Limits,
    ) -> Result<Found, Halt> {
        let ground = task.drive_ground(&self.hybrid_astar)?;
        limits.look()?;
        let cost = self.cost.of_vehicle(task.vehicle());
        let problem = DriveProblem::new(&ground, &self.hybrid_astar, &cost, task.request());
        let (start, arcs) = hybrid_astar(&problem.with_soft_costs(costs), limits)?;
        Ok(task.driven(start, &arcs))
    }
}
