//! A set of cells, one bit each, rows padded to whole words.

use super::Cell;
use std::ops::Range;

/// A set of cells of a grid, row by row in 64-bit words; bits past the last column are 0.
///
/// ```
/// use formicar::map::{BitGrid, Cell};
///
/// let mut set = BitGrid::new(100, 3);
/// set.insert(Cell::new(70, 1));
/// assert!(set.get(70, 1) && !set.contains(-1, 0));
/// assert_eq!((set.count(), set.complement().count()), (1, 299));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BitGrid {
    n_cols: usize,
    n_rows: usize,
    words_per_row: usize,
    words: Vec<u64>,
}

impl BitGrid {
    /// The empty set of an `n_cols` x `n_rows` grid.
    pub fn new(n_cols: usize, n_rows: usize) -> Self {
        let words_per_row = n_cols.div_ceil(64);
        Self {
            n_cols,
            n_rows,
            words_per_row,
            words: vec![0; words_per_row * n_rows],
        }
    }

    /// The cells whose values meet a condition, values row by row.
    pub(crate) fn of_values<T: Copy>(
        n_cols: usize,
        values: &[T],
        is_in: impl Fn(T) -> bool,
    ) -> Self {
        let mut cells = Self::new(n_cols, values.len() / n_cols);
        for (row, values) in values.chunks_exact(n_cols).enumerate() {
            for (word, values) in cells.row_mut(row).iter_mut().zip(values.chunks(64)) {
                let mut flags = [0; 64];
                for (flag, &value) in flags.iter_mut().zip(values) {
                    *flag = u8::from(is_in(value));
                }
                *word = packed(&flags);
            }
        }
        cells
    }

    /// Number of columns.
    pub fn n_cols(&self) -> usize {
        self.n_cols
    }

    /// Number of rows.
    pub fn n_rows(&self) -> usize {
        self.n_rows
    }

    /// The words of a row, lowest columns first.
    pub fn row(&self, row: usize) -> &[u64] {
        &self.words[row * self.words_per_row..][..self.words_per_row]
    }

    /// The words of a row, to be written; bits past the last column must stay 0.
    pub fn row_mut(&mut self, row: usize) -> &mut [u64] {
        &mut self.words[row * self.words_per_row..][..self.words_per_row]
    }

    /// All words, row by row.
    pub fn words(&self) -> &[u64] {
        &self.words
    }

    /// The part of the set in some columns, of which the first is a multiple of 64, and rows; as a
    /// set of a grid of that size.
    #[must_use]
    pub fn window(&self, cols: Range<usize>, rows: Range<usize>) -> Self {
        debug_assert!(cols.start.is_multiple_of(64) && cols.end <= self.n_cols);
        let mut window = Self::new(cols.len(), rows.len());
        for (i, row) in rows.enumerate() {
            let source = &self.row(row)[cols.start / 64..cols.end.div_ceil(64)];
            window.row_mut(i).copy_from_slice(source);
        }
        window.clear_padding();
        window
    }

    /// True if a cell is in the set; cells outside the grid are not.
    pub fn contains(&self, col: i64, row: i64) -> bool {
        let inside =
            (0..self.n_cols as i64).contains(&col) && (0..self.n_rows as i64).contains(&row);
        inside && self.get(col as usize, row as usize)
    }

    /// True if a cell of the grid is in the set.
    pub fn get(&self, col: usize, row: usize) -> bool {
        self.words[row * self.words_per_row + col / 64] >> (col % 64) & 1 == 1
    }

    /// Puts a cell into the set.
    pub fn insert(&mut self, cell: Cell) {
        let col = cell.col as usize;
        self.row_mut(cell.row as usize)[col / 64] |= 1 << (col % 64);
    }

    /// Takes a cell out of the set.
    pub fn remove(&mut self, cell: Cell) {
        let col = cell.col as usize;
        self.row_mut(cell.row as usize)[col / 64] &= !(1 << (col % 64));
    }

    /// Takes some cells out of the set.
    pub fn remove_all(&mut self, cells: impl IntoIterator<Item = Cell>) {
        for cell in cells {
            self.remove(cell);
        }
    }

    /// Puts all cells of another set of the same grid into this one.
    pub fn unite(&mut self, other: &Self) {
        debug_assert_eq!((self.n_cols, self.n_rows), (other.n_cols, other.n_rows));
        for (word, other) in self.words.iter_mut().zip(&other.words) {
            *word |= other;
        }
    }

    /// The cells of the grid that are not in the set.
    #[must_use]
    pub fn complement(&self) -> Self {
        let mut complement = self.clone();
        for word in &mut complement.words {
            *word = !*word;
        }
        complement.clear_padding();
        complement
    }

    /// Empties the bits past the last column.
    pub(crate) fn clear_padding(&mut self) {
        let n_last = self.n_cols % 64;
        if n_last == 0 {
            return;
        }
        for row in self.words.chunks_exact_mut(self.words_per_row) {
            row[self.words_per_row - 1] &= (1 << n_last) - 1;
        }
    }

    /// The runs of a row's cells that are in the set, as long as they go.
    pub fn runs(&self, row: usize) -> impl Iterator<Item = Range<usize>> + '_ {
        runs(self.row(row), self.n_cols, u64::MAX)
    }

    /// The runs of a row's cells that are not in the set, as long as they go.
    pub fn gaps(&self, row: usize) -> impl Iterator<Item = Range<usize>> + '_ {
        runs(self.row(row), self.n_cols, 0)
    }

    /// Number of cells in the set.
    pub fn count(&self) -> usize {
        self.words.iter().map(|w| w.count_ones() as usize).sum()
    }

    /// The cells in the set, row by row.
    pub fn iter(&self) -> impl Iterator<Item = Cell> + '_ {
        (0..self.n_rows).flat_map(move |row| {
            self.row(row)
                .iter()
                .enumerate()
                .flat_map(move |(w, &word)| {
                    set_bits(word).map(move |bit| Cell::new((w * 64) as u32 + bit, row as u32))
                })
        })
    }
}

impl Extend<Cell> for BitGrid {
    fn extend<T: IntoIterator<Item = Cell>>(&mut self, cells: T) {
        for cell in cells {
            self.insert(cell);
        }
    }
}

/// The bits of 64 flags, each 0 or 1, the first lowest.
fn packed(flags: &[u8; 64]) -> u64 {
    // The product brings the flag of byte i to bit 56 + i; no two of its terms meet.
    const GATHER: u64 = 0x0102_0408_1020_4080;
    let (eights, _) = flags.as_chunks();
    let bytes = eights.iter().enumerate();
    bytes.fold(0, |word, (i, &eight)| {
        let byte = u64::from_le_bytes(eight).wrapping_mul(GATHER) >> 56;
        word | byte << (8 * i)
    })
}

/// The runs of columns whose bit is that of `wanted`, all ones or all zeros.
fn runs(words: &[u64], n_cols: usize, wanted: u64) -> impl Iterator<Item = Range<usize>> {
    let mut end = 0;
    std::iter::from_fn(move || {
        let first = next_cell(words, end, n_cols, wanted);
        end = next_cell(words, first, n_cols, !wanted);
        (first < n_cols).then_some(first..end)
    })
}

/// The first column from `col` on whose bit is that of `wanted`, or `n_cols`.
fn next_cell(words: &[u64], col: usize, n_cols: usize, wanted: u64) -> usize {
    let mut mask = u64::MAX << (col % 64);
    for (w, &word) in words.iter().enumerate().skip(col / 64) {
        let hits = (word ^ !wanted) & mask;
        if hits != 0 {
            return (w * 64 + hits.trailing_zeros() as usize).min(n_cols);
        }
        mask = u64::MAX;
    }
    n_cols
}

/// 64 bits from `shift` bits into the first of two words on.
#[inline]
pub(crate) fn shifted(low: u64, high: u64, shift: usize) -> u64 {
    // Shifted twice, so that a shift by a whole word is none.
    low >> shift | high << 1 << (63 - shift)
}

/// The places of the set bits of a word, lowest first.
pub(crate) fn set_bits(mut word: u64) -> impl Iterator<Item = u32> {
    std::iter::from_fn(move || {
        (word != 0).then(|| {
            let bit = word.trailing_zeros();
            word &= word - 1;
            bit
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn remembers_what_was_put_in() {
        let mut set = BitGrid::new(130, 3);
        let cells = [
            Cell::new(0, 0),
            Cell::new(63, 1),
            Cell::new(64, 1),
            Cell::new(129, 2),
        ];
        set.extend(cells);
        assert_eq!(set.iter().collect::<Vec<_>>(), cells);
        assert_eq!(set.count(), 4);
        assert!(set.contains(129, 2) && !set.contains(130, 2) && !set.contains(-1, 0));
        set.remove_all([Cell::new(63, 1)]);
        assert_eq!(set.runs(1).next(), Some(64..65));
        assert_eq!(set.gaps(1).collect::<Vec<_>>(), [0..64, 65..130]);
        let complement = set.complement();
        assert_eq!(complement.count(), 3 * 130 - 3);
        set.unite(&complement);
        assert_eq!(set.runs(2).next(), Some(0..130));
    }

    proptest! {
        #[test]
        fn holds_the_cells_whose_values_meet_a_condition(
            n_cols in 1_usize..200,
            values in proptest::collection::vec(any::<i8>(), 0..600),
        ) {
            let values = &values[..values.len() / n_cols * n_cols];
            let set = BitGrid::of_values(n_cols, values, |value| value < 0);
            prop_assert_eq!(set.n_rows() * n_cols, values.len());
            for (i, &value) in values.iter().enumerate() {
                prop_assert_eq!(set.get(i % n_cols, i / n_cols), value < 0);
            }
            prop_assert_eq!(set.count(), set.iter().count());
        }
    }
}
