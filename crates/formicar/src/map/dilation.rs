//! Sets of cells grown by a disc, a word of cells at a time.

use super::BitGrid;
use super::bit_grid::shifted;

impl BitGrid {
    /// The cells whose centers lie within a distance of that of a cell of the set, given as the
    /// squared distance in cells.
    ///
    /// Each row is widened to the chords of the disc, narrowest first, and laid over the rows that
    /// these chords reach: cost is proportional to words times radius.
    #[must_use]
    pub fn grown(&self, squared_radius: u16) -> Self {
        let mut grown = Self::new(self.n_cols(), self.n_rows());
        let mut widened = Vec::new();
        for row in 0..self.n_rows() {
            if self.row(row).iter().any(|&word| word != 0) {
                widened.clear();
                widened.extend_from_slice(self.row(row));
                grown.lay_disc(row, &mut widened, usize::from(squared_radius));
            }
        }
        grown.clear_padding();
        grown
    }

    /// Puts in what lies within a distance of the cells of a row, which is widened on the way.
    fn lay_disc(&mut self, row: usize, widened: &mut [u64], squared_radius: usize) {
        let mut reach = 0;
        for dy in (0..=squared_radius.isqrt()).rev() {
            let half_chord = (squared_radius - dy * dy).isqrt();
            while reach < half_chord {
                // No gap opens between copies that are shifted by no more than their width.
                let step = (half_chord - reach).min(2 * reach + 1).min(63);
                widen(widened, step);
                reach += step;
            }
            let above = Some(row + dy).filter(|&above| above < self.n_rows());
            for row in [row.checked_sub(dy), above].into_iter().flatten() {
                let words = self.row_mut(row).iter_mut().zip(&*widened);
                words.for_each(|(word, widened)| *word |= widened);
            }
        }
    }
}

/// Adds to a row of bits its copies that are shifted by a number of columns both ways, below 64.
fn widen(words: &mut [u64], n_cols: usize) {
    let mut before = 0;
    for i in 0..words.len() {
        let here = words[i];
        let after = words.get(i + 1).copied().unwrap_or(0);
        words[i] |= shifted(here, after, n_cols) | shifted(before, here, 64 - n_cols);
        before = here;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::Cell;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn holds_every_cell_that_is_near_enough_and_no_other(
            n_cols in 1_usize..200,
            n_rows in 1_usize..40,
            squared_radius in prop_oneof![0_u16..40, 40_u16..9000],
            places in prop::collection::vec((0.0..1.0, 0.0..1.0), 0..20),
        ) {
            let mut cells = BitGrid::new(n_cols, n_rows);
            for (x, y) in places {
                cells.insert(Cell::new((x * n_cols as f64) as u32, (y * n_rows as f64) as u32));
            }
            let mut expected = BitGrid::new(n_cols, n_rows);
            for cell in (0..n_rows as u32).flat_map(|row| (0..n_cols as u32).map(move |col| Cell::new(col, row))) {
                let squared = |other: Cell| cell.col.abs_diff(other.col).pow(2) + cell.row.abs_diff(other.row).pow(2);
                if cells.iter().any(|other| squared(other) <= u32::from(squared_radius)) {
                    expected.insert(cell);
                }
            }
            prop_assert_eq!(cells.grown(squared_radius), expected);
        }
    }
}
