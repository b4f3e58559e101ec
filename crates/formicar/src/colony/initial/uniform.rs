//! The same pheromone everywhere.

use super::unit::PheromoneUnit;
use crate::parameters::parameters;

parameters! {
    /// tau0 everywhere (Dorigo, Maniezzo & Colorni 1996).
    pub struct Uniform {
        /// τ₀: pheromone on every cell.
        #[range(1e-6..=1e6)]
        pub tau: f64 = 1.0,
        /// The unit of `tau`.
        pub unit: PheromoneUnit = PheromoneUnit::Deposit,
    }
}
