//! The iterations of a run, and why it stopped.

use super::{IterationRecord, Limits, Status};

/// The iterations of a colony, or the generations of a population, in their order.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct History {
    /// One record per iteration.
    pub iterations: Vec<IterationRecord>,
}

impl History {
    /// Number of iterations until the best path was found; none if no path was found.
    pub fn converged_after(&self) -> Option<u32> {
        let last = self.iterations.last()?.best_so_far_cost?;
        let first = self
            .iterations
            .iter()
            .find(|record| record.best_so_far_cost == Some(last))?;
        Some(first.iteration + 1)
    }
}

/// Why a run of iterations stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Stop {
    /// All iterations are done.
    Iterations,
    /// No better path was found for the number of iterations that the configuration allows.
    Stall,
    /// A path is at least as good as the configuration asks for.
    TargetCost,
    /// The step budget ran out.
    Budget,
    /// The deadline passed.
    Deadline,
    /// The caller cancelled.
    Cancelled,
    /// No allowed steps lead to the goal.
    NoWay,
}

impl Stop {
    /// The limits within which the path of a run that has stopped is made drivable: at a deadline it
    /// is still worth it.
    pub(crate) fn limits_after<'a>(self, limits: &'a mut Limits<'_>) -> Limits<'a> {
        match self {
            Self::Deadline => limits.without_deadline(),
            _ => limits.without_budget(),
        }
    }

    /// The word used in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Iterations => "iterations",
            Self::Stall => "stall",
            Self::TargetCost => "target_cost",
            Self::Budget => "budget",
            Self::Deadline => "deadline",
            Self::Cancelled => "cancelled",
            Self::NoWay => "no_way",
        }
    }

    /// The reason of a run that the caller or the clock has ended.
    pub(crate) fn of_limit(status: Status) -> Self {
        match status {
            Status::Cancelled => Self::Cancelled,
            _ => Self::Deadline,
        }
    }

    /// The status of a run that stopped without a path.
    pub fn status(self) -> Status {
        match self {
            Self::NoWay => Status::NoPath,
            Self::Deadline => Status::TimedOut,
            Self::Cancelled => Status::Cancelled,
            Self::Iterations | Self::Stall | Self::TargetCost | Self::Budget => {
                Status::BudgetExhausted
            }
        }
    }
}

/// Runs iterations until one of them returns a reason to stop, the deadline passes, the caller
/// cancels, or `n_iterations` are done.
pub(crate) fn iterate<E>(
    n_iterations: u32,
    limits: &mut Limits,
    mut run_one: impl FnMut(u32, &mut Limits) -> Result<Option<Stop>, E>,
) -> Result<Stop, E> {
    for iteration in 0..n_iterations {
        if let Err(status) = limits.look() {
            return Ok(Stop::of_limit(status));
        }
        if let Some(stop) = run_one(iteration, limits)? {
            return Ok(stop);
        }
    }
    Ok(Stop::Iterations)
}
