//! A set of cells, one bit each, rows padded to whole words.

use super::Cell;

/// A set of cells of a grid, row by row in 64-bit words; bits past the last column are 0.
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

    /// Whether a cell is in the set; cells outside the grid are not.
    pub fn contains(&self, col: i64, row: i64) -> bool {
        let inside =
            (0..self.n_cols as i64).contains(&col) && (0..self.n_rows as i64).contains(&row);
        inside && self.get(col as usize, row as usize)
    }

    /// Whether a cell of the grid is in the set.
    pub fn get(&self, col: usize, row: usize) -> bool {
        self.words[row * self.words_per_row + col / 64] >> (col % 64) & 1 == 1
    }

    /// Puts a cell into the set.
    pub fn insert(&mut self, cell: Cell) {
        let col = cell.col as usize;
        self.row_mut(cell.row as usize)[col / 64] |= 1 << (col % 64);
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

    #[test]
    fn remembers_what_was_put_in() {
        let mut set = BitGrid::new(130, 3);
        let cells = [
            Cell::new(0, 0),
            Cell::new(63, 1),
            Cell::new(64, 1),
            Cell::new(129, 2),
        ];
        for cell in cells {
            set.insert(cell);
        }
        assert_eq!(set.iter().collect::<Vec<_>>(), cells);
        assert_eq!(set.count(), 4);
        assert!(set.contains(129, 2) && !set.contains(130, 2) && !set.contains(-1, 0));
    }
}
