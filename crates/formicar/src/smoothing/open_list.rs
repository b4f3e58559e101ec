//! Pieces that wait to be checked, the least estimate first, the latest among equals.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// A way from one node to another.
#[derive(Clone, Copy, Debug)]
pub(super) enum Step {
    /// To the next place of the leg.
    Straight,
    /// By a 2-turning of the list.
    Turning(usize),
    /// By some curve, at a lower bound of its cost.
    AnyWord,
    /// By a curve of the list.
    Word(usize),
    /// The start or the goal with the polyline's own heading: nothing to drive.
    Here,
}

/// A step with the cost at which it arrives.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    /// Of a whole chain that takes the step, at least.
    estimate: f64,
    pub(super) cost: f64,
    pub(super) from: usize,
    pub(super) to: usize,
    pub(super) step: Step,
    number: usize,
}

impl PartialEq for Entry {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Entry {}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Entry {
    /// The heap hands out the greatest: that of the least estimate is.
    fn cmp(&self, other: &Self) -> Ordering {
        let by_estimate = other.estimate.total_cmp(&self.estimate);
        by_estimate.then(self.number.cmp(&other.number))
    }
}

#[derive(Debug, Default)]
pub(super) struct OpenList {
    heap: BinaryHeap<Entry>,
    n_pushed: usize,
}

impl OpenList {
    /// Puts a step between two nodes on the list that arrives at a cost, of which the rest of the
    /// way takes at least `remaining` more. One that leads nowhere is left out.
    pub(super) fn push(&mut self, [cost, remaining]: [f64; 2], nodes: [usize; 2], step: Step) {
        let estimate = cost + remaining;
        if estimate.is_finite() {
            self.n_pushed += 1;
            self.heap.push(Entry {
                estimate,
                cost,
                from: nodes[0],
                to: nodes[1],
                step,
                number: self.n_pushed,
            });
        }
    }

    pub(super) fn pop(&mut self) -> Option<Entry> {
        self.heap.pop()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_estimate_comes_first_and_the_latest_of_equals() {
        let mut open = OpenList::default();
        let costs = [
            [2.0, 0.0],
            [1.0, 0.5],
            [1.5, 0.0],
            [0.5, 0.1],
            [0.0, f64::INFINITY],
        ];
        for (from, costs) in costs.into_iter().enumerate() {
            open.push(costs, [from, 9], Step::Straight);
        }
        let order: Vec<usize> = std::iter::from_fn(|| open.pop()).map(|e| e.from).collect();
        assert_eq!(order, [3, 2, 1, 0]);
    }
}
