//! Every parameter of a colony.

use super::corridor::Corridor;
use super::dead_end::DeadEnd;
use super::deposit::Deposit;
use super::directions::Directions;
use super::evaporation::Evaporation;
use super::heuristic::{Guidance, Visibility};
use super::initial::InitialPheromone;
use super::limits::PheromoneLimits;
use super::stopping::Stopping;
use super::transition::Transition;
use crate::map::DiagonalRule;
use crate::objective::PathCost;
use crate::parameters::{OutOfRange, Parameters, parameters};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

parameters! {
    /// A colony: its size, where its ants may go, and a rule for each slot.
    ///
    /// The default is the Ant System, [`presets::ant_system`](super::presets::ant_system).
    pub struct ColonyConfig where check_evaporation {
        /// M: ants of each iteration.
        #[range(1..=1_000_000)]
        pub n_ants: u32,
        /// N: iterations at most.
        #[range(1..=1_000_000)]
        pub n_iterations: u32,
        /// α: exponent of the pheromone.
        #[range(0.0..=10.0)]
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

impl Parameters for AdjacentGoal {}

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

impl Parameters for TrailLayout {}

impl ColonyConfig {
    fn check_evaporation(&self) -> Result<(), OutOfRange> {
        let checked = self.evaporation.check_run(self.n_iterations);
        checked.map_err(|error| error.within("evaporation"))
    }
}
