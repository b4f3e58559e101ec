//! The cells between which ants choose, numbered without gaps.

use crate::map::{BitGrid, Cell};
use crate::numeric::{OutOfRange, check_range};
use crate::search::GoalField;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Where ants may go.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "rule", rename_all = "kebab-case")]
pub enum Corridor {
    /// Near shortest ways over cells, and on a step not far off one: what large maps need. Not in
    /// the paper, but for its "local space weighting".
    NearShortest(NearShortest),
    /// Wherever the goal can be reached from.
    None,
}

/// How far from a shortest way ants may go.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct NearShortest {
    /// The longest way through a cell, by the shortest of all, from 1 to 100.
    pub ratio: f64,
    /// The most that a step may lengthen the way, cells, from 0 to 1000.
    pub step_detour_cells: f64,
}

impl Default for NearShortest {
    fn default() -> Self {
        Self {
            ratio: 1.1,
            step_detour_cells: 4.0,
        }
    }
}

impl Corridor {
    pub(super) fn check(&self) -> Result<(), OutOfRange> {
        let Self::NearShortest(rule) = self else {
            return Ok(());
        };
        check_range("chords.corridor.ratio", rule.ratio, 1.0..=100.0)?;
        let detour = rule.step_detour_cells;
        check_range("chords.corridor.step_detour_cells", detour, 0.0..=1000.0)
    }

    /// The longest way through a cell and the most that a step may lengthen the way, in cells.
    pub(super) fn limits(&self, shortest_cells: f64) -> [f64; 2] {
        match self {
            // Some cells more, so that short ways have room too.
            Self::NearShortest(rule) => [rule.ratio * shortest_cells + 4.0, rule.step_detour_cells],
            Self::None => [f64::INFINITY; 2],
        }
    }
}

/// Cells numbered row by row.
#[derive(Clone, Debug)]
pub(super) struct Numbered {
    cells: BitGrid,
    /// Cells in the set before each word.
    ranks: Vec<u32>,
    words_per_row: usize,
}

impl Numbered {
    pub(super) fn new(cells: BitGrid) -> Self {
        let mut n_before = 0;
        let ranks = cells.words().iter().map(|word| {
            let rank = n_before;
            n_before += word.count_ones();
            rank
        });
        Self {
            ranks: ranks.collect(),
            words_per_row: cells.n_cols().div_ceil(64),
            cells,
        }
    }

    /// The cells from which the goal is reached, on ways of at most a length where one is given.
    pub(super) fn between([from, to]: [&GoalField; 2], n_cols: usize, longest: f64) -> Self {
        let n_rows = to.costs().len() / n_cols.max(1);
        let mut cells = BitGrid::new(n_cols, n_rows);
        let limit = longest * f64::from(crate::search::STRAIGHT_COST);
        for row in 0..n_rows {
            let costs = row * n_cols..(row + 1) * n_cols;
            let (from, to) = (&from.costs()[costs.clone()], &to.costs()[costs]);
            for (w, word) in cells.row_mut(row).iter_mut().enumerate() {
                let columns = 64 * w..n_cols.min(64 * (w + 1));
                let both = from[columns.clone()].iter().zip(&to[columns]);
                *word = both.enumerate().fold(0, |word, (bit, (&a, &b))| {
                    let is_near =
                        a < u32::MAX && b < u32::MAX && f64::from(a) + f64::from(b) <= limit;
                    word | u64::from(is_near) << bit
                });
            }
        }
        Self::new(cells)
    }

    pub(super) fn len(&self) -> usize {
        self.cells.count()
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = Cell> + '_ {
        self.cells.iter()
    }

    /// The number of a cell of the set; none for others, off the map too.
    #[inline]
    pub(super) fn number(&self, cell: Cell) -> Option<usize> {
        let (col, row) = (cell.col as usize, cell.row as usize);
        if col >= self.cells.n_cols() || row >= self.cells.n_rows() {
            return None;
        }
        let index = row * self.words_per_row + col / 64;
        let word = self.cells.words()[index];
        let below = word & ((1 << (col % 64)) - 1);
        (word >> (col % 64) & 1 == 1).then(|| (self.ranks[index] + below.count_ones()) as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_follow_the_cells_without_gaps() {
        let mut cells = BitGrid::new(130, 3);
        let members = [(0, 0), (63, 0), (64, 0), (129, 1), (5, 2), (127, 2)];
        cells.extend(members.map(|(col, row)| Cell::new(col, row)));
        let numbered = Numbered::new(cells);
        let numbers: Vec<_> = numbered.iter().map(|cell| numbered.number(cell)).collect();
        assert_eq!(numbers, (0..6).map(Some).collect::<Vec<_>>());
        for stranger in [(1, 0), (130, 0), (0, 3), (u32::MAX, 0)] {
            assert_eq!(numbered.number(Cell::new(stranger.0, stranger.1)), None);
        }
    }
}
