//! The better ones among the ants that arrived deposit.

use super::portion::{Generation, Portion, from_ant};
use crate::parameters::parameters;

parameters! {
    /// Q / F from the cheapest share of the ants that arrived, at least one.
    ///
    /// It stands for "the survival of the fittest" of Zhang 2016, which Wang 2019 names and does
    /// not write down.
    pub struct Fittest {
        /// Q: pheromone of a deposit, times the cost of the path.
        #[range(1e-6..=1e9)]
        pub q: f64 = 100.0,
        /// Share of the ants that arrived.
        #[range(0.0..=1.0)]
        pub share: f64 = 0.5,
    }
}

impl Fittest {
    pub(super) fn deposits<'a>(&self, generation: &'a Generation) -> Vec<Portion<'a>> {
        let cost = |ant: usize| generation.cost(ant).cost;
        let mut fit: Vec<usize> = generation.arrived().collect();
        fit.sort_by(|&a, &b| cost(a).total_cmp(&cost(b)).then(a.cmp(&b)));
        let n_fit = (self.share * fit.len() as f64).ceil().max(1.0) as usize;
        fit.truncate(n_fit);
        // In the ants' order, as everywhere.
        fit.sort_unstable();
        let ants = fit.into_iter();
        ants.map(|ant| from_ant(generation, ant, self.q)).collect()
    }
}
