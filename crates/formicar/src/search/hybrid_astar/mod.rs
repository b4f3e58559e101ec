//! Hybrid A* (Dolgov, Thrun, Montemerlo & Diebel 2010): A* over motion primitives on an absolute
//! heading lattice, guided by a goal field and by obstacle-free curves, ended by a curve that
//! hits the goal pose.
//!
//! Positions stay continuous; a state is the lattice cell and heading they fall into. Whether a
//! motion is free is asked when its state comes up, not when it is put on the list: most never
//! come up.

mod open_list;
mod search;
mod state_costs;
mod tree;

pub use search::HybridSearch;

use super::drive::{DriveProblem, Driven, Guide, Inflation};
use crate::progress::{Limits, Status};

/// Searches a drivable chain of arcs from start to goal, in grid coordinates.
///
/// A step of the limits is a motion taken from the open list. The result is the start pose and the
/// arcs; whether it is certified is the judge's to say.
///
/// # Errors
/// The status to end with: no path on the lattice, budget, deadline or cancel.
pub fn hybrid_astar(problem: &DriveProblem, limits: &mut Limits) -> Result<Driven, Status> {
    // Others may have used the same limits before.
    let n_before = limits.n_steps();
    let most_steps = problem.config().max_iterations;
    for stage in Stage::ladder(problem) {
        let left = most_steps.saturating_sub(limits.n_steps() - n_before);
        if left == 0 {
            return Err(Status::BudgetExhausted);
        }
        let Some(mut guide) = Guide::new(&stage.problem, stage.inflation, limits)? else {
            continue;
        };
        let mut search = HybridSearch::new(&stage.problem, &mut guide, limits)?;
        match search.run(&mut guide, stage.patience_steps.min(left), limits) {
            Ok(Some(path)) => return Ok(path),
            Ok(None) | Err(Status::NoPath) => {}
            Err(status) => return Err(status),
        }
    }
    if limits.n_steps() - n_before >= most_steps {
        Err(Status::BudgetExhausted)
    } else {
        Err(Status::NoPath)
    }
}

/// Steps after which, at first, the next side or lattice is tried; most queries need fewer.
const SHORT_PATIENCE: u64 = 4_000;
/// Steps on the refined lattice, where a state costs more,
const MIDDLE_PATIENCE: u64 = 20_000;
/// and then on that of the map again.
const LONG_PATIENCE: u64 = 50_000;

/// A search, and how long it may take.
pub struct Stage<'a> {
    /// The lattice and the side it begins from.
    pub problem: DriveProblem<'a>,
    /// The guide's radius.
    pub inflation: Inflation,
    /// Steps after which the next stage is tried.
    pub patience_steps: u64,
}

impl<'a> Stage<'a> {
    /// The searches to try, one after the other; on the refined lattice, one.
    ///
    /// A guide that leads astray, a tight place at the other end or one that only shunting leaves
    /// must not cost all the time there is: each lattice is tried from either end for a short
    /// while, then longer, and without bound only at the end.
    pub fn ladder(problem: &DriveProblem<'a>) -> impl Iterator<Item = Self> + use<'a> {
        use Inflation::{Roomy, Sure, Turning, Wide};
        let (coarse, exact, fine) = (problem.clone(), problem.exact(), problem.refined());
        let from_goal = problem.swapped();
        let (exact_from_goal, fine_from_goal) = (exact.swapped(), fine.swapped());
        // Who seeks the cheapest path is not served by another lattice's first one: the long turn
        // comes at once, and not again.
        let is_patient = problem.seeks_cheapest();
        let patience = if is_patient {
            LONG_PATIENCE
        } else {
            SHORT_PATIENCE
        };
        let again = |problem: Option<DriveProblem<'a>>| problem.filter(|_| !is_patient);
        let roomy = problem.keeps_clearance().then(|| coarse.clone());
        let stages = if problem.is_refined() {
            vec![(Some(fine), Wide, u64::MAX)]
        } else {
            vec![
                (roomy, Roomy, LONG_PATIENCE),
                (Some(coarse.clone()), Turning, patience),
                (from_goal.clone(), Turning, patience),
                (Some(exact.clone()), Wide, patience),
                (Some(fine.clone()), Wide, SHORT_PATIENCE),
                (fine_from_goal.clone(), Wide, SHORT_PATIENCE),
                (Some(fine.clone()), Wide, MIDDLE_PATIENCE),
                (fine_from_goal, Wide, MIDDLE_PATIENCE),
                (again(Some(coarse)), Turning, LONG_PATIENCE),
                (again(from_goal), Turning, LONG_PATIENCE),
                (again(Some(exact.clone())), Wide, LONG_PATIENCE),
                (exact_from_goal, Wide, LONG_PATIENCE),
                (Some(exact), Sure, 10 * LONG_PATIENCE),
                (Some(fine), Sure, u64::MAX),
            ]
        };
        stages
            .into_iter()
            .filter_map(|(problem, inflation, patience_steps)| {
                Some(Self {
                    problem: problem?,
                    inflation,
                    patience_steps,
                })
            })
    }
}
