//! A priority queue for integer keys that only grow, and never by much at once.

use super::open_queue::OpenQueue;

/// Keys at or above the smallest queued one, by less than this, can be told apart.
const N_BUCKETS: u32 = 1 << 12;

/// No entry.
const NONE: u32 = u32::MAX;

/// A ring of stacks, one per key modulo the ring's size (Dial 1969), with two levels of bits that
/// tell which stacks hold something. Entries of equal keys come out last in, first out.
#[derive(Clone, Debug)]
pub(super) struct BucketQueue {
    heads: Vec<u32>,
    entries: Vec<Entry>,
    free: u32,
    occupied: [u64; 64],
    occupied_words: u64,
    key: u32,
}

#[derive(Clone, Copy, Debug)]
struct Entry {
    item: u32,
    next: u32,
}

impl BucketQueue {
    pub(super) fn new() -> Self {
        Self {
            heads: vec![NONE; N_BUCKETS as usize],
            entries: Vec::new(),
            free: NONE,
            occupied: [0; 64],
            occupied_words: 0,
            key: 0,
        }
    }

    fn store(&mut self, entry: Entry) -> u32 {
        if self.free == NONE {
            self.entries.push(entry);
            return self.entries.len() as u32 - 1;
        }
        let place = self.free;
        self.free = self.entries[place as usize].next;
        self.entries[place as usize] = entry;
        place
    }

    /// The first occupied bucket from the current key on, around the ring.
    fn next_bucket(&self) -> Option<usize> {
        let start = (self.key % N_BUCKETS) as usize;
        let word = start / 64;
        let later = self.occupied[word] >> (start % 64);
        if later != 0 {
            return Some(start + later.trailing_zeros() as usize);
        }
        if self.occupied_words == 0 {
            return None;
        }
        // Rotated so that the next word comes first and the current one, behind start, last.
        let turned = self.occupied_words.rotate_right(word as u32 + 1);
        let word = (word + 1 + turned.trailing_zeros() as usize) % 64;
        Some(word * 64 + self.occupied[word].trailing_zeros() as usize)
    }
}

impl OpenQueue for BucketQueue {
    type Key = u32;

    /// Empties the queue; keys will start at `key`. Memory is kept.
    fn reset(&mut self, key: u32) {
        self.heads.fill(NONE);
        self.entries.clear();
        self.free = NONE;
        self.occupied = [0; 64];
        self.occupied_words = 0;
        self.key = key;
    }

    /// Queues an item; the key, modulo 2^32, is less than [`N_BUCKETS`] above the last one popped.
    fn push(&mut self, item: u32, key: u32) {
        let bucket = (key % N_BUCKETS) as usize;
        let entry = Entry {
            item,
            next: self.heads[bucket],
        };
        self.heads[bucket] = self.store(entry);
        self.occupied[bucket / 64] |= 1 << (bucket % 64);
        self.occupied_words |= 1 << (bucket / 64);
    }

    /// Takes out an item of the smallest key, with the key.
    fn pop(&mut self) -> Option<(u32, u32)> {
        let bucket = self.next_bucket()?;
        self.key = self
            .key
            .wrapping_add((bucket as u32).wrapping_sub(self.key) % N_BUCKETS);
        let place = self.heads[bucket];
        let Entry { item, next } = self.entries[place as usize];
        self.entries[place as usize].next = self.free;
        self.free = place;
        self.heads[bucket] = next;
        if next == NONE {
            self.occupied[bucket / 64] &= !(1 << (bucket % 64));
            if self.occupied[bucket / 64] == 0 {
                self.occupied_words &= !(1 << (bucket / 64));
            }
        }
        Some((item, self.key))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn pops_in_order_of_keys(
            first in any::<u32>(),
            steps in prop::collection::vec(prop::collection::vec(0..N_BUCKETS, 0..4), 1..200),
        ) {
            let mut queue = BucketQueue::new();
            queue.reset(first);
            let (mut key, mut waiting) = (first, Vec::new());
            for (i, above) in steps.iter().enumerate() {
                for &above in above {
                    queue.push(i as u32, key.wrapping_add(above));
                    waiting.push((key.wrapping_add(above), i as u32));
                }
                let smallest = waiting.iter().map(|w| w.0.wrapping_sub(key)).min();
                let popped = queue.pop();
                prop_assert_eq!(popped.map(|p| p.1.wrapping_sub(key)), smallest);
                if let Some((item, popped_key)) = popped {
                    let place = waiting.iter().position(|&w| w == (popped_key, item));
                    waiting.swap_remove(place.unwrap());
                    key = popped_key;
                }
            }
        }
    }
}
