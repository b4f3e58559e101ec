//! The MAX-MIN Ant System.

use super::ant_system;
use crate::colony::config::ColonyConfig;
use crate::colony::deposit::{BestAnt, Deposit};
use crate::colony::evaporation::{Constant, Evaporation};
use crate::colony::initial::{InitialPheromone, PheromoneUnit, Uniform};
use crate::colony::limits::{MaxMin, PheromoneLimits};

/// The MAX-MIN Ant System (Stützle & Hoos 2000): only the best ant deposits, pheromone stays
/// between limits and begins at the upper one. Evaporation is 0.1 instead of their 0.02, for runs
/// of some hundred iterations.
pub fn max_min() -> ColonyConfig {
    let rho = 0.1;
    ColonyConfig {
        initial: InitialPheromone::Uniform(Uniform {
            tau: 1.0 / rho,
            unit: PheromoneUnit::Deposit,
        }),
        evaporation: Evaporation::Constant(Constant { rho }),
        deposit: Deposit::BestAnt(BestAnt {
            q: 1.0,
            best_so_far_every: 5,
        }),
        limits: PheromoneLimits::MaxMin(MaxMin { p_best: 0.05 }),
        ..ant_system()
    }
}
