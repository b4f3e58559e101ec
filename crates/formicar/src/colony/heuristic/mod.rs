//! Heuristics: the attraction of cells besides pheromone.
//!
//! Rules add logarithms of their factors, by cell and by step: products of powers neither
//! overflow nor vanish that way, and an ant compares the cells around it alone.

mod advantage;
mod desire;
mod goal_distance;
mod goal_field;
mod step_length;

pub use advantage::Advantage;
pub use goal_distance::GoalDistance;
pub use goal_field::GoalFieldGuidance;
pub use step_length::StepLength;

#[cfg(test)]
pub(super) use desire::step_length;

pub(super) use desire::LogDesire;

use super::ColonyProblem;
use crate::parameters::rules;
use crate::progress::{Limits, Status};

rules! {
    /// The visibility of a cell: eta to the power of beta.
    #[derive(Default)]
    pub enum Visibility {
        /// All cells alike.
        #[default]
        None,
        /// Nearness to the goal in a straight line.
        GoalDistance(GoalDistance),
        /// Shortness of the step to the cell.
        StepLength(StepLength),
    }
}

rules! {
    /// Guidance by the length of the shortest path to the goal around obstacles.
    #[derive(Default)]
    pub enum Guidance {
        /// No guidance.
        #[default]
        None,
        /// By the length of the shortest path.
        GoalField(GoalFieldGuidance),
        /// By the length that a step saves.
        Advantage(Advantage),
    }
}

impl Visibility {
    pub(super) fn add_to(
        &self,
        desire: &mut LogDesire,
        problem: &ColonyProblem,
        cells: &[u32],
        limits: &mut Limits,
    ) -> Result<(), Status> {
        match self {
            Self::None => {}
            Self::GoalDistance(rule) => rule.add_to(desire, problem, cells, limits)?,
            Self::StepLength(rule) => rule.add_to(desire),
        }
        Ok(())
    }
}

impl Guidance {
    /// The logarithm of the factor for a step of a length that changes the way to go, all in
    /// cells.
    #[inline]
    pub(super) fn log_factor(&self, step: f64, [before, after]: [f64; 2]) -> f64 {
        match self {
            Self::None => 0.0,
            Self::GoalField(rule) => rule.log_factor(after),
            Self::Advantage(rule) => -rule.beta * (step + after - before),
        }
    }

    pub(super) fn add_to(
        &self,
        desire: &mut LogDesire,
        costs_to_go: &[f64],
        limits: &mut Limits,
    ) -> Result<(), Status> {
        match self {
            Self::None => {}
            Self::GoalField(rule) => rule.add_to(desire, costs_to_go, limits)?,
            Self::Advantage(rule) => rule.add_to(desire, costs_to_go),
        }
        Ok(())
    }
}
