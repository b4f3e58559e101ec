//! The data of a cell that ants read, in one cache line.

use super::visited::BitAddress;

/// A cell as ants see it during an iteration.
#[derive(Clone, Debug, Default)]
#[repr(align(64))]
pub(super) struct Node {
    /// Weights of the steps, those of allowed ones at least 1 and below 2^28.
    weights: [u32; 8],
    /// Numbers of the nodes in the rows above and below, in the order of the steps to them: those
    /// beside a node have the numbers before and after its own.
    across: [u32; 6],
    pub(super) address: BitAddress,
    /// Allowed steps, a bit each.
    pub(super) allowed: u8,
    /// Steps of the first class.
    pub(super) first_class: u8,
}

/// The largest weight: eight of them still fit 32 bits.
const MAX_WEIGHT: f32 = ((1 << 28) - 1) as f32;

/// Products below this get coarse weights, since their scale factor must stay finite.
const LEAST_SCALE: f32 = 1e-30;

/// The integer part of a number from 0 to [`MAX_WEIGHT`]; arbitrary for not-a-number.
///
/// Same result as a cast, but vectorizes to eight at a time: with nearly a half subtracted, adding
/// a large number rounds down, and the lower bits of the sum are the integer part.
#[inline]
fn whole(number: f32) -> u32 {
    const HALF: f64 = 0.5 - 1.0 / (1 << 25) as f64;
    const LARGE: f64 = (3_u64 << 51) as f64;
    ((f64::from(number) - HALF) + LARGE).to_bits() as u32
}

impl Node {
    /// A node without weights.
    pub(super) fn new(address: BitAddress, allowed: u8, first_class: u8) -> Self {
        Self {
            weights: [0; 8],
            across: [0; 6],
            address,
            allowed,
            first_class,
        }
    }

    /// Sets the numbers of the three nodes in the row below and of those above, from the west.
    pub(super) fn link(&mut self, below: [u32; 3], above: [u32; 3]) {
        self.across = [above[2], above[1], above[0], below[0], below[1], below[2]];
    }

    /// The number of the node that a step leads to from this one, whose number is `at`. There must
    /// be one.
    #[inline]
    pub(super) fn next(&self, at: usize, step: usize) -> usize {
        // Of the eight steps the first leads east, the fifth west.
        const PLACES: [usize; 8] = [0, 0, 1, 2, 0, 3, 4, 5];
        let along = if step == 0 {
            at + 1
        } else {
            at.wrapping_sub(1)
        };
        let across = self.across[PLACES[step & 7]] as usize;
        if step.is_multiple_of(4) {
            along
        } else {
            across
        }
    }

    /// Sets the weights from finite products of pheromone and desire; only those of allowed steps
    /// matter, and of these only the proportions.
    ///
    /// As integers they add up without rounding, so that no draw can land on a weight of zero.
    pub(super) fn set_weights(&mut self, products: [f32; 8]) {
        let largest = products.iter().copied().fold(LEAST_SCALE, f32::max);
        let scale = MAX_WEIGHT / largest;
        self.weights = products.map(|product| whole(product * scale) | 1);
    }

    /// Draws one of the steps in a set that is not empty, by weight.
    #[inline]
    pub(super) fn draw(&self, steps: u8, random: u32) -> usize {
        let kept: [u32; 8] = std::array::from_fn(|i| {
            self.weights[i] & 0_u32.wrapping_sub(u32::from(steps) >> i & 1)
        });
        let mut sums = kept;
        // Two halves side by side, then the second on top of the first.
        for i in 1..4 {
            sums[i] += sums[i - 1];
            sums[i + 4] += sums[i + 3];
        }
        for i in 4..8 {
            sums[i] += sums[3];
        }
        let drawn = ((u64::from(random) * u64::from(sums[7])) >> 32) as u32;
        sums.iter().map(|&sum| usize::from(sum <= drawn)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::Seed;

    #[test]
    fn is_one_cache_line() {
        assert_eq!(size_of::<Node>(), 64);
    }

    #[test]
    fn the_whole_part_is_that_of_a_cast() {
        let mut stream = Seed(1).stream([0, 0]);
        let random = (0..20_000).map(|_| stream.unit().powi(9) as f32 * MAX_WEIGHT);
        let near = [1_u32, 2, 3, 4_194_303, 8_388_607, 8_388_609, 16_777_215].map(|n| n as f32);
        let around = near
            .into_iter()
            .flat_map(|n| [n.next_down(), n, n.next_up()]);
        let ends = [0.0, 1e-30, 0.5, MAX_WEIGHT];
        for number in random.chain(around).chain(ends) {
            assert_eq!(whole(number), number as u32, "{number}");
        }
    }

    #[test]
    fn draws_by_weight_and_only_from_the_set() {
        let mut node = Node::default();
        node.set_weights([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 1e-30]);
        let mut stream = Seed(1).stream([0, 0]);
        let mut counts = [0_u32; 8];
        for _ in 0..90_000 {
            counts[node.draw(0b1010_1010, (stream.next_u64() >> 32) as u32)] += 1;
        }
        let shares = counts.map(|n| f64::from(n) / 90_000.0);
        for (step, expected) in [0.0, 2.0, 0.0, 4.0, 0.0, 6.0, 0.0, 0.0]
            .into_iter()
            .enumerate()
        {
            assert!((shares[step] - expected / 12.0).abs() < 0.01, "{shares:?}");
        }
        node.set_weights([1e-40; 8]);
        assert!(node.draw(u8::MAX, u32::MAX) < 8);
        assert_eq!(node.draw(0b1000_0000, u32::MAX), 7);
        assert_eq!(node.draw(0b0000_0001, 0), 0);
    }
}
