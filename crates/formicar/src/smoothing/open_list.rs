//! The open list of smoothing: the least estimate first, the latest among equals.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// An item on the list, with its cost.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry<T> {
    /// Lower bound of the cost of a whole path through the item.
    estimate: f64,
    pub(super) cost: f64,
    pub(super) item: T,
    number: usize,
}

impl<T> PartialEq for Entry<T> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl<T> Eq for Entry<T> {}

impl<T> PartialOrd for Entry<T> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<T> Ord for Entry<T> {
    /// The heap returns the greatest entry, which is the one of the least estimate.
    fn cmp(&self, other: &Self) -> Ordering {
        let by_estimate = other.estimate.total_cmp(&self.estimate);
        by_estimate.then(self.number.cmp(&other.number))
    }
}

#[derive(Debug)]
pub(super) struct OpenList<T> {
    heap: BinaryHeap<Entry<T>>,
    n_pushed: usize,
}

impl<T> Default for OpenList<T> {
    fn default() -> Self {
        Self {
            heap: BinaryHeap::new(),
            n_pushed: 0,
        }
    }
}

impl<T> OpenList<T> {
    /// Adds an item with its cost so far and a lower bound of the cost that remains. Items with an
    /// infinite bound are left out.
    pub(super) fn push(&mut self, [cost, remaining]: [f64; 2], item: T) {
        let estimate = cost + remaining;
        if estimate.is_finite() {
            self.n_pushed += 1;
            self.heap.push(Entry {
                estimate,
                cost,
                item,
                number: self.n_pushed,
            });
        }
    }

    pub(super) fn pop(&mut self) -> Option<Entry<T>> {
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
        for (i, costs) in costs.into_iter().enumerate() {
            open.push(costs, i);
        }
        let order: Vec<usize> = std::iter::from_fn(|| open.pop()).map(|e| e.item).collect();
        assert_eq!(order, [3, 2, 1, 0]);
    }
}
