//! Failures that explain themselves.

use super::{Explanation, Gap, Planner, PlannerName};
use crate::map::Cell;
use crate::progress::Status;
use crate::scenario::Request;
use crate::search::{Passage, widest_passage};
use std::f64::consts::SQRT_2;

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
            Status::NoPath | Status::BudgetExhausted => self.widest_way(request),
            // Whoever cancels or has no time left waits for nothing.
            _ => None,
        };
        let gap = way.as_ref().and_then(|way| way.1);
        let steps = steps_in_words(n_steps);
        let sentence = match status {
            Status::NoPath => self.explain_no_path(way, n_steps),
            Status::BudgetExhausted => explain_budget(request, gap.as_ref(), n_steps),
            Status::TimedOut => {
                let deadline_ms = request.deadline.map_or(0.0, |d| d.as_secs_f64() * 1e3);
                format!("no path within the deadline of {deadline_ms} ms ({steps}); hint: raise it")
            }
            Status::Cancelled => format!("cancelled after {steps}"),
            Status::Found | Status::Infeasible => status.name().to_owned(),
        };
        let explanation = Explanation {
            gap,
            ..Explanation::default()
        };
        (sentence, explanation)
    }

    fn explain_no_path(&self, way: Option<Way>, n_steps: u64) -> String {
        let Some((passage, gap)) = way else {
            return "an end lies off the map".to_owned();
        };
        if let (Some(sentence), _) = self.explain_passage(passage.as_ref()) {
            return sentence;
        }
        let (planner, steps) = (self.config.planner, steps_in_words(n_steps));
        let hint = match planner {
            PlannerName::Formicar | PlannerName::HybridAstar => {
                "hint: allow reverse, other headings or a wider goal tolerance; a smaller hybrid_astar.step_radii searches a finer lattice"
            }
            _ => "hint: formicar and hybrid-astar use the true footprint",
        };
        format!(
            "{} searched all it can reach ({steps}){}, so turning is what fails; {hint}",
            planner.name(),
            gap.as_ref().map_or(String::new(), narrowest)
        )
    }

    /// The widest way of a request, to whichever of its goals; none where an end lies off the map.
    fn widest_way(&self, request: &Request) -> Option<Way> {
        let frame = self.obstacles.frame();
        let from = frame.cell_at(request.start.position())?;
        let cells = request.goals().map(|goal| frame.cell_at(goal.position()));
        let cells: Option<Vec<Cell>> = cells.collect();
        let ways = cells?.into_iter();
        let ways = ways.filter_map(|to| widest_passage(self.obstacles.distance(), from, to));
        let widest = ways.max_by(|a, b| a.distance_cells.total_cmp(&b.distance_cells));
        let gap = widest.as_ref().map(|passage| self.gap(passage));
        Some((widest, gap))
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
        (gap.too_narrow(), Some(gap))
    }

    fn gap(&self, passage: &Passage) -> Gap {
        let frame = self.obstacles.frame();
        let place = frame.center(passage.narrowest);
        Gap {
            x: place.x,
            y: place.y,
            gap_m: self.passage_cells(passage) * frame.resolution_m(),
            vehicle_width_m: self.vehicle.width_m(),
        }
    }

    /// How wide a way is where it is narrowest, in cells: the free run along the row or the column
    /// there, exact between walls along these, or less where obstacles lie aslant.
    ///
    /// The middle of the cell in which the middle of a disc lies is at most half a diagonal away
    /// from it, and that of an obstacle cell lies half a side behind the obstacle's side. Of several
    /// ways with equal least distances one is measured.
    fn passage_cells(&self, passage: &Passage) -> f64 {
        let (frame, lethal) = (self.obstacles.frame(), self.obstacles.lethal());
        let (n_cols, n_rows) = (frame.n_cols() as i64, frame.n_rows() as i64);
        let [col, row] = [passage.narrowest.col, passage.narrowest.row].map(i64::from);
        let is_free = |col: i64, row: i64| {
            (0..n_cols).contains(&col) && (0..n_rows).contains(&row) && !lethal.contains(col, row)
        };
        let free = |dx: i64, dy: i64| {
            let cells = (1..).take_while(|i| is_free(col + i * dx, row + i * dy));
            cells.count()
        };
        let across = 1 + (free(1, 0) + free(-1, 0)).min(free(0, 1) + free(0, -1));
        let truncation_cells = self.obstacles.distance().truncation_cells();
        let aslant = if passage.distance_cells < f64::from(truncation_cells) {
            2.0 * passage.distance_cells - 1.0 + SQRT_2
        } else {
            f64::INFINITY
        };
        aslant.min(across as f64)
    }
}

impl Gap {
    /// That the vehicle does not fit, in words; none where it may.
    fn too_narrow(&self) -> Option<String> {
        (self.gap_m < self.vehicle_width_m).then(|| {
            format!(
                "the widest way from start to goal narrows to about {:.2} m at ({:.2}, {:.2}); the vehicle is {:.2} m wide",
                self.gap_m, self.x, self.y, self.vehicle_width_m
            )
        })
    }
}

fn explain_budget(request: &Request, gap: Option<&Gap>, n_steps: u64) -> String {
    let steps = steps_in_words(n_steps);
    if let Some(sentence) = gap.and_then(Gap::too_narrow) {
        return format!("no path within {steps}; {sentence}");
    }
    let hint = match request.budget_steps {
        Some(budget) if n_steps >= budget => "raise the budget",
        _ => "raise hybrid_astar.max_iterations",
    };
    let narrowest = gap.map_or(String::new(), narrowest);
    format!("no path within {steps}{narrowest}; hint: {hint}")
}

/// A number of steps in words.
fn steps_in_words(n_steps: u64) -> String {
    let plural = if n_steps == 1 { "" } else { "s" };
    format!("{n_steps} step{plural}")
}

/// The narrowest place of the widest way, as a clause.
fn narrowest(gap: &Gap) -> String {
    format!(
        "; the widest way is about {:.2} m at its narrowest, ({:.2}, {:.2}), the vehicle {:.2} m wide",
        gap.gap_m, gap.x, gap.y, gap.vehicle_width_m
    )
}
