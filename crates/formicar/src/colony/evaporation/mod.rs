//! Evaporation of pheromone between iterations.

mod adaptive;
mod constant;
mod generational;
mod poisson;

pub use adaptive::Adaptive;
pub use constant::Constant;
pub use generational::{Generational, Recursion};
pub use poisson::PoissonEvaporation;

use crate::parameters::{OutOfRange, rules};

rules! {
    /// The share rho of the pheromone that evaporates after each iteration.
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
}

impl Evaporation {
    /// Checks what depends on the length of a run.
    pub(super) fn check_run(&self, n_iterations: u32) -> Result<(), OutOfRange> {
        match self {
            Self::Poisson(rule) => rule.check_run(n_iterations),
            Self::Constant(_) | Self::Adaptive(_) | Self::Generational(_) => Ok(()),
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
