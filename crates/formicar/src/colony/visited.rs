//! The cells that an ant has visited, laid out so that the eight around a cell are read at once.

/// A bit for each cell in words of 62 columns, with a bit more on either side that repeats the
/// neighboring word's: the three cells of a row around any cell lie in one word.
#[derive(Clone, Debug)]
pub(super) struct VisitedCells {
    words: Vec<u64>,
    words_per_row: usize,
}

/// Columns to a word.
const COLUMNS: usize = 62;

/// The word and the bit of a cell.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct BitAddress(u32);

impl BitAddress {
    fn word(self) -> usize {
        (self.0 >> 6) as usize
    }

    fn bit(self) -> u32 {
        self.0 & 63
    }
}

impl VisitedCells {
    pub(super) fn new(n_cols: usize, n_rows: usize) -> Self {
        let words_per_row = Self::words_per_row(n_cols);
        Self {
            words: vec![0; words_per_row * (n_rows + 2)],
            words_per_row,
        }
    }

    /// A word more than the columns fill, for what the last one repeats.
    fn words_per_row(n_cols: usize) -> usize {
        n_cols.div_ceil(COLUMNS) + 1
    }

    /// The address of a cell on a grid of `n_cols` columns.
    pub(super) fn address(n_cols: usize, col: usize, row: usize) -> BitAddress {
        let word = (row + 1) * Self::words_per_row(n_cols) + col / COLUMNS;
        BitAddress((word << 6 | (col % COLUMNS + 1)) as u32)
    }

    /// The visited neighbors of a cell as bits in the order of [`STEPS`](crate::map::STEPS).
    #[inline]
    pub(super) fn around(&self, address: BitAddress) -> u8 {
        let (word, shift) = (address.word(), address.bit() - 1);
        let three = |word: usize| (self.words[word] >> shift & 7) as usize;
        let below = three(word - self.words_per_row);
        let above = three(word + self.words_per_row);
        AROUND[below | three(word) << 3 | above << 6]
    }

    /// Marks a cell as visited.
    #[inline]
    pub(super) fn mark(&mut self, address: BitAddress) {
        let (word, bit) = (address.word(), address.bit());
        self.words[word] |= 1 << bit;
        if bit == 1 {
            self.words[word - 1] |= 1 << (COLUMNS + 1);
        } else if bit == COLUMNS as u32 {
            self.words[word + 1] |= 1;
        }
    }

    /// Clears all marks; `addresses` must hold each of them.
    pub(super) fn clear(&mut self, addresses: &[BitAddress]) {
        for address in addresses {
            let word = address.word();
            self.words[word - 1..word + 2].fill(0);
        }
    }
}

/// From nine bits, rows from below and columns from the west, to the order of
/// [`STEPS`](crate::map::STEPS).
const AROUND: [u8; 512] = {
    let mut table = [0; 512];
    let mut key = 0;
    while key < 512 {
        let mut step = 0;
        while step < 8 {
            let (dx, dy) = crate::map::STEPS[step];
            let bit = (dy + 1) * 3 + dx + 1;
            table[key] |= ((key >> bit & 1) as u8) << step;
            step += 1;
        }
        key += 1;
    }
    table
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::STEPS;

    #[test]
    fn sees_its_marks_across_words_and_borders() {
        let (n_cols, n_rows) = (130, 4);
        let mut marks = VisitedCells::new(n_cols, n_rows);
        let mut visited = vec![false; n_cols * n_rows];
        let addresses: Vec<BitAddress> = (0..n_cols * n_rows)
            .filter(|i| i * 7 % 5 < 2)
            .map(|i| {
                visited[i] = true;
                VisitedCells::address(n_cols, i % n_cols, i / n_cols)
            })
            .collect();
        for &address in &addresses {
            marks.mark(address);
        }
        for row in 0..n_rows {
            for col in 0..n_cols {
                let seen = marks.around(VisitedCells::address(n_cols, col, row));
                for (step, (dx, dy)) in STEPS.into_iter().enumerate() {
                    let (c, r) = (col as i32 + dx, row as i32 + dy);
                    let on_grid =
                        (0..n_cols as i32).contains(&c) && (0..n_rows as i32).contains(&r);
                    let expected = on_grid && visited[r as usize * n_cols + c as usize];
                    assert_eq!(
                        seen >> step & 1 == 1,
                        expected,
                        "({col}, {row}) step {step}"
                    );
                }
            }
        }
        marks.clear(&addresses);
        assert!(marks.words.iter().all(|&word| word == 0));
    }
}
