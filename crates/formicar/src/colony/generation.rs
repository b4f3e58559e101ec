//! The ants of one iteration: their paths and what these cost.

use super::cost::AntCost;
use super::worker_pool::Batch;
use crate::map::Cell;
use crate::path::GridPath;
use crate::progress::{AntWays, path_of};
use std::ops::Range;

/// The paths of the ants of an iteration, one behind the other.
#[derive(Clone, Debug, Default)]
pub(super) struct Generation<C> {
    /// Steps as indices into [`StepSpace::moves`].
    pub(super) steps: Vec<u8>,
    ends: Vec<usize>,
    arrived: Vec<bool>,
    costs: Vec<C>,
}

/// A path that a colony remembers.
#[derive(Clone, Debug)]
pub(super) struct AntPath<C> {
    pub(super) steps: Vec<u8>,
    pub(super) cost: C,
}

/// The grid of a colony, the ends of all its paths, and the steps that its ants can take.
#[derive(Clone, Copy, Debug)]
pub(super) struct StepSpace<'a> {
    pub(super) start: Cell,
    pub(super) goal: Cell,
    /// Columns and rows of each step; any step that is not listed leads to the goal.
    pub(super) moves: &'a [(i32, i32)],
    pub(super) n_cols: usize,
    pub(super) n_rows: usize,
}

impl StepSpace<'_> {
    /// The cells of a path.
    pub(super) fn path(&self, steps: &[u8]) -> GridPath {
        path_of(self.moves, [self.start, self.goal], steps)
    }
}

impl<C: AntCost> Generation<C> {
    /// Ends the path of an ant; its cost matters only if it has arrived.
    pub(super) fn end_ant(&mut self, has_arrived: bool, cost: C) {
        self.ends.push(self.steps.len());
        self.arrived.push(has_arrived);
        self.costs.push(cost);
    }

    /// The steps of the ant whose path has not been ended yet.
    pub(super) fn open_steps(&self) -> &[u8] {
        &self.steps[self.ends.last().copied().unwrap_or(0)..]
    }

    /// Keeps the first ants that together take at most `n_steps` steps.
    pub(super) fn keep_steps(&mut self, n_steps: u64) {
        let n_kept = self.ends.partition_point(|&end| end as u64 <= n_steps);
        self.ends.truncate(n_kept);
        self.arrived.truncate(n_kept);
        self.costs.truncate(n_kept);
        self.steps.truncate(self.ends.last().copied().unwrap_or(0));
    }

    pub(super) fn n_ants(&self) -> usize {
        self.ends.len()
    }

    pub(super) fn n_steps(&self) -> u64 {
        self.steps.len() as u64
    }

    /// The ants that arrived, in their order.
    pub(super) fn arrived(&self) -> impl DoubleEndedIterator<Item = usize> + '_ {
        (0..self.n_ants()).filter(|&ant| self.arrived[ant])
    }

    pub(super) fn cost(&self, ant: usize) -> &C {
        &self.costs[ant]
    }

    pub(super) fn steps_of(&self, ant: usize) -> &[u8] {
        &self.steps[self.range(ant)]
    }

    fn range(&self, ant: usize) -> Range<usize> {
        let first = ant.checked_sub(1).map_or(0, |before| self.ends[before]);
        first..self.ends[ant]
    }

    /// The cheapest ant that arrived; the first among equals.
    pub(super) fn best(&self) -> Option<usize> {
        self.arrived().min_by(|&a, &b| self.compare(a, b))
    }

    /// The most expensive ant that arrived; the first among equals.
    pub(super) fn worst(&self) -> Option<usize> {
        self.arrived().rev().max_by(|&a, &b| self.compare(a, b))
    }

    fn compare(&self, a: usize, b: usize) -> std::cmp::Ordering {
        self.costs[a].cost().total_cmp(&self.costs[b].cost())
    }

    pub(super) fn path(&self, ant: usize) -> AntPath<C> {
        AntPath {
            steps: self.steps_of(ant).to_vec(),
            cost: self.costs[ant],
        }
    }

    /// All paths, with the best ant.
    pub(super) fn view<'a>(&'a self, space: StepSpace<'a>, best: Option<usize>) -> AntWays<'a> {
        AntWays {
            start: space.start,
            goal: space.goal,
            moves: space.moves,
            steps: &self.steps,
            ends: &self.ends,
            arrived: &self.arrived,
            best,
        }
    }
}

impl<C: AntCost> Batch for Generation<C> {
    fn clear(&mut self) {
        self.steps.clear();
        self.ends.clear();
        self.arrived.clear();
        self.costs.clear();
    }

    fn append(&mut self, batch: &Self) {
        let n_steps = self.steps.len();
        self.steps.extend_from_slice(&batch.steps);
        self.ends.extend(batch.ends.iter().map(|end| n_steps + end));
        self.arrived.extend_from_slice(&batch.arrived);
        self.costs.extend_from_slice(&batch.costs);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::colony::cost::CellCost;
    use crate::objective::PathCost;

    fn generation() -> Generation<CellCost> {
        let mut generation = Generation::default();
        for (steps, has_arrived) in [(&[0, 1, 1][..], true), (&[2], false), (&[0, 0, 0], true)] {
            generation.steps.extend_from_slice(steps);
            generation.end_ant(has_arrived, CellCost::new(&PathCost::default(), steps));
        }
        generation
    }

    #[test]
    fn finds_best_and_worst_of_those_that_arrived() {
        let mut all = generation();
        all.append(&generation());
        assert_eq!(all.arrived().count(), 4);
        assert_eq!(all.best(), Some(2));
        assert_eq!(all.worst(), Some(0));
        assert_eq!(all.steps_of(4), [2]);
    }

    #[test]
    fn a_budget_keeps_whole_ants() {
        let mut cut = generation();
        cut.keep_steps(6);
        assert_eq!((cut.n_ants(), cut.n_steps()), (2, 4));
    }
}
