//! The cells between which ants choose, numbered without gaps.

use crate::colony::corridor::Corridor;
use crate::map::{BitGrid, Cell, MoveMasks};
use crate::progress::Limits;
use crate::search::{GoalField, SearchError};

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

    /// The cells of a corridor from a start to the goals of a field, which it reaches.
    pub(super) fn of(
        corridor: &Corridor,
        moves: &MoveMasks,
        to_goal: &GoalField,
        start: Cell,
        limits: &mut Limits,
    ) -> Result<Self, SearchError> {
        match corridor {
            Corridor::Ratio(rule) => {
                let near = to_goal.corridor(moves, start, rule.ratio, limits)?;
                Ok(Self::reached(near.costs(), moves.n_cols()))
            }
            Corridor::None => Ok(Self::reached(to_goal.costs(), moves.n_cols())),
        }
    }

    /// The cells that have a cost.
    fn reached(costs: &[u32], n_cols: usize) -> Self {
        let is_reached = |cost| cost != u32::MAX;
        Self::new(BitGrid::of_values(n_cols, costs, is_reached))
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
