//! The improved colony of Lei & Zheng 2020.

use super::ant_system;
use crate::colony::config::ColonyConfig;
use crate::colony::evaporation::{Evaporation, PoissonEvaporation};
use crate::colony::initial::{InitialPheromone, LineGradient, PheromoneUnit};
use crate::colony::transition::{GoalDirected, Transition};
use crate::objective::PathCost;

/// Lei & Zheng 2020: a gradient of pheromone about the line from start to goal, evaporation along
/// a Poisson distribution, steps towards the goal first, turns in the cost of a path.
///
/// 500 ants and 150 iterations, as for map 1 (21 x 21); for maps 2 and 3 (40 x 40) the paper takes
/// 1000 and 200.
pub fn lei2020() -> ColonyConfig {
    ColonyConfig {
        cost: PathCost {
            length_weight: 1.0,
            diagonal_length: 1.4,
            turn_weight: 0.5,
        },
        initial: InitialPheromone::LineGradient(LineGradient {
            tau_min: 1.0,
            tau_max: 2.0,
            unit: PheromoneUnit::Deposit,
        }),
        transition: Transition::GoalDirected(GoalDirected {}),
        evaporation: Evaporation::Poisson(PoissonEvaporation {
            lambda: 10.0,
            amplitude: -5.0,
            offset: 0.9,
            stretch: 1.0,
        }),
        ..ant_system()
    }
}
