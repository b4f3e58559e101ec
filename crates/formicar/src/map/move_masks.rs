//! The allowed moves of every cell in one byte each.

use super::neighborhood::{DiagonalRule, STEPS};
use super::{BitGrid, Cell};
use std::ops::Range;

/// For each cell the set of its allowed steps to neighbors: bit `i` stands for [`STEPS`]`[i]`.
///
/// A step leads from a free cell to a free cell of the grid and obeys the diagonal rule, so that
/// the opposite step is always allowed too. Built 64 cells at a time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MoveMasks {
    blocked: BitGrid,
    rule: DiagonalRule,
    masks: Vec<u8>,
}

impl MoveMasks {
    /// The moves between the cells that are not blocked.
    pub fn new(blocked: &BitGrid, rule: DiagonalRule) -> Self {
        let (n_cols, n_rows) = (blocked.n_cols(), blocked.n_rows());
        let mut moves = Self {
            blocked: blocked.clone(),
            rule,
            masks: vec![0; n_cols * n_rows],
        };
        moves.refresh(0..n_cols.div_ceil(64), 0..n_rows);
        moves
    }

    /// Changes which cells are blocked, within a range of columns and of rows, and the moves of
    /// these cells and their neighbors.
    ///
    /// Cost is proportional to the cells of both ranges.
    pub fn change(
        &mut self,
        cols: Range<usize>,
        rows: Range<usize>,
        change: impl FnOnce(&mut BitGrid),
    ) {
        change(&mut self.blocked);
        let grown =
            |range: Range<usize>, n: usize| range.start.saturating_sub(1)..(range.end + 1).min(n);
        let (cols, rows) = (grown(cols, self.n_cols()), grown(rows, self.n_rows()));
        self.refresh(cols.start / 64..cols.end.div_ceil(64), rows);
    }

    /// Works out the moves in a range of words and of rows.
    fn refresh(&mut self, words: Range<usize>, rows: Range<usize>) {
        let n_cols = self.n_cols();
        let cols = words.start * 64..n_cols.min(words.end * 64);
        let free = |buffer: Vec<u64>, row: i64, blocked: &BitGrid| {
            load_free(buffer, blocked, row, words.start)
        };
        let first_row = rows.start as i64;
        let [mut below, mut here, mut above] =
            [-1, 0, 1].map(|row| free(vec![0; words.len() + 2], first_row + row, &self.blocked));
        for row in rows {
            let cells = &mut self.masks[row * n_cols..][cols.clone()];
            for (w, cells) in cells.chunks_mut(64).enumerate() {
                let rows = [&below, &here, &above].map(|free| shifts(&free[w..w + 3]));
                cells.copy_from_slice(&interleave(moves(rows, self.rule))[..cells.len()]);
            }
            std::mem::swap(&mut below, &mut here);
            std::mem::swap(&mut here, &mut above);
            above = free(above, row as i64 + 2, &self.blocked);
        }
    }

    /// Number of columns.
    pub fn n_cols(&self) -> usize {
        self.blocked.n_cols()
    }

    /// Number of rows.
    pub fn n_rows(&self) -> usize {
        self.blocked.n_rows()
    }

    /// The cells on which nothing may stand.
    pub fn blocked(&self) -> &BitGrid {
        &self.blocked
    }

    /// The rule that diagonal steps obey.
    pub fn rule(&self) -> DiagonalRule {
        self.rule
    }

    /// The allowed steps of a cell.
    pub fn moves(&self, cell: Cell) -> u8 {
        self.masks[self.index(cell)]
    }

    /// The allowed steps of all cells, row by row.
    pub fn as_slice(&self) -> &[u8] {
        &self.masks
    }

    /// The place of a cell, row by row.
    pub fn index(&self, cell: Cell) -> usize {
        cell.row as usize * self.n_cols() + cell.col as usize
    }

    /// The cell at a place.
    pub fn cell(&self, index: usize) -> Cell {
        let n_cols = self.n_cols();
        Cell::new((index % n_cols) as u32, (index / n_cols) as u32)
    }

    /// The change of a cell's index by each of [`STEPS`].
    pub fn offsets(&self) -> [isize; 8] {
        STEPS.map(|(dx, dy)| dy as isize * self.n_cols() as isize + dx as isize)
    }
}

/// The free cells of a row, none off the grid, from the word before `first` on.
fn load_free(mut words: Vec<u64>, blocked: &BitGrid, row: i64, first: usize) -> Vec<u64> {
    words.fill(0);
    if !(0..blocked.n_rows() as i64).contains(&row) {
        return words;
    }
    let n_before = first.min(1);
    let source = &blocked.row(row as usize)[first - n_before..];
    for (free, &blocked) in words[1 - n_before..].iter_mut().zip(source) {
        *free = !blocked;
    }
    let (last, n_last) = (blocked.n_cols() / 64, blocked.n_cols() % 64);
    if n_last != 0 && last + 1 - first < words.len() {
        words[last + 1 - first] &= (1 << n_last) - 1;
    }
    words
}

/// The middle of three words seen from one column to the east, from here, and from the west: bit
/// `i` of the results is bit `i - 1`, `i` and `i + 1` of the row.
fn shifts(words: &[u64]) -> [u64; 3] {
    [
        words[1] << 1 | words[0] >> 63,
        words[1],
        words[1] >> 1 | words[2] << 63,
    ]
}

/// For each of [`STEPS`] the cells that may take it; from free cells by row (below, here, above)
/// and column (west, here, east).
fn moves(free: [[u64; 3]; 3], rule: DiagonalRule) -> [u64; 8] {
    let at = |(dx, dy): (i32, i32)| free[(dy + 1) as usize][(dx + 1) as usize];
    STEPS.map(|(dx, dy)| {
        let (beside, ahead) = (at((dx, 0)), at((0, dy)));
        let corner = match rule {
            DiagonalRule::Always => u64::MAX,
            DiagonalRule::AtMostOneObstacle => beside | ahead,
            DiagonalRule::NoObstacles => beside & ahead,
        };
        // For a straight step one of the two is the cell itself, the other its target.
        at((0, 0)) & at((dx, dy)) & corner
    })
}

/// Byte `i` of the result holds bit `i` of each word: a transpose by swaps of ever smaller blocks
/// (Warren, Hacker's Delight, 7-3), first of bits within bytes, then of bytes.
fn interleave(mut words: [u64; 8]) -> [u8; 64] {
    const BITS: [(usize, u64); 3] = [
        (4, 0x0F0F_0F0F_0F0F_0F0F),
        (2, 0x3333_3333_3333_3333),
        (1, 0x5555_5555_5555_5555),
    ];
    const BYTES: [(usize, u64); 3] = [
        (4, 0x0000_0000_FFFF_FFFF),
        (2, 0x0000_FFFF_0000_FFFF),
        (1, 0x00FF_00FF_00FF_00FF),
    ];
    for (distance, mask) in BITS {
        swap_blocks(&mut words, distance, distance, mask);
    }
    for (distance, mask) in BYTES {
        swap_blocks(&mut words, distance, 8 * distance, mask);
    }
    let mut bytes = [0; 64];
    for (bytes, word) in bytes.as_chunks_mut::<8>().0.iter_mut().zip(words) {
        *bytes = word.to_le_bytes();
    }
    bytes
}

fn swap_blocks(words: &mut [u64; 8], distance: usize, shift: usize, mask: u64) {
    for i in (0..8).filter(|i| i & distance == 0) {
        let swapped = (words[i] >> shift ^ words[i + distance]) & mask;
        words[i + distance] ^= swapped;
        words[i] ^= swapped << shift;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn by_definition(blocked: &BitGrid, rule: DiagonalRule, cell: Cell) -> u8 {
        let free = |dx: i32, dy: i32| {
            let (col, row) = (
                i64::from(cell.col) + i64::from(dx),
                i64::from(cell.row) + i64::from(dy),
            );
            let on_grid = col >= 0
                && row >= 0
                && col < blocked.n_cols() as i64
                && row < blocked.n_rows() as i64;
            on_grid && !blocked.contains(col, row)
        };
        let allowed = |&(dx, dy): &(i32, i32)| {
            let n_obstacles = usize::from(!free(dx, 0)) + usize::from(!free(0, dy));
            let corner = dx == 0 || dy == 0 || n_obstacles <= rule.max_corner_obstacles();
            free(0, 0) && free(dx, dy) && corner
        };
        (0..8).filter(|&i| allowed(&STEPS[i])).map(|i| 1 << i).sum()
    }

    proptest! {
        #[test]
        fn moves_follow_the_rule(
            n_cols in 1_usize..140,
            n_rows in 1_usize..5,
            blocked in prop::collection::vec(any::<u64>(), 15),
        ) {
            let mut grid = BitGrid::new(n_cols, n_rows);
            for (i, word) in blocked.iter().enumerate() {
                let (row, w) = (i / 3, i % 3);
                for cell in crate::map::set_bits(*word).map(|b| (w * 64) as u32 + b) {
                    if row < n_rows && (cell as usize) < n_cols {
                        grid.insert(Cell::new(cell, row as u32));
                    }
                }
            }
            for rule in DiagonalRule::ALL {
                let moves = MoveMasks::new(&grid, rule);
                for i in 0..n_cols * n_rows {
                    let cell = moves.cell(i);
                    prop_assert_eq!(moves.moves(cell), by_definition(&grid, rule, cell), "{:?}", cell);
                }
            }
        }

        #[test]
        fn a_change_gives_the_moves_of_the_changed_grid(
            n_cols in 1_usize..200,
            cells in prop::collection::vec((any::<prop::sample::Index>(), 0_u32..7), 60),
            corners in prop::array::uniform2((any::<prop::sample::Index>(), 0_usize..7)),
        ) {
            let place = |(col, row): &(prop::sample::Index, u32)| Cell::new(col.index(n_cols) as u32, *row);
            let mut before = BitGrid::new(n_cols, 7);
            before.extend(cells[..30].iter().map(place));
            let [a, b] = corners.map(|(col, row)| (col.index(n_cols), row));
            let (cols, rows) = (a.0.min(b.0)..a.0.max(b.0) + 1, a.1.min(b.1)..a.1.max(b.1) + 1);
            let within = |c: &Cell| cols.contains(&(c.col as usize)) && rows.contains(&(c.row as usize));
            for rule in DiagonalRule::ALL {
                let mut moves = MoveMasks::new(&before, rule);
                moves.change(cols.clone(), rows.clone(), |blocked| {
                    blocked.remove_all(cells[..30].iter().map(place).filter(within));
                    blocked.extend(cells[30..].iter().map(place).filter(within));
                });
                let expected = MoveMasks::new(&moves.blocked, rule);
                prop_assert_eq!(moves, expected);
            }
        }
    }
}
