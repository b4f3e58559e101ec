//! Every ant that arrived deposits (Dorigo, Maniezzo & Colorni 1996).

use crate::parameters::parameters;

parameters! {
    /// Q / F from every ant that arrived: the ant-cycle form of the Ant System.
    pub struct AllAnts {
        /// Q: pheromone of a deposit, times the cost of the path.
        #[range(1e-6..=1e9)]
        pub q: f64 = 100.0,
    }
}
