//! The cells that a via point may lie on: those that can be reached from the start.

use crate::geometry::Point2;
use crate::map::{BitGrid, Cell, Components, DiagonalRule, set_bits};
use crate::numeric::RandomStream;

/// Draws of a cell near a place before the attempt is given up.
const MAX_TRIES: u32 = 8;

/// Cells that can be reached, counted by row, so that one can be drawn.
#[derive(Clone, Debug)]
pub(super) struct ReachableCells {
    reachable: BitGrid,
    /// Reachable cells in the rows before each row, and in all.
    n_before: Vec<usize>,
}

impl ReachableCells {
    /// The cells that can be reached from a start that is not blocked.
    /// `goes_on` is asked on the way whether to go on; where it says no, they are of no use.
    pub(super) fn new(
        blocked: &BitGrid,
        rule: DiagonalRule,
        start: Cell,
        goes_on: &mut dyn FnMut() -> bool,
    ) -> Self {
        let components = Components::new_while(blocked, rule.connectivity(), goes_on);
        let mut reachable = blocked.complement();
        if components.n_components() > 1 {
            for row in 0..blocked.n_rows() {
                if !goes_on() {
                    break;
                }
                let cells = (0..blocked.n_cols()).map(|col| Cell::new(col as u32, row as u32));
                let strays = cells.filter(|&cell| !components.same(cell, start));
                reachable.remove_all(strays);
            }
        }
        let mut n_before = vec![0];
        let mut n_cells = 0;
        for row in 0..reachable.n_rows() {
            n_cells += n_in(reachable.row(row));
            n_before.push(n_cells);
        }
        Self {
            reachable,
            n_before,
        }
    }

    /// A reachable cell, uniformly drawn.
    pub(super) fn anywhere(&self, random: &mut RandomStream) -> Cell {
        let n_cells = self.n_before.last().copied().unwrap_or_default();
        let place = random.below(n_cells);
        let row = self.n_before.partition_point(|&n| n <= place) - 1;
        let mut n_left = place - self.n_before[row];
        for (w, &word) in self.reachable.row(row).iter().enumerate() {
            let n_here = word.count_ones() as usize;
            if n_left < n_here {
                let bit = set_bits(word).nth(n_left).unwrap_or_default();
                return Cell::new((64 * w) as u32 + bit, row as u32);
            }
            n_left -= n_here;
        }
        Cell::new(0, row as u32)
    }

    /// A reachable cell within some cells of a place along either axis; small distances are more
    /// likely. None if a few draws find none.
    pub(super) fn near(
        &self,
        place: Point2,
        reach_cells: f64,
        random: &mut RandomStream,
    ) -> Option<Cell> {
        (0..MAX_TRIES).find_map(|_| {
            let mut offset = || {
                let unit = random.range(-1.0, 1.0);
                reach_cells * unit * unit.abs()
            };
            let (dx, dy) = (offset(), offset());
            self.at(place + Point2::new(dx, dy))
        })
    }

    /// The cell whose center is nearest to a place in columns and rows, if it can be reached.
    pub(super) fn at(&self, place: Point2) -> Option<Cell> {
        let (col, row) = (place.x.round() as i64, place.y.round() as i64);
        let is_reachable = self.reachable.contains(col, row);
        is_reachable.then(|| Cell::new(col as u32, row as u32))
    }

    /// The longer side of the map, cells.
    pub(super) fn side_cells(&self) -> f64 {
        self.reachable.n_cols().max(self.reachable.n_rows()) as f64
    }
}

fn n_in(words: &[u64]) -> usize {
    words.iter().map(|word| word.count_ones() as usize).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::OccupancyGrid;
    use crate::numeric::Seed;
    use std::collections::BTreeSet;

    #[test]
    fn draws_every_reachable_cell_and_no_other() {
        let rows = ["..#..", ".##..", "...#.", "##..#", "..#.."];
        let blocked = OccupancyGrid::from_rows(&rows, 1.0).unwrap().lethal_cells();
        let start = Cell::new(0, 4);
        let reachable =
            ReachableCells::new(&blocked, DiagonalRule::NoObstacles, start, &mut || true);
        let mut random = Seed(1).stream([0, 0]);
        let pair = |cell: Cell| (cell.col, cell.row);
        let drawn: BTreeSet<_> = (0..2_000)
            .map(|_| pair(reachable.anywhere(&mut random)))
            .collect();
        let near: BTreeSet<_> = (0..2_000)
            .filter_map(|_| reachable.near(Point2::new(2.0, 2.0), 9.0, &mut random))
            .map(pair)
            .collect();
        // Everything but the corners at the lower left and the upper right.
        let expected = [
            (3, 0),
            (4, 0),
            (2, 1),
            (3, 1),
            (0, 2),
            (1, 2),
            (2, 2),
            (0, 3),
            (0, 4),
            (1, 4),
        ];
        assert_eq!(drawn, expected.into_iter().collect());
        assert_eq!(near, drawn);
    }
}
