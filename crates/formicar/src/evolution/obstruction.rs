//! The length of a straight segment inside blocked cells.

use crate::map::{BitGrid, Cell};

/// Length of the segment between the centers of two cells inside blocked cells, cells.
///
/// Row by row: the segment covers an interval of columns in each row, of which whole words of
/// blocked cells are counted at once and the two cells at its ends by their shares. Takes time in
/// proportion to the rows, and to a 64th of the columns.
pub(super) fn blocked_length(blocked: &BitGrid, from: Cell, to: Cell) -> f64 {
    let (low, high) = if from.row <= to.row {
        (from, to)
    } else {
        (to, from)
    };
    let center = |index: u32| f64::from(index) + 0.5;
    let (x0, x1) = (center(low.col), center(high.col));
    let n_rows = high.row - low.row;
    if n_rows == 0 {
        return covered(blocked, low.row, x0.min(x1), x0.max(x1));
    }
    let (dx, dy) = (x1 - x0, f64::from(n_rows));
    let length = (dx * dx + dy * dy).sqrt();
    if low.col == high.col {
        let (first, last) = (low.row, high.row);
        let is_blocked = |row: &u32| blocked.contains(i64::from(low.col), i64::from(*row));
        let share = |row: u32| {
            if row == first || row == last {
                0.5
            } else {
                1.0
            }
        };
        return (first..=last).filter(is_blocked).map(share).sum();
    }
    // The segment enters row k above the lowest half a row before k rows are done.
    let at = |k: u32| x0 + dx * ((f64::from(k) - 0.5) / dy).clamp(0.0, 1.0);
    let columns: f64 = (0..=n_rows)
        .map(|k| {
            let (enters, leaves) = (at(k), at(k + 1));
            let row = low.row + k;
            covered(blocked, row, enters.min(leaves), enters.max(leaves))
        })
        .sum();
    columns * length / dx.abs()
}

/// Length of an interval of a row inside blocked cells; column c reaches from c to c + 1.
fn covered(blocked: &BitGrid, row: u32, x0: f64, x1: f64) -> f64 {
    let words = blocked.row(row as usize);
    let is_blocked = |col: usize| {
        words
            .get(col / 64)
            .is_some_and(|w| w >> (col % 64) & 1 == 1)
    };
    let (first, last) = (x0 as usize, x1 as usize);
    if first == last {
        return if is_blocked(first) { x1 - x0 } else { 0.0 };
    }
    let mut length = 0.0;
    if is_blocked(first) {
        length += (first + 1) as f64 - x0;
    }
    if is_blocked(last) {
        length += x1 - last as f64;
    }
    length + f64::from(n_set(words, first + 1, last))
}

/// Set bits from one place up to, but not including, another.
fn n_set(words: &[u64], from: usize, end: usize) -> u32 {
    if from >= end {
        return 0;
    }
    let (first, last) = (from / 64, (end - 1) / 64);
    let from_first = u64::MAX << (from % 64);
    let to_last = u64::MAX >> (63 - (end - 1) % 64);
    if first == last {
        return (words[first] & from_first & to_last).count_ones();
    }
    let between = words[first + 1..last].iter().map(|w| w.count_ones());
    (words[first] & from_first).count_ones()
        + between.sum::<u32>()
        + (words[last] & to_last).count_ones()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The part of a segment in a closed unit square, by clipping.
    fn clipped(a: (f64, f64), b: (f64, f64), cell: Cell) -> f64 {
        let (mut low, mut high) = (0.0_f64, 1.0_f64);
        for (from, to, least) in [
            (a.0, b.0, f64::from(cell.col)),
            (a.1, b.1, f64::from(cell.row)),
        ] {
            if from == to {
                if !(least..least + 1.0).contains(&from) {
                    return 0.0;
                }
                continue;
            }
            let ends = [
                (least - from) / (to - from),
                (least + 1.0 - from) / (to - from),
            ];
            low = low.max(ends[0].min(ends[1]));
            high = high.min(ends[0].max(ends[1]));
        }
        (high - low).max(0.0) * (b.0 - a.0).hypot(b.1 - a.1)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(ProptestConfig::default().cases / 5))]

        #[test]
        fn is_what_clipping_at_every_blocked_cell_gives(
            ends in prop::array::uniform4(0_u32..150),
            bits in prop::collection::vec(prop::bool::weighted(0.3), 150 * 24),
        ) {
            let mut blocked = BitGrid::new(150, 24);
            for (i, _) in bits.iter().enumerate().filter(|(_, is_set)| **is_set) {
                blocked.insert(Cell::new((i % 150) as u32, (i / 150) as u32));
            }
            let (a, b) = (Cell::new(ends[0], ends[1] % 24), Cell::new(ends[2], ends[3] % 24));
            let center = |cell: Cell| (f64::from(cell.col) + 0.5, f64::from(cell.row) + 0.5);
            let expected: f64 = blocked.iter().map(|c| clipped(center(a), center(b), c)).sum();
            prop_assert!((blocked_length(&blocked, a, b) - expected).abs() < 1e-9);
            prop_assert!((blocked_length(&blocked, b, a) - expected).abs() < 1e-9);
        }
    }
}
