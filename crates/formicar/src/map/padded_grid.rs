//! Obstacles with a frame of blocked cells around the map, so that what reaches over the border
//! meets something.

use super::BitGrid;
use super::bit_grid::shifted;
use std::ops::Range;

/// A set of cells that everything off the grid belongs to, up to a reach; in 64-bit words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PaddedGrid {
    words: Vec<u64>,
    words_per_row: usize,
    n_words_before: usize,
    n_rows_before: usize,
    reach_cells: usize,
}

impl PaddedGrid {
    /// The cells of a grid, and all cells up to `reach_cells` away from it.
    pub fn new(cells: &BitGrid, reach_cells: usize) -> Self {
        let n_words_before = reach_cells.div_ceil(64);
        // A word more at the end, since windows read two at a time.
        let words_per_row = n_words_before + (cells.n_cols() + reach_cells).div_ceil(64) + 1;
        let mut padded = Self {
            words: vec![u64::MAX; words_per_row * (cells.n_rows() + 2 * reach_cells)],
            words_per_row,
            n_words_before,
            n_rows_before: reach_cells,
            reach_cells,
        };
        padded.refresh(cells, 0..cells.n_rows());
        padded
    }

    /// Takes over some rows of the grid anew.
    pub fn refresh(&mut self, cells: &BitGrid, rows: Range<usize>) {
        let n_last = cells.n_cols() % 64;
        for row in rows {
            let source = cells.row(row);
            let first = (row + self.n_rows_before) * self.words_per_row + self.n_words_before;
            let target = &mut self.words[first..first + source.len()];
            target.copy_from_slice(source);
            if n_last != 0 {
                target[source.len() - 1] |= u64::MAX << n_last;
            }
        }
    }

    /// Most cells that a window may begin or end off the map.
    pub fn reach_cells(&self) -> usize {
        self.reach_cells
    }

    /// True if a window of cells holds none of the set: rows of words from the cell (`col`, `row`)
    /// on, lowest columns first, `words_per_row` of them per row.
    ///
    /// The window must not reach farther off the map than [`Self::reach_cells`].
    #[inline]
    pub fn is_clear(&self, (col, row): (i64, i64), window: &[u64], words_per_row: usize) -> bool {
        let col = (col + 64 * self.n_words_before as i64) as usize;
        let row = (row + self.n_rows_before as i64) as usize;
        let (first, shift) = (row * self.words_per_row + col / 64, col % 64);
        let rows = self.words[first..].chunks(self.words_per_row);
        let hit = if words_per_row == 1 {
            let pairs = window.iter().zip(rows);
            pairs.fold(0, |hit, (&mask, row)| {
                hit | mask & shifted(row[0], row[1], shift)
            })
        } else {
            let pairs = window.chunks_exact(words_per_row).zip(rows);
            pairs.fold(0, |hit, (masks, row)| {
                let words = masks.iter().zip(row.windows(2));
                words.fold(hit, |hit, (&mask, pair)| {
                    hit | mask & shifted(pair[0], pair[1], shift)
                })
            })
        };
        hit == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_window_is_clear_where_each_of_its_cells_is(
            n_cols in 1_usize..200,
            n_rows in 1_usize..30,
            seed in any::<u64>(),
            corner in (-70_i64..200, -70_i64..30),
            words_per_row in 1_usize..3,
        ) {
            let mut draw = crate::numeric::Seed(seed).stream([0, 0]);
            let mut cells = BitGrid::new(n_cols, n_rows);
            for _ in 0..20 {
                cells.insert(crate::map::Cell::new(draw.below(n_cols) as u32, draw.below(n_rows) as u32));
            }
            let padded = PaddedGrid::new(&cells, 200);
            let mut window = vec![0_u64; 3 * words_per_row];
            for _ in 0..4 {
                let bit = draw.below(window.len() * 64);
                window[bit / 64] |= 1 << (bit % 64);
            }
            let is_set = |(col, row): (i64, i64)| {
                let inside = (0..n_cols as i64).contains(&col) && (0..n_rows as i64).contains(&row);
                !inside || cells.get(col as usize, row as usize)
            };
            let expected = (0..window.len() * 64).filter(|bit| window[bit / 64] >> (bit % 64) & 1 == 1).all(|bit| {
                let width = 64 * words_per_row;
                !is_set((corner.0 + (bit % width) as i64, corner.1 + (bit / width) as i64))
            });
            prop_assert_eq!(padded.is_clear(corner, &window, words_per_row), expected);
        }
    }
}
