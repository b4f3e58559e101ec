//! Sets of places as bits, which move all at once.

/// Bits 0, 1, 2, ... of a fixed number of words.
pub(super) type Bits = Vec<u64>;

pub(super) fn words(n_bits: usize) -> usize {
    n_bits.div_ceil(64)
}

pub(super) fn contains(bits: &[u64], at: usize) -> bool {
    bits.get(at / 64)
        .is_some_and(|word| word >> (at % 64) & 1 == 1)
}

pub(super) fn insert(bits: &mut [u64], at: usize) {
    bits[at / 64] |= 1 << (at % 64);
}

/// Removes the bits from one place up to another.
pub(super) fn clear(bits: &mut [u64], from: usize, to: usize) {
    let to = to.min(64 * bits.len());
    if from >= to {
        return;
    }
    let (first, last) = (from / 64, (to - 1) / 64);
    let (low, high) = (!0 << (from % 64), !0 >> (63 - (to - 1) % 64));
    if first == last {
        bits[first] &= !(low & high);
        return;
    }
    bits[first] &= !low;
    bits[first + 1..last].fill(0);
    bits[last] &= !high;
}

/// Adds the bits of another set, each moved up.
pub(super) fn unite_moved(bits: &mut [u64], other: &[u64], by: usize) {
    let (by_words, by_bits) = (by / 64, by % 64);
    for at in by_words..bits.len() {
        let word = other[at - by_words] << by_bits;
        let below = match (by_bits, at - by_words) {
            (0, _) | (_, 0) => 0,
            (_, from) => other[from - 1] >> (64 - by_bits),
        };
        bits[at] |= word | below;
    }
}

/// The highest bit at most at a place.
pub(super) fn highest(bits: &[u64], at_most: usize) -> Option<usize> {
    (0..=at_most / 64).rev().find_map(|at| {
        let word = bits.get(at).copied().unwrap_or_default();
        let word = if at == at_most / 64 {
            word & (!0 >> (63 - at_most % 64))
        } else {
            word
        };
        (word != 0).then(|| 64 * at + 63 - word.leading_zeros() as usize)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set(places: &[usize]) -> Bits {
        let mut bits = vec![0; words(300)];
        for &at in places {
            insert(&mut bits, at);
        }
        bits
    }

    #[test]
    fn bits_move_and_are_cleared_across_words() {
        for by in [0, 1, 63, 64, 65, 130] {
            let mut moved = set(&[]);
            unite_moved(&mut moved, &set(&[0, 5, 63, 64, 128]), by);
            assert_eq!(moved, set(&[by, 5 + by, 63 + by, 64 + by, 128 + by]));
        }
        for (from, to) in [(0, 1), (10, 20), (60, 70), (64, 128), (5, 200), (7, 7)] {
            let all: Vec<_> = (0..300).collect();
            let mut bits = set(&all);
            clear(&mut bits, from, to);
            let left: Vec<_> = (0..300).filter(|at| !(from..to).contains(at)).collect();
            assert_eq!(bits, set(&left), "{from} {to}");
        }
        let bits = set(&[3, 70, 200]);
        let found = [2, 3, 69, 70, 299].map(|at| highest(&bits, at));
        assert_eq!(found, [None, Some(3), Some(3), Some(70), Some(200)]);
    }
}
