//! Failures that explain themselves.

use super::{Explanation, Gap, Planner, PlannerName};
use crate::progress::Status;
use crate::scenario::Request;
use crate::search::{Passage, widest_passage};

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
        let Some((passage, gap)) = self.passage(request) else {
            return "an end lies off the map".to_owned();
        };
        if let (Some(sentence), _) = self.explain_passage(passage.as_ref()) {
            return sentence;
        }
        let Some(Gap { x, y, gap_m, .. }) = gap else {
            return Status::NoPath.name().to_owned();
        };
        let width_m = self.vehicle.width_m();
        let planner = self.config.planner;
        let hint = match planner {
            PlannerName::HybridAstar => {
                "hint: allow reverse, other headings or a wider goal tolerance; a smaller hybrid_astar.step_radii searches a finer lattice"
            }
            _ => "hint: hybrid-astar uses the true footprint",
        };
        format!(
            "{} searched all it can reach ({n_steps} steps); the widest way is about {gap_m:.2} m at its narrowest, ({x:.2}, {y:.2}), the vehicle {width_m:.2} m wide, so turning is what fails; {hint}",
            planner.name(),
        )
    }

    /// What a search that looked at all it can reach tells in numbers: the narrowest place.
    pub(super) fn explanation(&self, request: &Request, status: Status) -> Explanation {
        let gap = match status {
            Status::NoPath => self.passage(request).and_then(|(_, gap)| gap),
            _ => None,
        };
        Explanation {
            gap,
            ..Explanation::default()
        }
    }

    /// The widest way from start to goal, if there is one, and its narrowest place.
    fn passage(&self, request: &Request) -> Option<(Option<Passage>, Option<Gap>)> {
        let frame = self.obstacles.frame();
        let from = frame.cell_at(request.start.position())?;
        let to = frame.cell_at(request.goal.position())?;
        let passage = widest_passage(self.obstacles.distance(), from, to);
        let gap = passage.as_ref().map(|passage| self.gap(passage));
        Some((passage, gap))
    }

    /// What a way says by itself: that there is none, or that it is too narrow; and its narrowest
    /// place.
    pub(super) fn explain_passage(
        &self,
        passage: Option<&Passage>,
    ) -> (Option<String>, Option<Gap>) {
        let Some(passage) = passage else {
            let sentence = "obstacles separate start and goal: no way leads from one to the other, however thin the vehicle";
            return (Some(sentence.to_owned()), None);
        };
        let gap = self.gap(passage);
        let sentence = (gap.gap_m < gap.vehicle_width_m).then(|| {
            format!(
                "the widest way from start to goal narrows to about {:.2} m at ({:.2}, {:.2}); the vehicle is {:.2} m wide",
                gap.gap_m, gap.x, gap.y, gap.vehicle_width_m
            )
        });
        (sentence, Some(gap))
    }

    fn gap(&self, passage: &Passage) -> Gap {
        let frame = self.obstacles.frame();
        let place = frame.center(passage.narrowest);
        Gap {
            x: place.x,
            y: place.y,
            gap_m: (2.0 * passage.distance_cells - 1.0) * frame.resolution_m(),
            vehicle_width_m: self.vehicle.width_m(),
        }
    }
}
