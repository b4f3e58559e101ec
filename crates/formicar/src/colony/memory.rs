//! The memory of a colony from iteration to iteration.

use super::cost::AntCost;
use super::generation::{AntPath, Generation};
use super::stopping::Stopping;

/// The best and the worst paths of a run, and how long ago it improved.
#[derive(Debug)]
pub(super) struct Memory<C> {
    /// The best paths, each cheaper than the one before.
    pub(super) improvements: Vec<AntPath<C>>,
    pub(super) worst: Option<AntPath<C>>,
    /// Iterations so far that found no better path.
    pub(super) n_stagnant: u32,
    /// Iterations since the last gain that counts.
    pub(super) n_stalled: u32,
}

impl<C> Default for Memory<C> {
    fn default() -> Self {
        Self {
            improvements: Vec::new(),
            worst: None,
            n_stagnant: 0,
            n_stalled: 0,
        }
    }
}

impl<C: AntCost> Memory<C> {
    /// The best path so far.
    pub(super) fn best(&self) -> Option<&AntPath<C>> {
        self.improvements.last()
    }

    /// Takes over the best and the worst path of a generation where they beat those known.
    pub(super) fn update(
        &mut self,
        generation: &Generation<C>,
        best: Option<usize>,
        stopping: &Stopping,
    ) {
        self.n_stagnant += 1;
        self.n_stalled += 1;
        let (Some(best), Some(worst)) = (best, generation.worst()) else {
            return;
        };
        let cost = generation.cost(best).cost();
        let known = self.best().map(|known| known.cost.cost());
        if known.is_none_or(|known| cost < known) {
            self.improvements.push(generation.path(best));
            self.n_stagnant -= 1;
            if known.is_none_or(|known| cost < stopping.counts_below(known)) {
                self.n_stalled = 0;
            }
        }
        let worst_cost = generation.cost(worst).cost();
        let is_worst = |known: &AntPath<C>| worst_cost > known.cost.cost();
        if self.worst.as_ref().is_none_or(is_worst) {
            self.worst = Some(generation.path(worst));
        }
    }
}
