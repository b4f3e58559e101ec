//! The Ant System: the conventional colony of Lei & Zheng 2020.

use crate::colony::config::{AdjacentGoal, ColonyConfig, TrailLayout};
use crate::colony::corridor::Corridor;
use crate::colony::dead_end::DeadEnd;
use crate::colony::deposit::{AllAnts, Deposit};
use crate::colony::directions::Directions;
use crate::colony::evaporation::{Constant, Evaporation};
use crate::colony::heuristic::{GoalDistance, Guidance, Visibility};
use crate::colony::initial::{InitialPheromone, PheromoneUnit, Uniform};
use crate::colony::limits::PheromoneLimits;
use crate::colony::stopping::Stopping;
use crate::colony::transition::Transition;
use crate::map::DiagonalRule;
use crate::objective::PathCost;

impl Default for ColonyConfig {
    /// [`ant_system`].
    fn default() -> Self {
        ant_system()
    }
}

/// The Ant System (Dorigo, Maniezzo & Colorni 1996) with the size and the exponents that Lei &
/// Zheng 2020 use for all colonies: uniform pheromone, constant evaporation, one class of steps,
/// every ant deposits.
pub fn ant_system() -> ColonyConfig {
    ColonyConfig {
        n_ants: 500,
        n_iterations: 150,
        alpha: 1.0,
        directions: Directions::Eight,
        diagonal_rule: DiagonalRule::NoObstacles,
        adjacent_goal: AdjacentGoal::Taken,
        corridor: Corridor::None,
        trails: TrailLayout::Cells,
        cost: PathCost {
            length_weight: 1.0,
            diagonal_length: 1.4,
            turn_weight: 0.0,
        },
        visibility: Visibility::GoalDistance(GoalDistance {
            beta: 0.3,
            floor_cells: 1.0,
        }),
        guidance: Guidance::None,
        initial: InitialPheromone::Uniform(Uniform {
            tau: 1.0,
            unit: PheromoneUnit::Deposit,
        }),
        transition: Transition::Roulette,
        dead_end: DeadEnd::Die,
        evaporation: Evaporation::Constant(Constant { rho: 0.5 }),
        deposit: Deposit::AllAnts(AllAnts { q: 100.0 }),
        limits: PheromoneLimits::None,
        stopping: Stopping::default(),
    }
}
