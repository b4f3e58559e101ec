//! The colony of Zhang 2016, as far as Wang 2019 describes it.

use super::wang2019;
use crate::colony::config::ColonyConfig;
use crate::colony::deposit::{Deposit, Fittest};
use crate::colony::evaporation::{Adaptive, Evaporation};
use crate::colony::heuristic::Guidance;
use crate::colony::limits::{MaxMin, PheromoneLimits};
use crate::map::DiagonalRule;

/// Zhang 2016, reference 7 of Wang 2019: a MAX-MIN Ant System with adaptive parameters, whose
/// ways run through narrow aisles. All that Wang 2019 does not say is that of [`wang2019`].
pub fn zhang2016() -> ColonyConfig {
    ColonyConfig {
        diagonal_rule: DiagonalRule::Always,
        guidance: Guidance::None,
        evaporation: Evaporation::Adaptive(Adaptive {
            rho: 0.43,
            decay: 0.95,
            rho_min: 0.1,
        }),
        deposit: Deposit::Fittest(Fittest {
            q: 100.0,
            share: 0.5,
        }),
        limits: PheromoneLimits::MaxMin(MaxMin { p_best: 0.05 }),
        ..wang2019()
    }
}
