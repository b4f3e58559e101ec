//! What a run of a colony came to.

use crate::path::GridPath;
use crate::progress::{IterationRecord, Status};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The iterations of a run in their order.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct History {
    /// What each came to.
    pub iterations: Vec<IterationRecord>,
}

impl History {
    /// The iteration that brought the best path, counted from 1: after so many the colony had
    /// converged. None if no ant arrived.
    pub fn converged_after(&self) -> Option<u32> {
        let last = self.iterations.last()?.best_so_far_cost?;
        let first = self
            .iterations
            .iter()
            .find(|record| record.best_so_far_cost == Some(last))?;
        Some(first.iteration + 1)
    }
}

/// Why a colony stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Stop {
    /// All iterations are done.
    Iterations,
    /// No better path for as many iterations as allowed.
    Stall,
    /// A path is as good as was asked for.
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

    /// How a run without a path ended.
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

/// What a run of a colony came to.
#[derive(Clone, Debug)]
pub struct ColonyRun {
    /// The cheapest path of all ants; none if none arrived.
    pub best: Option<GridPath>,
    /// The paths that were the cheapest before it, the latest first; kept by colonies that step
    /// by chords.
    pub earlier: Vec<GridPath>,
    /// All iterations.
    pub history: History,
    /// Why it stopped.
    pub stop: Stop,
    /// Pheromone at the end by cell, row by row; not a number where no ant can go.
    pub pheromone: Vec<f32>,
}
