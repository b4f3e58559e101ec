//! The best so far deposits once more, for many (Dorigo, Maniezzo & Colorni 1996).

use super::portion::{Generation, Memory, Portion, all, along};
use crate::parameters::parameters;

parameters! {
    /// Q / F from every ant that arrived, and e Q / F along the best way so far.
    pub struct Elitist {
        /// Q: pheromone of a deposit, times the cost of the path.
        #[range(1e-6..=1e9)]
        pub q: f64 = 100.0,
        /// e as a share of the ants of the iteration.
        #[range(0.0..=10.0)]
        pub elite_share: f64 = 0.1,
    }
}

impl Elitist {
    pub(super) fn deposits<'a>(
        &self,
        generation: &'a Generation,
        memory: &'a Memory,
    ) -> Vec<Portion<'a>> {
        let n_elite = self.elite_share * generation.n_ants() as f64;
        let mut portions = all(generation, self.q);
        portions.extend(along(memory.best(), n_elite * self.q));
        portions
    }
}
