//! Deposits of pheromone.

mod all_ants;
mod best_ant;
mod best_worst;
mod elitist;
mod fittest;
mod portion;

pub use all_ants::AllAnts;
pub use best_ant::BestAnt;
pub use best_worst::BestWorst;
pub use elitist::Elitist;
pub use fittest::Fittest;

use crate::parameters::rules;
use portion::{Generation, Memory, Portion, all};

rules! {
    /// Who deposits pheromone after an iteration. F is the cost of a way.
    pub enum Deposit {
        /// Every ant that arrived.
        AllAnts(AllAnts),
        /// Every ant that arrived, and the best so far many times more.
        Elitist(Elitist),
        /// The best ant alone.
        BestAnt(BestAnt),
        /// The better ones among those that arrived.
        Fittest(Fittest),
        /// The best so far adds, the worst so far takes.
        BestWorst(BestWorst),
    }
}

impl Deposit {
    fn q(&self) -> f64 {
        match self {
            Self::AllAnts(rule) => rule.q,
            Self::Elitist(rule) => rule.q,
            Self::BestAnt(rule) => rule.q,
            Self::Fittest(rule) => rule.q,
            Self::BestWorst(rule) => rule.q,
        }
    }

    /// The deposit of `n_ants` ants on one path, times its cost.
    pub(super) fn expected(&self, n_ants: u32) -> f64 {
        let n_depositing = match self {
            Self::AllAnts(_) => f64::from(n_ants),
            Self::Elitist(rule) => f64::from(n_ants) * (1.0 + rule.elite_share),
            Self::Fittest(rule) => (f64::from(n_ants) * rule.share).max(1.0),
            Self::BestAnt(_) | Self::BestWorst(_) => 1.0,
        };
        self.q() * n_depositing
    }

    /// The amounts to add, and the paths to add them along, in order.
    pub(super) fn deposits<'a>(
        &self,
        iteration: u32,
        generation: &'a Generation,
        memory: &'a Memory,
    ) -> Vec<Portion<'a>> {
        match self {
            Self::AllAnts(rule) => all(generation, rule.q),
            Self::Elitist(rule) => rule.deposits(generation, memory),
            Self::BestAnt(rule) => rule.deposits(iteration, generation, memory),
            Self::Fittest(rule) => rule.deposits(generation),
            Self::BestWorst(rule) => rule.deposits(memory),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::colony::Stopping;
    use crate::colony::cost::CellCost;
    use crate::objective::PathCost;

    fn generation() -> Generation {
        let mut generation = Generation::default();
        for n_steps in [4, 2, 8] {
            arrive(&mut generation, n_steps);
        }
        generation
    }

    fn arrive(generation: &mut Generation, n_steps: usize) {
        let steps = vec![0; n_steps];
        generation.steps.extend(&steps);
        generation.end_ant(true, CellCost::new(&PathCost::default(), &steps));
    }

    fn memory(generation: &Generation) -> Memory {
        let mut memory = Memory::default();
        memory.update(generation, generation.best(), &Stopping::default());
        memory
    }

    fn amounts(rule: &Deposit, iteration: u32) -> Vec<(usize, f64)> {
        let generation = generation();
        let memory = memory(&generation);
        let portions = rule.deposits(iteration, &generation, &memory);
        portions
            .iter()
            .map(|(steps, amount)| (steps.len(), *amount))
            .collect()
    }

    #[test]
    fn every_rule_deposits_as_its_paper_says() {
        let all = amounts(&Deposit::AllAnts(AllAnts { q: 8.0 }), 0);
        assert_eq!(all, [(4, 2.0), (2, 4.0), (8, 1.0)]);
        let elitist = Elitist {
            q: 8.0,
            elite_share: 1.0,
        };
        let elitist = amounts(&Deposit::Elitist(elitist), 0);
        assert_eq!(elitist, [(4, 2.0), (2, 4.0), (8, 1.0), (2, 12.0)]);
        let fittest = Fittest { q: 8.0, share: 0.5 };
        assert_eq!(amounts(&Deposit::Fittest(fittest), 0), [(4, 2.0), (2, 4.0)]);
        let best_worst = amounts(&Deposit::BestWorst(BestWorst { q: 8.0 }), 0);
        assert_eq!(best_worst, [(2, 4.0), (8, -1.0)]);
        let best = Deposit::BestAnt(BestAnt {
            q: 8.0,
            best_so_far_every: 5,
        });
        assert_eq!(amounts(&best, 0), [(2, 4.0)]);
    }

    #[test]
    fn nothing_is_taken_where_the_worst_is_the_best() {
        let mut generation = Generation::default();
        arrive(&mut generation, 2);
        let memory = memory(&generation);
        let rule = Deposit::BestWorst(BestWorst { q: 8.0 });
        assert_eq!(rule.deposits(0, &generation, &memory), [(&[0, 0][..], 4.0)]);
    }
}
