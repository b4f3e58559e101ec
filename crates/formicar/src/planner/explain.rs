//! Failures that explain themselves.

use super::{Explanation, Gap, Planner, PlannerName};
use crate::progress::Status;
use crate::scenario::Request;
use crate::search::{Passage, widest_passage};

/// The widest way from start to goal, if there is one, and its narrowest place.
type Way = (Option<Passage>, Option<Gap>);

impl Planner {
    /// Why a search ended without a path: as a sentence, and in numbers.
    pub(super) fn explain(
        &self,
        request: &Request,
        status: Status,
        n_steps: u64,
    ) -> (String, Explanation) {
        let way = match status {
            Status::NoPath | Status::BudgetExhausted | Status::TimedOut => self.passage(request),
            // Who cancels waits for nothing.
            _ => None,
        };
        let deadline_ms = request.deadline.map_or(0.0, |d| d.as_secs_f64() * 1e3);
        let gap = way.as_ref().and_then(|way| way.1);
        let narrowest = gap.as_ref().map_or(String::new(), narrowest);
        let sentence = match status {
            Status::NoPath => self.explain_no_path(way, &narrowest, n_steps),
            Status::BudgetExhausted => {
                let hint = match self.config.planner {
                    PlannerName::HybridAstar => "raise the budget and hybrid_astar.max_iterations",
                    _ => "raise the budget",
                };
                format!("no path within {n_steps} steps{narrowest}; hint: {hint}")
            }
            Status::TimedOut => format!(
                "no path within the deadline of {deadline_ms:.1} ms ({n_steps} steps){narrowest}; hint: raise it"
            ),
            Status::Cancelled => format!("cancelled after {n_steps} steps"),
            Status::Found | Status::Infeasible => status.name().to_owned(),
        };
        let explanation = Explanation {
            gap,
            ..Explanation::default()
        };
        (sentence, explanation)
    }

    fn explain_no_path(&self, way: Option<Way>, narrowest: &str, n_steps: u64) -> String {
        let Some((passage, _)) = way else {
            return "an end lies off the map".to_owned();
        };
        if let (Some(sentence), _) = self.explain_passage(passage.as_ref()) {
            return sentence;
        }
        let planner = self.config.planner;
        let hint = match planner {
            PlannerName::HybridAstar => {
                "hint: allow reverse, other headings or a wider goal tolerance; a smaller hybrid_astar.step_radii searches a finer lattice"
            }
            _ => "hint: hybrid-astar uses the true footprint",
        };
        format!(
            "{} searched all it can reach ({n_steps} steps){narrowest}, so turning is what fails; {hint}",
            planner.name(),
        )
    }

    /// The widest way of a request; none where an end lies off the map.
    fn passage(&self, request: &Request) -> Option<Way> {
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

/// The narrowest place of the widest way, as a clause.
fn narrowest(gap: &Gap) -> String {
    format!(
        "; the widest way is about {:.2} m at its narrowest, ({:.2}, {:.2}), the vehicle {:.2} m wide",
        gap.gap_m, gap.x, gap.y, gap.vehicle_width_m
    )
}
