//! Pieces that wait to be checked, the cheapest first, the oldest among equals.

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
    /// The heap hands out the greatest: the cheapest is.
    fn cmp(&self, other: &Self) -> Ordering {
        let by_cost = other.cost.total_cmp(&self.cost);
        by_cost.then(other.number.cmp(&self.number))
    }
}

#[derive(Debug, Default)]
pub(super) struct OpenList {
    heap: BinaryHeap<Entry>,
    n_pushed: usize,
}

impl OpenList {
    pub(super) fn push(&mut self, cost: f64, [from, to]: [usize; 2], step: Step) {
        self.n_pushed += 1;
        self.heap.push(Entry {
            cost,
            from,
            to,
            step,
            number: self.n_pushed,
        });
    }

    pub(super) fn pop(&mut self) -> Option<Entry> {
        self.heap.pop()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cheapest_comes_first_and_the_oldest_of_equals() {
        let mut open = OpenList::default();
        for (cost, from) in [(2.0, 0), (1.0, 1), (1.0, 2), (0.5, 3)] {
            open.push(cost, [from, 9], Step::Straight);
        }
        let order: Vec<usize> = std::iter::from_fn(|| open.pop()).map(|e| e.from).collect();
        assert_eq!(order, [3, 1, 2, 0]);
    }
}
