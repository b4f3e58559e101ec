//! The colony of Wang et al. 2019.

use crate::colony::config::{AdjacentGoal, ColonyConfig, TrailLayout};
use crate::colony::corridor::Corridor;
use crate::colony::dead_end::DeadEnd;
use crate::colony::deposit::{BestWorst, Deposit};
use crate::colony::directions::Directions;
use crate::colony::evaporation::{Constant, Evaporation};
use crate::colony::heuristic::{GoalDistance, GoalFieldGuidance, Guidance, Visibility};
use crate::colony::initial::{InitialPheromone, PheromoneUnit, Uniform};
use crate::colony::limits::{Floor, PheromoneLimits};
use crate::colony::stopping::Stopping;
use crate::colony::transition::Transition;
use crate::map::DiagonalRule;
use crate::objective::PathCost;

/// Wang et al. 2019: no diagonal step between two obstacles, guidance by the shortest way to the
/// goal, and an update that strengthens the best way and weakens the worst.
pub fn wang2019() -> ColonyConfig {
    ColonyConfig {
        n_ants: 30,
        n_iterations: 200,
        alpha: 1.0,
        directions: Directions::Eight,
        diagonal_rule: DiagonalRule::AtMostOneObstacle,
        adjacent_goal: AdjacentGoal::Weighed,
        corridor: Corridor::None,
        trails: TrailLayout::Edges,
        cost: PathCost::default(),
        visibility: Visibility::GoalDistance(GoalDistance {
            beta: 7.0,
            floor_cells: 0.5,
        }),
        guidance: Guidance::GoalField(GoalFieldGuidance {
            gamma: 3.0,
            floor_cells: 0.5,
        }),
        initial: InitialPheromone::Uniform(Uniform {
            tau: 8.0,
            unit: PheromoneUnit::Absolute,
        }),
        transition: Transition::Roulette,
        dead_end: DeadEnd::Die,
        evaporation: Evaporation::Constant(Constant { rho: 0.43 }),
        deposit: Deposit::BestWorst(BestWorst { q: 100.0 }),
        limits: PheromoneLimits::Floor(Floor { share: 1e-3 }),
        stopping: Stopping::default(),
    }
}
