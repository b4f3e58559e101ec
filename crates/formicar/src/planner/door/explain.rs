//! Failures that explain themselves.

use crate::numeric::counted;
use crate::planner::{Explanation, Gap, Task};
use crate::progress::{Limits, Status};
use crate::scenario::{GoalHeading, Request};
use crate::search::{Passage, widest_passage_while};
use crate::vehicle::Gears;

/// Why a search ended without a path: as a sentence, and in numbers; of no use once the query is
/// cancelled.
pub(super) fn explain(task: &Task, status: Status, limits: &mut Limits) -> (String, Explanation) {
    let n_steps = limits.n_steps();
    let gap = match status {
        Status::NoPath | Status::BudgetExhausted => narrowest_place(task, limits),
        // Whoever cancels or has no time left waits for nothing.
        Status::Found | Status::Infeasible | Status::TimedOut | Status::Cancelled => None,
    };
    let steps = counted(n_steps, "step");
    let sentence = match status {
        Status::NoPath => match passable(gap.as_ref()) {
            Ok(gap) => turning_fails(task, gap, &steps),
            Err(sentence) => sentence,
        },
        Status::BudgetExhausted => {
            let rest = match passable(gap.as_ref()) {
                Ok(gap) => out_of_steps(task, gap, n_steps),
                Err(sentence) => sentence,
            };
            format!("no path within {steps}, which proves nothing; {rest}")
        }
        Status::TimedOut => {
            let deadline = task.request().deadline;
            let deadline_ms = deadline.map_or(0.0, |d| d.as_secs_f64() * 1e3);
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

fn turning_fails(task: &Task, gap: &Gap, steps: &str) -> String {
    format!(
        "{} searched all it can reach ({steps}); {}, so turning is what fails on its lattice, which does not prove that there is no path; hint: {}; {}",
        task.planner(),
        gap.in_words(),
        relaxations(task.request()),
        task.search.hints().turning
    )
}

/// What the request demands and need not.
fn relaxations(request: &Request) -> String {
    let reverse = match request.gears {
        Gears::Forward => "allow reverse, ",
        Gears::Both => "",
    };
    let headings = match request.goal_heading {
        GoalHeading::Exact => "allow other headings at the goal or ",
        GoalHeading::Bidirectional => "allow any heading at the goal or ",
        GoalHeading::Any => "",
    };
    format!("{reverse}{headings}widen the goal tolerance")
}

/// The hint for a search that more steps might help.
fn out_of_steps(task: &Task, gap: &Gap, n_steps: u64) -> String {
    let hint = match task.request().budget_steps {
        Some(budget) if n_steps >= budget => "raise the budget",
        _ => task.search.hints().own_limit,
    };
    format!("{}; hint: {hint}", gap.in_words())
}

/// The narrowest place on the widest way of a request, to whichever of its goals; none where
/// obstacles separate them.
fn narrowest_place(task: &Task, limits: &mut Limits) -> Option<Gap> {
    let frame = task.obstacles().frame();
    let from = frame.cell_at(task.request().start.position())?;
    let goals = task.request().goals();
    let cells = goals.filter_map(|goal| frame.cell_at(goal.position()));
    let distance = task.obstacles().distance();
    let mut goes_on = || !limits.is_cancelled();
    let ways = cells.filter_map(|to| widest_passage_while(distance, [from, to], &mut goes_on));
    let widest = ways.max_by(|a, b| a.distance_cells.total_cmp(&b.distance_cells))?;
    Some(gap_of(task, &widest))
}

/// The narrowest place of a passage.
pub(super) fn gap_of(task: &Task, passage: &Passage) -> Gap {
    let frame = task.obstacles().frame();
    let place = frame.center(passage.narrowest);
    Gap {
        x: place.x,
        y: place.y,
        gap_m: width_cells(task, passage) * frame.resolution_m(),
        vehicle_width_m: task.vehicle().width_m(),
    }
}

/// Width of a passage at its narrowest place, cells: the free run along the row or the column
/// there, exact between walls along these, or less where obstacles lie aslant. Among several
/// passages with equal least distances one is measured.
fn width_cells(task: &Task, passage: &Passage) -> f64 {
    let (frame, lethal) = (task.obstacles().frame(), task.obstacles().lethal());
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
    let disc = passage.widest_disc_cells(task.obstacles().distance());
    disc.unwrap_or(f64::INFINITY).min(across as f64)
}

/// The narrowest place of the widest way, where the vehicle may pass it.
///
/// # Errors
/// As a sentence, that it may not: there is no way, or it is too narrow.
pub(super) fn passable(gap: Option<&Gap>) -> Result<&Gap, String> {
    let Some(gap) = gap else {
        return Err("obstacles separate start and goal: no way leads from one to the other, however thin the vehicle".to_owned());
    };
    let Gap {
        x,
        y,
        gap_m,
        vehicle_width_m,
    } = gap;
    if gap_m < vehicle_width_m {
        return Err(format!(
            "the widest way from start to goal narrows to about {gap_m:.2} m at ({x:.2}, {y:.2}); the vehicle is {vehicle_width_m:.2} m wide"
        ));
    }
    Ok(gap)
}

impl Gap {
    /// As the narrowest place of the widest way.
    fn in_words(&self) -> String {
        let Self {
            x,
            y,
            gap_m,
            vehicle_width_m,
        } = self;
        format!(
            "the widest way is about {gap_m:.2} m at its narrowest, ({x:.2}, {y:.2}), the vehicle {vehicle_width_m:.2} m wide"
        )
    }
}
