//! A set of lattice states.

/// Open addressing with linear probing; keys are below 2^64 - 1.
pub(super) struct StateSet {
    slots: Vec<u64>,
    n_states: usize,
}

const VACANT: u64 = u64::MAX;

impl StateSet {
    pub(super) fn new() -> Self {
        Self {
            slots: vec![VACANT; 1 << 12],
            n_states: 0,
        }
    }

    /// Whether a state is not in the set.
    pub(super) fn vacant(&self, key: u64) -> bool {
        self.slots[self.place(key)] == VACANT
    }

    pub(super) fn insert(&mut self, key: u64) {
        if 2 * self.n_states >= self.slots.len() {
            self.grow();
        }
        let place = self.place(key);
        self.n_states += usize::from(self.slots[place] == VACANT);
        self.slots[place] = key;
    }

    /// Where a key is, or would go.
    fn place(&self, key: u64) -> usize {
        let mask = self.slots.len() - 1;
        // Fibonacci hashing: the top bits of a product with 2^64 / golden ratio.
        let mut place = (key.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 20) as usize & mask;
        while self.slots[place] != VACANT && self.slots[place] != key {
            place = (place + 1) & mask;
        }
        place
    }

    fn grow(&mut self) {
        let larger = vec![VACANT; 2 * self.slots.len()];
        let old = std::mem::replace(&mut self.slots, larger);
        for key in old.into_iter().filter(|&key| key != VACANT) {
            let place = self.place(key);
            self.slots[place] = key;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::Seed;

    #[test]
    fn holds_what_was_inserted_and_nothing_else() {
        let mut draw = Seed(5).stream([0, 0]);
        let keys: Vec<u64> = (0..20_000).map(|_| draw.next_u64() >> 8 << 1).collect();
        let mut set = StateSet::new();
        keys.iter().for_each(|&key| set.insert(key));
        assert!(keys.iter().all(|&key| !set.vacant(key)));
        assert!(keys.iter().all(|&key| set.vacant(key | 1)));
    }
}
