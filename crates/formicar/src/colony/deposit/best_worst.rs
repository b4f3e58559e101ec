//! The best way so far gains, the worst so far loses (Wang 2019).

use super::portion::{Memory, Portion, along};
use crate::parameters::parameters;

parameters! {
    /// +Q / l along the best way so far and -Q / l along the worst so far: Wang 2019 (10-12).
    ///
    /// Both where both pass; nothing is taken where the worst costs no more than the best.
    pub struct BestWorst {
        /// Q: pheromone of a deposit, times the cost of the path.
        #[range(1e-6..=1e9)]
        pub q: f64 = 100.0,
    }
}

impl BestWorst {
    pub(super) fn deposits<'a>(&self, memory: &'a Memory) -> Vec<Portion<'a>> {
        let (Some(best), Some(worst)) = (memory.best(), &memory.worst) else {
            return Vec::new();
        };
        let gain = along(Some(best), self.q);
        let loss = (worst.cost.cost > best.cost.cost).then(|| along(Some(worst), -self.q));
        gain.into_iter().chain(loss.flatten()).collect()
    }
}
