//! Queues of open cells.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Cells that wait, the least key first, the latest among equals.
pub(super) trait OpenQueue {
    /// The keys by which cells are ordered.
    type Key: Copy;

    /// Empties the queue; keys will start at `key`. Memory is kept.
    fn reset(&mut self, key: Self::Key);

    /// Queues an item.
    fn push(&mut self, item: u32, key: Self::Key);

    /// Takes out an item of the smallest key, with the key.
    fn pop(&mut self) -> Option<(u32, Self::Key)>;
}

/// A binary heap, for keys that may also get smaller.
#[derive(Clone, Debug, Default)]
pub(super) struct KeyHeap {
    /// By key, then by number, the largest first, and the item.
    heap: BinaryHeap<(Reverse<u64>, u64, u32)>,
    n_pushed: u64,
}

impl OpenQueue for KeyHeap {
    type Key = u64;

    fn reset(&mut self, _: u64) {
        self.heap.clear();
        self.n_pushed = 0;
    }

    fn push(&mut self, item: u32, key: u64) {
        self.n_pushed += 1;
        self.heap.push((Reverse(key), self.n_pushed, item));
    }

    fn pop(&mut self) -> Option<(u32, u64)> {
        let (Reverse(key), _, item) = self.heap.pop()?;
        Some((item, key))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_key_comes_first_and_the_latest_among_equals() {
        let mut heap = KeyHeap::default();
        heap.reset(7);
        for (item, key) in [(0, 7), (1, 5), (2, 9), (3, 5)] {
            heap.push(item, key);
        }
        let order: Vec<(u32, u64)> = std::iter::from_fn(|| heap.pop()).collect();
        assert_eq!(order, [(3, 5), (1, 5), (0, 7), (2, 9)]);
    }
}
