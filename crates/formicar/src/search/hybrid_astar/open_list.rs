//! The open list of hybrid A*: the least estimate first.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// A candidate that follows a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Step {
    /// A motion onto another state, by its number; not yet checked.
    Move(u16),
    /// Whatever leads on from there.
    Expand,
    /// A free curve to the goal, by its number.
    Shot(u32),
}

/// A step from a node with the estimated cost of a path through it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    pub(super) node: u32,
    pub(super) step: Step,
    pub(super) estimate: f64,
}

/// A heap of entries: least estimate first, among equal ones the latest.
#[derive(Default)]
pub(super) struct OpenList {
    heap: BinaryHeap<Queued>,
    n_pushed: u32,
}

impl OpenList {
    pub(super) fn push(&mut self, entry: Entry) {
        self.n_pushed = self.n_pushed.wrapping_add(1);
        self.heap.push(Queued {
            entry,
            order: self.n_pushed,
        });
    }

    pub(super) fn peek(&self) -> Option<Entry> {
        self.heap.peek().map(|queued| queued.entry)
    }

    pub(super) fn pop(&mut self) -> Option<Entry> {
        self.heap.pop().map(|queued| queued.entry)
    }
}

struct Queued {
    entry: Entry,
    order: u32,
}

impl Ord for Queued {
    fn cmp(&self, other: &Self) -> Ordering {
        let by_estimate = other.entry.estimate.total_cmp(&self.entry.estimate);
        by_estimate.then(self.order.cmp(&other.order))
    }
}

impl PartialOrd for Queued {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Queued {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Queued {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn least_estimate_first_then_the_latest() {
        let mut open = OpenList::default();
        for (node, estimate) in [(0, 2.0), (1, 1.0), (2, 1.0), (3, 3.0)] {
            open.push(Entry {
                node,
                step: Step::Move(0),
                estimate,
            });
        }
        let order: Vec<u32> = std::iter::from_fn(|| open.pop().map(|e| e.node)).collect();
        assert_eq!(order, [2, 1, 0, 3]);
    }
}
