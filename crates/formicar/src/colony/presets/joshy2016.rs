//! The colony of Joshy & Supriya 2016, as far as Wang 2019 describes it.

use super::wang2019;
use crate::colony::config::ColonyConfig;
use crate::colony::deposit::{AllAnts, Deposit};
use crate::colony::directions::Directions;
use crate::colony::heuristic::Guidance;
use crate::colony::limits::PheromoneLimits;
use crate::colony::transition::{ObliqueFirst, Transition};

/// Joshy & Supriya 2016, reference 11 of Wang 2019: six directions, oblique ones preferred, and
/// an Ant System. All that Wang 2019 does not say is that of [`wang2019`].
pub fn joshy2016() -> ColonyConfig {
    ColonyConfig {
        directions: Directions::Six,
        guidance: Guidance::None,
        transition: Transition::ObliqueFirst(ObliqueFirst {}),
        deposit: Deposit::AllAnts(AllAnts { q: 100.0 }),
        limits: PheromoneLimits::None,
        ..wang2019()
    }
}
