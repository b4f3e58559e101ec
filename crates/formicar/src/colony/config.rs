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
        /// The diagonal steps that are allowed beside obstacles.
        pub diagonal_rule: DiagonalRule,
        /// Behavior of an ant beside the goal.
        pub adjacent_goal: AdjacentGoal,
        /// The cells on which ants may step.
        pub corridor: Corridor,
        /// Layout of pheromone: on cells or on steps.
        pub trails: TrailLayout,
        /// Cost of a path.
        pub cost: PathCost,
        /// Visibility of a cell.
        pub visibility: Visibility,
        /// Guidance by the distance to the goal.
        pub guidance: Guidance,
        /// Pheromone before the first iteration.
        pub initial: InitialPheromone,
        /// Choice of the next cell.
        pub transition: Transition,
        /// Behavior of an ant at a dead end.
        pub dead_end: DeadEnd,
        /// Evaporation of pheromone.
        pub evaporation: Evaporation,
        /// Deposits of pheromone.
        pub deposit: Deposit,
        /// Limits of pheromone.
        pub limits: PheromoneLimits,
        /// Conditions to stop before the last iteration.
        pub stopping: Stopping,
    }
}

/// The behavior of an ant beside the goal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum AdjacentGoal {
    /// It goes there.
    #[default]
    Taken,
    /// It weighs the goal like any other cell.
    Weighed,
}

impl Parameters for AdjacentGoal {}

/// The layout of pheromone.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
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
