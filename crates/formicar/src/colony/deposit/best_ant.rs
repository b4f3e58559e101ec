//! The best ant alone deposits (Stützle & Hoos 2000).

use super::portion::{Generation, Memory, Portion, along, from_ant};
use crate::parameters::parameters;

parameters! {
    /// Q / F from the best ant of the iteration; every few iterations from the best so far instead.
    pub struct BestAnt {
        /// Q: pheromone of a deposit, times the cost of the path.
        #[range(1e-6..=1e9)]
        pub q: f64 = 1.0,
        /// Every so many iterations the best so far deposits; 1 for always, 0 for never, at most 1
        /// 000 000.
        #[range(0..=1_000_000)]
        pub best_so_far_every: u32 = 5,
    }
}

impl BestAnt {
    pub(super) fn deposits<'a>(
        &self,
        iteration: u32,
        generation: &'a Generation,
        memory: &'a Memory,
    ) -> Vec<Portion<'a>> {
        let every = self.best_so_far_every;
        let portion = if every > 0 && (iteration + 1).is_multiple_of(every) {
            along(memory.best(), self.q)
        } else {
            let best = generation.best();
            best.map(|ant| from_ant(generation, ant, self.q))
        };
        portion.into_iter().collect()
    }
}
