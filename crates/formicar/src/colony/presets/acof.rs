//! The Ant System with A*-seeded pheromone that Li et al. 2024 compare with.

use super::aco;
use crate::colony::config::ColonyConfig;
use crate::colony::initial::{AstarSeed, InitialPheromone, PheromoneUnit};

/// The "ACOF" of Li 2024, Table 2: [`aco`] with the initial pheromone of (21). The planner of this
/// name lays a B-spline over its nodes.
pub fn acof() -> ColonyConfig {
    ColonyConfig {
        initial: InitialPheromone::AstarSeed(AstarSeed {
            tau: 1.0,
            factor: 5.0,
            unit: PheromoneUnit::Deposit,
        }),
        ..aco()
    }
}
