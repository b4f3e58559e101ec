//! Failures that explain themselves.

use super::{Planner, PlannerName};
use crate::progress::Status;
use crate::scenario::Request;
use crate::search::widest_passage;

impl Planner {
    /// Why a search ended without a path, as a sentence.
    pub(super) fn explain(&self, request: &Request, status: Status, n_steps: u64) -> String {
        let deadline_ms = request.deadline.map_or(0.0, |d| d.as_secs_f64() * 1e3);
        match status {
            Status::NoPath => self.explain_no_path(request, n_steps),
            Status::BudgetExhausted => {
                let hint = match self.config.planner {
                    PlannerName::HybridAstar => "raise the budget and hybrid_astar.max_iterations",
                    _ => "raise the budget",
                };
                format!("no path within {n_steps} steps; hint: {hint}")
            }
            Status::TimedOut => format!(
                "no path within the deadline of {deadline_ms:.1} ms ({n_steps} steps); hint: raise it"
            ),
            Status::Cancelled => format!("cancelled after {n_steps} steps"),
            Status::Found | Status::Infeasible => status.name().to_owned(),
        }
    }

    fn explain_no_path(&self, request: &Request, n_steps: u64) -> String {
        let frame = self.obstacles.frame();
        let ends = (
            frame.cell_at(request.start.position()),
            frame.cell_at(request.goal.position()),
        );
        let (Some(from), Some(to)) = ends else {
            return "an end lies off the map".to_owned();
        };
        let Some(passage) = widest_passage(self.obstacles.distance(), from, to) else {
            return "obstacles separate start and goal: no way leads from one to the other, however thin the vehicle".to_owned();
        };
        let width_m = self.vehicle.width_m();
        let gap_m = (2.0 * passage.distance_cells - 1.0) * frame.resolution_m();
        let place = frame.center(passage.narrowest);
        if gap_m < width_m {
            return format!(
                "the widest way from start to goal narrows to about {gap_m:.2} m at ({:.2}, {:.2}); the vehicle is {width_m:.2} m wide",
                place.x, place.y
            );
        }
        let planner = self.config.planner;
        let hint = match planner {
            PlannerName::HybridAstar => {
                "hint: allow reverse, other headings or a wider goal tolerance; a smaller hybrid_astar.step_radii searches a finer lattice"
            }
            _ => "hint: hybrid-astar uses the true footprint",
        };
        format!(
            "{} searched all it can reach ({n_steps} steps); the widest way is about {gap_m:.2} m at its narrowest, ({:.2}, {:.2}), the vehicle {width_m:.2} m wide, so turning is what fails; {hint}",
            planner.name(),
            place.x,
            place.y
        )
    }
}
