//! The ants of one iteration and what their ways cost.

use super::crew::Part;
use crate::map::{Cell, STEPS};
use crate::objective::{PathCost, StepCounts};
use crate::progress::AntWays;
use std::ops::Range;

/// The ways of the ants of an iteration, one behind the other.
#[derive(Clone, Debug, Default)]
pub(super) struct Generation {
    /// Steps as places in [`STEPS`](crate::map::STEPS).
    pub(super) steps: Vec<u8>,
    ends: Vec<usize>,
    arrived: Vec<bool>,
    costs: Vec<AntCost>,
}

/// What an ant's way came to.
#[derive(Clone, Copy, Debug)]
pub(super) struct AntCost {
    pub(super) ant: usize,
    pub(super) cost: f64,
    pub(super) length: f64,
}

/// A way that a colony remembers.
#[derive(Clone, Debug)]
pub(super) struct Way {
    pub(super) steps: Vec<u8>,
    pub(super) cost: f64,
    pub(super) length: f64,
}

impl Generation {
    /// Ends the way of an ant.
    pub(super) fn end_ant(&mut self, arrived: bool) {
        self.ends.push(self.steps.len());
        self.arrived.push(arrived);
    }

    /// Forgets all ants from the first on that does not end within so many steps.
    pub(super) fn keep_steps(&mut self, n_steps: u64) {
        let n_kept = self.ends.partition_point(|&end| end as u64 <= n_steps);
        self.ends.truncate(n_kept);
        self.arrived.truncate(n_kept);
        self.steps.truncate(self.ends.last().copied().unwrap_or(0));
    }

    /// Works out the cost of every way that reached the goal.
    pub(super) fn evaluate(&mut self, cost: &PathCost) {
        let mut costs = std::mem::take(&mut self.costs);
        let arrived = (0..self.n_ants()).filter(|&ant| self.arrived[ant]);
        costs.extend(arrived.map(|ant| {
            let counts = StepCounts::of(self.steps_of(ant));
            AntCost {
                ant,
                cost: cost.cost(counts),
                length: cost.length_cells(counts),
            }
        }));
        self.costs = costs;
    }

    pub(super) fn n_ants(&self) -> usize {
        self.ends.len()
    }

    pub(super) fn n_steps(&self) -> u64 {
        self.steps.len() as u64
    }

    /// The ants that arrived, in their order.
    pub(super) fn costs(&self) -> &[AntCost] {
        &self.costs
    }

    pub(super) fn steps_of(&self, ant: usize) -> &[u8] {
        &self.steps[self.range(ant)]
    }

    fn range(&self, ant: usize) -> Range<usize> {
        let first = ant.checked_sub(1).map_or(0, |before| self.ends[before]);
        first..self.ends[ant]
    }

    /// The cheapest ant; of equals the first.
    pub(super) fn best(&self) -> Option<&AntCost> {
        self.costs.iter().min_by(|a, b| a.cost.total_cmp(&b.cost))
    }

    /// The dearest ant that arrived; of equals the first.
    pub(super) fn worst(&self) -> Option<&AntCost> {
        self.costs
            .iter()
            .rev()
            .max_by(|a, b| a.cost.total_cmp(&b.cost))
    }

    pub(super) fn way(&self, ant: &AntCost) -> Way {
        Way {
            steps: self.steps_of(ant.ant).to_vec(),
            cost: ant.cost,
            length: ant.length,
        }
    }

    pub(super) fn view(&self, [start, goal]: [Cell; 2]) -> AntWays<'_> {
        AntWays {
            start,
            goal,
            moves: &STEPS,
            steps: &self.steps,
            ends: &self.ends,
            arrived: &self.arrived,
            best: self.best().map(|best| best.ant),
        }
    }
}

impl Part for Generation {
    fn clear(&mut self) {
        self.steps.clear();
        self.ends.clear();
        self.arrived.clear();
        self.costs.clear();
    }

    fn append(&mut self, part: &Self) {
        let n_steps = self.steps.len();
        self.steps.extend_from_slice(&part.steps);
        self.ends.extend(part.ends.iter().map(|end| n_steps + end));
        self.arrived.extend_from_slice(&part.arrived);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn generation() -> Generation {
        let mut generation = Generation::default();
        for (steps, arrived) in [(&[0, 1, 1][..], true), (&[2], false), (&[0, 0, 0], true)] {
            generation.steps.extend_from_slice(steps);
            generation.end_ant(arrived);
        }
        generation
    }

    #[test]
    fn finds_best_and_worst_of_those_that_arrived() {
        let mut all = generation();
        all.append(&generation());
        all.evaluate(&PathCost::default());
        assert_eq!(all.costs().len(), 4);
        assert_eq!(all.best().map(|ant| ant.ant), Some(2));
        assert_eq!(all.worst().map(|ant| ant.ant), Some(0));
        assert_eq!(all.steps_of(4), [2]);
    }

    #[test]
    fn a_budget_keeps_whole_ants() {
        let mut cut = generation();
        cut.keep_steps(6);
        assert_eq!((cut.n_ants(), cut.n_steps()), (2, 4));
    }
}
