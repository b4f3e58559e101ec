//! The least cost at which each lattice state was reached.

/// Open addressing with linear probing; keys are below 2^64 - 1.
pub(super) struct StateCosts {
    slots: Vec<(u64, f32)>,
    n_states: usize,
}

const VACANT: u64 = u64::MAX;
/// The cost of a state that is done with.
const CLOSED: f32 = f32::NEG_INFINITY;

impl StateCosts {
    pub(super) fn new() -> Self {
        Self {
            slots: vec![(VACANT, f32::INFINITY); 1 << 12],
            n_states: 0,
        }
    }

    /// Whether reaching a state at a cost would be better than what is known.
    pub(super) fn improves(&self, key: u64, cost: f64) -> bool {
        (cost as f32) < self.slots[self.place(key)].1
    }

    /// Notes that a state was reached at a cost.
    pub(super) fn reach(&mut self, key: u64, cost: f64) {
        self.put(key, cost as f32);
    }

    /// Whether a state is done with.
    pub(super) fn is_closed(&self, key: u64) -> bool {
        self.slots[self.place(key)].1 == CLOSED
    }

    /// Notes that a state is done with: nothing improves it any more.
    pub(super) fn close(&mut self, key: u64) {
        self.put(key, CLOSED);
    }

    fn put(&mut self, key: u64, cost: f32) {
        if 2 * self.n_states >= self.slots.len() {
            self.grow();
        }
        let place = self.place(key);
        self.n_states += usize::from(self.slots[place].0 == VACANT);
        self.slots[place] = (key, cost);
    }

    /// The slot of a key, or the free slot for it.
    fn place(&self, key: u64) -> usize {
        let mask = self.slots.len() - 1;
        // Fibonacci hashing: the upper bits of a product with 2^64 / golden ratio.
        let mut place = (key.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 20) as usize & mask;
        while self.slots[place].0 != VACANT && self.slots[place].0 != key {
            place = (place + 1) & mask;
        }
        place
    }

    fn grow(&mut self) {
        let larger = vec![(VACANT, f32::INFINITY); 2 * self.slots.len()];
        let old = std::mem::replace(&mut self.slots, larger);
        for slot in old.into_iter().filter(|slot| slot.0 != VACANT) {
            let place = self.place(slot.0);
            self.slots[place] = slot;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::Seed;

    #[test]
    fn remembers_costs_while_growing() {
        let mut draw = Seed(5).stream([0, 0]);
        let keys: Vec<u64> = (0..20_000).map(|_| draw.next_u64() >> 8 << 1).collect();
        let mut states = StateCosts::new();
        for (i, &key) in keys.iter().enumerate() {
            states.reach(key, 2.0);
            if i % 2 == 0 {
                states.close(key);
            }
        }
        for (i, &key) in keys.iter().enumerate() {
            assert_eq!(states.is_closed(key), i % 2 == 0);
            assert_eq!(states.improves(key, 1.0), i % 2 == 1);
            assert!(!states.improves(key, 2.0));
            assert!(states.improves(key | 1, 1e9));
        }
    }
}
