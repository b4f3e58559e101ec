//! Evaporation of pheromone between iterations.

mod adaptive;
mod constant;
mod generational;
mod poisson;

pub use adaptive::Adaptive;
pub use constant::Constant;
pub use generational::{Generational, Recursion};
pub use poisson::PoissonEvaporation;

use super::ColonyError;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The share rho of the pheromone that evaporates after each iteration.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "rule", rename_all = "kebab-case")]
pub enum Evaporation {
    /// Always the same share.
    Constant(Constant),
    /// Much, then little, then much, along a Poisson distribution.
    Poisson(PoissonEvaporation),
    /// Less whenever the colony stagnates.
    Adaptive(Adaptive),
    /// Less from generation to generation.
    Generational(Generational),
}

impl Evaporation {
    pub(super) fn check(&self, n_iterations: u32) -> Result<(), ColonyError> {
        match self {
            Self::Constant(rule) => Ok(rule.check()?),
            Self::Poisson(rule) => rule.check(n_iterations),
            Self::Adaptive(rule) => Ok(rule.check()?),
            Self::Generational(rule) => Ok(rule.check()?),
        }
    }

    /// rho after iteration `iteration` of `n_iterations`, when so far `n_stagnant` brought no
    /// better path.
    pub fn rho(&self, iteration: u32, n_iterations: u32, n_stagnant: u32) -> f64 {
        match self {
            Self::Constant(rule) => rule.rho,
            Self::Poisson(rule) => rule.rho(iteration),
            Self::Adaptive(rule) => rule.rho(n_stagnant),
            Self::Generational(rule) => rule.rho(iteration, n_iterations),
        }
    }
}
