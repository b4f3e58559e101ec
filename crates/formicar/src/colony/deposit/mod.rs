//! Who deposits pheromone, and how much.

mod all_ants;
mod best_ant;
mod best_worst;
mod elitist;
mod fittest;

pub use all_ants::AllAnts;
pub use best_ant::BestAnt;
pub use best_worst::BestWorst;
pub use elitist::Elitist;
pub use fittest::Fittest;

use super::engine::Memory;
use super::generation::{AntCost, Generation, Way};
use crate::numeric::{OutOfRange, check_range};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Who deposits pheromone after an iteration. F is the cost of a way.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "rule", rename_all = "kebab-case")]
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

/// The steps of a way, and what is added to the pheromone along it.
pub(super) type Portion<'a> = (&'a [u8], f64);

impl Deposit {
    pub(super) fn check(&self) -> Result<(), OutOfRange> {
        check_range("colony.deposit.q", self.q(), 1e-6..=1e9)?;
        match self {
            Self::AllAnts(_) | Self::BestWorst(_) => Ok(()),
            Self::Elitist(rule) => rule.check(),
            Self::BestAnt(rule) => rule.check(),
            Self::Fittest(rule) => rule.check(),
        }
    }

    fn q(&self) -> f64 {
        match self {
            Self::AllAnts(rule) => rule.q,
            Self::Elitist(rule) => rule.q,
            Self::BestAnt(rule) => rule.q,
            Self::Fittest(rule) => rule.q,
            Self::BestWorst(rule) => rule.q,
        }
    }

    /// What so many ants on one way deposit, times its cost.
    pub(super) fn expected(&self, n_ants: u32) -> f64 {
        let n_depositing = match self {
            Self::AllAnts(_) => f64::from(n_ants),
            Self::Elitist(rule) => f64::from(n_ants) * (1.0 + rule.elite_share),
            Self::Fittest(rule) => (f64::from(n_ants) * rule.share).max(1.0),
            Self::BestAnt(_) | Self::BestWorst(_) => 1.0,
        };
        self.q() * n_depositing
    }

    /// What is added along which way, in order.
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

/// Q / F from every ant that arrived, in the ants' order.
fn all(generation: &Generation, q: f64) -> Vec<Portion<'_>> {
    let ants = generation.costs().iter();
    ants.map(|ant| from_ant(generation, ant, q)).collect()
}

/// Q / F from an ant.
fn from_ant<'a>(generation: &'a Generation, ant: &AntCost, q: f64) -> Portion<'a> {
    (generation.steps_of(ant.ant), share_of(q, ant.cost))
}

/// `n` Q / F along a way that is remembered.
fn along(way: Option<&Way>, n_q: f64) -> Option<Portion<'_>> {
    way.map(|way| (&way.steps[..], share_of(n_q, way.cost)))
}

/// Q / F; a way of no steps costs as much as one of one.
fn share_of(q: f64, cost: f64) -> f64 {
    q / if cost > 0.0 { cost } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::objective::PathCost;

    fn generation() -> Generation {
        let mut generation = Generation::default();
        for n_steps in [4, 2, 8] {
            generation.steps.extend(vec![0; n_steps]);
            generation.end_ant(true);
        }
        generation.evaluate(&PathCost::default());
        generation
    }

    fn memory(generation: &Generation) -> Memory {
        Memory {
            best: generation.best().map(|ant| generation.way(ant)),
            worst: generation.worst().map(|ant| generation.way(ant)),
            ..Memory::default()
        }
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
        generation.steps.extend([0, 0]);
        generation.end_ant(true);
        generation.evaluate(&PathCost::default());
        let memory = memory(&generation);
        let rule = Deposit::BestWorst(BestWorst { q: 8.0 });
        assert_eq!(rule.deposits(0, &generation, &memory), [(&[0, 0][..], 4.0)]);
    }
}
