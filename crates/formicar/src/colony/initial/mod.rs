//! Pheromone before the first iteration.

mod line_gradient;
mod uniform;

pub use line_gradient::LineGradient;
pub use uniform::Uniform;

use crate::map::Cell;
use crate::numeric::OutOfRange;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Pheromone before the first iteration.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "rule", rename_all = "kebab-case")]
pub enum InitialPheromone {
    /// The same everywhere.
    Uniform(Uniform),
    /// Most on the line from start to goal.
    LineGradient(LineGradient),
}

/// What a unit of initial pheromone is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PheromoneUnit {
    /// One.
    #[default]
    Absolute,
    /// What an iteration deposits on the way that all ants take if no obstacle stands between
    /// start and goal, so that the first deposits do not swamp it.
    Deposit,
}

impl InitialPheromone {
    pub(super) fn check(&self) -> Result<(), OutOfRange> {
        match self {
            Self::Uniform(rule) => rule.check(),
            Self::LineGradient(rule) => rule.check(),
        }
    }

    pub(super) fn unit(&self) -> PheromoneUnit {
        match self {
            Self::Uniform(rule) => rule.unit,
            Self::LineGradient(rule) => rule.unit,
        }
    }

    /// Pheromone by cell, row by row, in the rule's unit.
    pub(super) fn values(&self, (n_cols, n_rows): (usize, usize), ends: [Cell; 2]) -> Vec<f64> {
        match self {
            Self::Uniform(rule) => vec![rule.tau; n_cols * n_rows],
            Self::LineGradient(rule) => rule.values((n_cols, n_rows), ends),
        }
    }
}
