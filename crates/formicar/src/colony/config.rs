//! Every parameter of a colony.

use super::corridor::Corridor;
use super::dead_end::DeadEnd;
use super::deposit::Deposit;
use super::directions::Directions;
use super::error::ColonyError;
use super::evaporation::Evaporation;
use super::heuristic::{Guidance, Visibility};
use super::initial::InitialPheromone;
use super::limits::PheromoneLimits;
use super::stopping::Stopping;
use super::transition::Transition;
use crate::map::DiagonalRule;
use crate::numeric::check_range;
use crate::objective::PathCost;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A colony: its size, where its ants may go, and a rule for each slot.
///
/// The default is the Ant System, [`presets::ant_system`](super::presets::ant_system).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ColonyConfig {
    /// M: ants in each iteration, from 1 to 1 000 000.
    #[schemars(range(min = 1, max = 1_000_000))]
    pub n_ants: u32,
    /// N: iterations at most, from 1 to 1 000 000.
    #[schemars(range(min = 1, max = 1_000_000))]
    pub n_iterations: u32,
    /// Weight of the pheromone as an exponent, from 0 to 10.
    #[schemars(range(min = 0.0, max = 10.0))]
    pub alpha: f64,
    /// Steps that an ant may take.
    pub directions: Directions,
    /// Which diagonal steps are allowed beside obstacles.
    pub diagonal_rule: DiagonalRule,
    /// What an ant does beside the goal.
    pub adjacent_goal: AdjacentGoal,
    /// On which cells ants may step.
    pub corridor: Corridor,
    /// What pheromone lies on.
    pub trails: TrailLayout,
    /// What a path costs.
    pub cost: PathCost,
    /// What an ant sees of a cell.
    pub visibility: Visibility,
    /// What an ant knows of the way to the goal.
    pub guidance: Guidance,
    /// Pheromone before the first iteration.
    pub initial: InitialPheromone,
    /// How the next cell is chosen.
    pub transition: Transition,
    /// What an ant does where no step is left.
    pub dead_end: DeadEnd,
    /// How pheromone evaporates.
    pub evaporation: Evaporation,
    /// Who deposits pheromone, and how much.
    pub deposit: Deposit,
    /// Between which limits pheromone is kept.
    pub limits: PheromoneLimits,
    /// When to stop before the last iteration.
    pub stopping: Stopping,
}

/// What an ant does beside the goal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum AdjacentGoal {
    /// It goes there.
    #[default]
    Taken,
    /// It weighs the goal like any other cell.
    Weighed,
}

/// What pheromone lies on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum TrailLayout {
    /// Cells.
    #[default]
    Cells,
    /// Steps from cell to cell; there and back are two.
    Edges,
}

impl ColonyConfig {
    /// Checks every parameter.
    ///
    /// # Errors
    /// The first parameter that is out of its range.
    pub fn check(&self) -> Result<(), ColonyError> {
        check_range("colony.n_ants", f64::from(self.n_ants), 1.0..=1e6)?;
        check_range(
            "colony.n_iterations",
            f64::from(self.n_iterations),
            1.0..=1e6,
        )?;
        check_range("colony.alpha", self.alpha, 0.0..=10.0)?;
        self.corridor.check()?;
        self.cost.check()?;
        self.visibility.check()?;
        self.guidance.check()?;
        self.initial.check()?;
        self.evaporation.check(self.n_iterations)?;
        self.deposit.check()?;
        self.limits.check()?;
        check_range(
            "colony.stopping.least_gain",
            self.stopping.least_gain,
            0.0..=1.0,
        )?;
        check_range(
            "colony.stopping.target_cost",
            self.stopping.target_cost,
            0.0..=f64::MAX,
        )?;
        Ok(())
    }
}
