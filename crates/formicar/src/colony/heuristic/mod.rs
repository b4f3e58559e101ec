//! Heuristics: the attraction of cells besides pheromone.
//!
//! Rules add logarithms of their factors, by cell and by step: products of powers neither
//! overflow nor vanish that way, and an ant compares the cells around it alone.

mod advantage;
mod goal_distance;
mod goal_field;
mod step_length;

pub use advantage::Advantage;
pub use goal_distance::GoalDistance;
pub use goal_field::GoalFieldGuidance;
pub use step_length::StepLength;

use super::ColonyProblem;
use crate::parameters::rules;

rules! {
    /// What an ant sees of a cell: eta to the power of beta.
    #[derive(Default)]
    pub enum Visibility {
        /// Nothing.
        #[default]
        None,
        /// How near it lies to the goal in a straight line.
        GoalDistance(GoalDistance),
        /// How short the step to it is.
        StepLength(StepLength),
    }
}

rules! {
    /// What an ant knows of the way from a cell to the goal, obstacles included.
    #[derive(Default)]
    pub enum Guidance {
        /// Nothing.
        #[default]
        None,
        /// The length of the shortest way.
        GoalField(GoalFieldGuidance),
        /// How much of it a step saves.
        Advantage(Advantage),
    }
}

impl Visibility {
    pub(super) fn add_to(&self, desire: &mut LogDesire, problem: &ColonyProblem, cells: &[u32]) {
        match self {
            Self::None => {}
            Self::GoalDistance(rule) => rule.add_to(desire, problem, cells),
            Self::StepLength(rule) => rule.add_to(desire),
        }
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

    pub(super) fn add_to(&self, desire: &mut LogDesire, costs_to_go: &[f64]) {
        match self {
            Self::None => {}
            Self::GoalField(rule) => rule.add_to(desire, costs_to_go),
            Self::Advantage(rule) => rule.add_to(desire, costs_to_go),
        }
    }
}

/// Logarithms of the factors by which an ant favors cells and steps.
#[derive(Clone, Debug)]
pub(super) struct LogDesire {
    /// By number of the cell.
    pub(super) cells: Vec<f64>,
    /// By place in [`STEPS`](crate::map::STEPS).
    pub(super) steps: [f64; 8],
}

/// Length of each of [`STEPS`](crate::map::STEPS) in cells.
pub(super) fn step_length(step: usize) -> f64 {
    if step.is_multiple_of(2) {
        1.0
    } else {
        std::f64::consts::SQRT_2
    }
}
