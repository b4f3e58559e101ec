//! The weighted adjacency of cells, by both calculations of Wang 2019.
//!
//! The colony walks on [`MoveMasks`](crate::map::MoveMasks), which hold the same in a byte per
//! cell. These lists are for comparing the two calculations of the paper.

use crate::map::{BitGrid, Cell, DiagonalRule, STEPS};
use std::f64::consts::SQRT_2;

/// For each cell its neighbors by index, row times columns plus column, with their distances:
/// the entries of D, Wang 2019 (7), that are not empty.
#[derive(Clone, Debug, PartialEq)]
pub struct Adjacency {
    /// Neighbors in ascending order, and their distances in cells.
    pub neighbors: Vec<Vec<(u32, f64)>>,
}

/// The position of a cell on the map, which decides which neighbors exist: Wang 2019, figure 2.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PositionClass {
    /// Lower left corner.
    SouthWest,
    /// Bottom row.
    South,
    /// Lower right corner.
    SouthEast,
    /// Left column.
    West,
    /// No border near.
    Interior,
    /// Right column.
    East,
    /// Upper left corner.
    NorthWest,
    /// Top row.
    North,
    /// Upper right corner.
    NorthEast,
}

impl PositionClass {
    const ALL: [[Self; 3]; 3] = [
        [Self::SouthWest, Self::South, Self::SouthEast],
        [Self::West, Self::Interior, Self::East],
        [Self::NorthWest, Self::North, Self::NorthEast],
    ];

    /// The class of a cell on a map of at least 2 x 2 cells.
    pub fn of(cell: Cell, n_cols: usize, n_rows: usize) -> Self {
        let third = |i: u32, n: usize| usize::from(i > 0) + usize::from(i as usize + 1 == n);
        Self::ALL[third(cell.row, n_rows)][third(cell.col, n_cols)]
    }

    /// The steps to neighbors that exist, a bit each in the order of [`STEPS`].
    pub fn steps(self) -> u8 {
        const EAST: u8 = 0b1000_0011;
        const NORTH: u8 = 0b0000_1110;
        const WEST: u8 = 0b0011_1000;
        const SOUTH: u8 = 0b1110_0000;
        let missing = match self {
            Self::SouthWest => SOUTH | WEST,
            Self::South => SOUTH,
            Self::SouthEast => SOUTH | EAST,
            Self::West => WEST,
            Self::Interior => 0,
            Self::East => EAST,
            Self::NorthWest => NORTH | WEST,
            Self::North => NORTH,
            Self::NorthEast => NORTH | EAST,
        };
        !missing
    }
}

impl Adjacency {
    /// From each cell to the neighbors that its position class has: in proportion to the number of
    /// cells. The map has at least 2 x 2 cells.
    pub fn analytical(blocked: &BitGrid, rule: DiagonalRule) -> Self {
        let (n_cols, n_rows) = (blocked.n_cols(), blocked.n_rows());
        let neighbors = |index: usize| {
            let cell = Cell::new((index % n_cols) as u32, (index / n_cols) as u32);
            if is_blocked(blocked, cell) {
                return Vec::new();
            }
            let existing = PositionClass::of(cell, n_cols, n_rows).steps();
            let mut neighbors: Vec<(u32, f64)> = (0..8)
                .filter(|step| existing >> step & 1 == 1)
                .filter_map(|step| weighed(blocked, rule, cell, STEPS[step]))
                .collect();
            neighbors.sort_unstable_by_key(|&(index, _)| index);
            neighbors
        };
        Self {
            neighbors: (0..n_cols * n_rows).map(neighbors).collect(),
        }
    }

    /// From every cell to every other, whether they are neighbors or not: in proportion to the
    /// square of the number of cells.
    pub fn global(blocked: &BitGrid, rule: DiagonalRule) -> Self {
        let (n_cols, n_cells) = (blocked.n_cols(), blocked.n_cols() * blocked.n_rows());
        let cell = |index: usize| Cell::new((index % n_cols) as u32, (index / n_cols) as u32);
        let weight = |from: usize, to: usize| {
            let (from, to) = (cell(from), cell(to));
            let step = (
                to.col as i32 - from.col as i32,
                to.row as i32 - from.row as i32,
            );
            let is_near = step != (0, 0) && step.0.abs() <= 1 && step.1.abs() <= 1;
            (is_near && !is_blocked(blocked, from))
                .then(|| weighed(blocked, rule, from, step))
                .flatten()
        };
        let neighbors = |from: usize| (0..n_cells).filter_map(|to| weight(from, to)).collect();
        Self {
            neighbors: (0..n_cells).map(neighbors).collect(),
        }
    }
}

fn is_blocked(blocked: &BitGrid, cell: Cell) -> bool {
    blocked.get(cell.col as usize, cell.row as usize)
}

/// The neighbor that a step from a free cell leads to, and its distance, if the step is allowed.
/// It does not leave the map.
fn weighed(
    blocked: &BitGrid,
    rule: DiagonalRule,
    from: Cell,
    (dx, dy): (i32, i32),
) -> Option<(u32, f64)> {
    let to = Cell::new(
        from.col.wrapping_add_signed(dx),
        from.row.wrapping_add_signed(dy),
    );
    if is_blocked(blocked, to) {
        return None;
    }
    let index = to.row * blocked.n_cols() as u32 + to.col;
    if dx == 0 || dy == 0 {
        return Some((index, 1.0));
    }
    // Wang 2019 (3-6): the two cells that a diagonal step passes.
    let beside = [Cell::new(to.col, from.row), Cell::new(from.col, to.row)];
    let n_beside: usize = beside
        .iter()
        .map(|&cell| usize::from(is_blocked(blocked, cell)))
        .sum();
    (n_beside <= rule.max_corner_obstacles()).then_some((index, SQRT_2))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::MoveMasks;
    use crate::numeric::Seed;

    #[test]
    fn both_calculations_agree_with_the_moves_of_the_map() {
        let mut stream = Seed(5).stream([0, 0]);
        for (n_cols, n_rows) in [(2, 2), (9, 7), (12, 3)] {
            let mut blocked = BitGrid::new(n_cols, n_rows);
            for index in 0..n_cols * n_rows {
                if stream.unit() < 0.3 {
                    blocked.insert(Cell::new((index % n_cols) as u32, (index / n_cols) as u32));
                }
            }
            for rule in DiagonalRule::ALL {
                let adjacency = Adjacency::analytical(&blocked, rule);
                assert_eq!(adjacency, Adjacency::global(&blocked, rule));
                let moves = MoveMasks::new(&blocked, rule);
                for (index, neighbors) in adjacency.neighbors.iter().enumerate() {
                    let mask = moves.as_slice()[index];
                    assert_eq!(neighbors.len(), mask.count_ones() as usize);
                    let length: f64 = neighbors.iter().map(|n| n.1).sum();
                    let n_diagonal = (mask & 0b1010_1010).count_ones();
                    let n_straight = mask.count_ones() - n_diagonal;
                    let expected = f64::from(n_straight) + SQRT_2 * f64::from(n_diagonal);
                    assert!((length - expected).abs() < 1e-12);
                }
            }
        }
    }
}
