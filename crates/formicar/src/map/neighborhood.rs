//! Neighborhoods of 4 cells, 8 cells and rings, and the rules for diagonal steps past a corner.

use super::Cell;
use crate::parameters::Parameters;

/// The eight steps to a neighbor as (columns, rows), counter-clockwise from east.
///
/// Even places are straight, odd ones diagonal; the opposite of step `i` is `(i + 4) % 8`.
pub const STEPS: [(i32, i32); 8] = [
    (1, 0),
    (1, 1),
    (0, 1),
    (-1, 1),
    (-1, 0),
    (-1, -1),
    (0, -1),
    (1, -1),
];

/// When a diagonal step between two free cells is allowed, by the two cells beside its corner.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum DiagonalRule {
    /// Always, even between two obstacles.
    Always,
    /// If at least one of the two is free (Wang 2019).
    AtMostOneObstacle,
    /// If both are free: no corner is cut, as in the `MovingAI` benchmarks.
    #[default]
    NoObstacles,
}

impl Parameters for DiagonalRule {}

impl DiagonalRule {
    /// All rules, the most permissive first.
    pub const ALL: [Self; 3] = [Self::Always, Self::AtMostOneObstacle, Self::NoObstacles];

    /// How many obstacles may touch a path in nothing but a common corner.
    pub fn max_corner_obstacles(self) -> usize {
        match self {
            Self::Always => usize::MAX,
            Self::AtMostOneObstacle => 1,
            Self::NoObstacles => 0,
        }
    }

    /// The connectivity that decides what can be reached at all under this rule: a diagonal step
    /// past a free cell can be replaced by two straight ones.
    pub fn connectivity(self) -> Connectivity {
        match self {
            Self::Always => Connectivity::Eight,
            Self::AtMostOneObstacle | Self::NoObstacles => Connectivity::Four,
        }
    }
}

/// Which cells count as neighbors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Connectivity {
    /// Cells with a common edge.
    Four,
    /// Cells with a common edge or corner.
    #[default]
    Eight,
}

impl Connectivity {
    /// The neighbors of a cell on an `n_cols` x `n_rows` grid, counter-clockwise from east.
    pub fn neighbors(self, cell: Cell, n_cols: usize, n_rows: usize) -> impl Iterator<Item = Cell> {
        let stride = match self {
            Self::Four => 2,
            Self::Eight => 1,
        };
        let steps = STEPS.iter().step_by(stride);
        steps.filter_map(move |&(dx, dy)| shifted(cell, dx.into(), dy.into(), (n_cols, n_rows)))
    }
}

/// The cells at Chebyshev distance `radius_cells` on an `n_cols` x `n_rows` grid, counter-clockwise
/// from east; at radius 0 the cell itself.
pub fn ring(
    center: Cell,
    radius_cells: u32,
    n_cols: usize,
    n_rows: usize,
) -> impl Iterator<Item = Cell> {
    let r = i64::from(radius_cells);
    let side = 2 * r;
    // Counted from the lower right corner, east lies half a side on.
    (0..(4 * side).max(1)).filter_map(move |i| {
        let place = (i + r) % (4 * side).max(1);
        let along = place % side.max(1);
        let (dx, dy) = match place / side.max(1) {
            0 => (r, along - r),
            1 => (r - along, r),
            2 => (-r, r - along),
            _ => (along - r, -r),
        };
        shifted(center, dx, dy, (n_cols, n_rows))
    })
}

/// A cell moved by columns and rows, if it stays on a grid of that size.
fn shifted(cell: Cell, dx: i64, dy: i64, (n_cols, n_rows): (usize, usize)) -> Option<Cell> {
    let (col, row) = (i64::from(cell.col) + dx, i64::from(cell.row) + dy);
    let inside = (0..n_cols as i64).contains(&col) && (0..n_rows as i64).contains(&row);
    inside.then(|| Cell::new(col as u32, row as u32))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbors_stay_on_the_grid() {
        let corner: Vec<_> = Connectivity::Eight
            .neighbors(Cell::new(0, 0), 5, 5)
            .collect();
        assert_eq!(corner, [Cell::new(1, 0), Cell::new(1, 1), Cell::new(0, 1)]);
        let inner = Connectivity::Four.neighbors(Cell::new(2, 2), 5, 5);
        assert_eq!(inner.count(), 4);
    }

    #[test]
    fn a_ring_holds_just_the_cells_at_its_distance() {
        let center = Cell::new(10, 10);
        let distance = |c: Cell| c.col.abs_diff(10).max(c.row.abs_diff(10));
        for radius in 0..5 {
            let mut cells: Vec<_> = ring(center, radius, 21, 21).collect();
            assert!(cells.iter().all(|&c| distance(c) == radius));
            assert_eq!(cells.len(), (8 * radius as usize).max(1));
            cells.sort();
            cells.dedup();
            assert_eq!(cells.len(), (8 * radius as usize).max(1));
        }
        let eight: Vec<_> = Connectivity::Eight.neighbors(center, 21, 21).collect();
        assert_eq!(ring(center, 1, 21, 21).collect::<Vec<_>>(), eight);
    }
}
