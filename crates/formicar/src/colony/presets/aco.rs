//! The Ant System that Li et al. 2024 compare with.

use super::ant_system;
use crate::colony::config::ColonyConfig;
use crate::colony::corridor::{Corridor, RatioCorridor};
use crate::colony::heuristic::{Advantage, Guidance};

/// The "ACO" of Li 2024, Table 2: the Ant System with 50 ants and 50 generations.
///
/// Ants that see the straight distance alone do not arrive on maps of hundreds of cells. Here they
/// know what a step saves of the way to the goal, and keep to a corridor about the shortest ways;
/// without `guidance` and `corridor` it is the plain form.
pub fn aco() -> ColonyConfig {
    ColonyConfig {
        n_ants: 50,
        n_iterations: 50,
        corridor: Corridor::Ratio(RatioCorridor {
            ratio: 1.1,
            step_loss_cells: 0.9,
        }),
        guidance: Guidance::Advantage(Advantage { beta: 2.0 }),
        ..ant_system()
    }
}
