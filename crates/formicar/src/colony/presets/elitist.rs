//! The elitist Ant System: the elite colony of Lei & Zheng 2020.

use super::ant_system;
use crate::colony::config::ColonyConfig;
use crate::colony::deposit::{Deposit, Elitist};

/// The Ant System with as many elitist ants on the best way so far as a tenth of the colony
/// (Dorigo, Maniezzo & Colorni 1996).
pub fn elitist() -> ColonyConfig {
    ColonyConfig {
        deposit: Deposit::Elitist(Elitist {
            q: 100.0,
            elite_share: 0.1,
        }),
        ..ant_system()
    }
}
