//! No less pheromone than a share of what there was at first.

use crate::parameters::parameters;

parameters! {
    /// tau >= `share` tau0, with the least initial pheromone tau0.
    ///
    /// A reading that Wang 2019 (10) needs: its penalty would make pheromone negative.
    pub struct Floor {
        /// Share of the initial pheromone.
        #[range(0.0..=1.0)]
        pub share: f64 = 1e-3,
    }
}
