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

/// Steps after which, usually, the next guide, side or lattice is tried.
const PATIENCE_STEPS: u64 = 50_000;

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
    /// The searches to try, one after the other.
    ///
    /// A guide that leads astray, or a tight place at the other end, must not cost all the time
    /// there is: patience is short where hope is small, and unbounded only at the end.
    pub fn ladder(problem: &DriveProblem<'a>) -> impl Iterator<Item = Self> + use<'a> {
        use Inflation::{Roomy, Sure, Turning, Wide};
        let (coarse, exact, fine) = (problem.clone(), problem.exact(), problem.refined());
        let from_goal = problem.swapped();
        let (exact_from_goal, fine_from_goal) = (exact.swapped(), fine.swapped());
        let roomy = problem.keeps_clearance().then(|| coarse.clone());
        let stages = [
            (roomy, Roomy, PATIENCE_STEPS),
            (Some(coarse.clone()), Turning, PATIENCE_STEPS),
            (from_goal, Turning, PATIENCE_STEPS),
            (Some(exact.clone()), Wide, PATIENCE_STEPS),
            (Some(fine.clone()), Wide, PATIENCE_STEPS / 10),
            (fine_from_goal.clone(), Wide, PATIENCE_STEPS / 10),
            (exact_from_goal, Wide, PATIENCE_STEPS),
            (fine_from_goal, Wide, PATIENCE_STEPS),
            (Some(fine.clone()), Wide, PATIENCE_STEPS),
            (Some(exact), Sure, 10 * PATIENCE_STEPS),
            (Some(fine), Sure, u64::MAX),
        ];
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
