//! A rectangle of cells.

use super::cell::Cell;
use std::ops::Range;

/// A rectangle of cells.
///
/// ```
/// use formicar::OccupancyGrid;
/// use formicar::map::{Cell, CellRegion, OCCUPIED};
///
/// let mut map = OccupancyGrid::from_rows(&["....", "....", "...."], 1.0)?;
/// let region = CellRegion::new(Cell::new(1, 0), 2, 2);
/// map.replace(&region, &[OCCUPIED; 4])?;
/// assert_eq!(map.lethal_cells().iter().count(), 4);
/// # Ok::<(), formicar::MapError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CellRegion {
    /// Its lower left cell.
    pub corner: Cell,
    /// Number of columns.
    pub n_cols: usize,
    /// Number of rows.
    pub n_rows: usize,
}

impl CellRegion {
    /// The rectangle of some columns and rows from a lower left cell on.
    pub const fn new(corner: Cell, n_cols: usize, n_rows: usize) -> Self {
        Self {
            corner,
            n_cols,
            n_rows,
        }
    }

    /// The rectangle of ranges of columns and of rows, each below 2^32.
    pub(crate) fn of_ranges(cols: &Range<usize>, rows: &Range<usize>) -> Self {
        let corner = Cell::new(cols.start as u32, rows.start as u32);
        Self::new(corner, cols.len(), rows.len())
    }

    /// Its columns.
    pub fn cols(&self) -> Range<usize> {
        let first = self.corner.col as usize;
        first..first.saturating_add(self.n_cols)
    }

    /// Its rows.
    pub fn rows(&self) -> Range<usize> {
        let first = self.corner.row as usize;
        first..first.saturating_add(self.n_rows)
    }

    /// Its cells, row by row.
    pub fn cells(&self) -> impl Iterator<Item = Cell> + use<> {
        let (cols, rows) = (self.cols(), self.rows());
        rows.flat_map(move |row| {
            let cells = cols.clone();
            cells.map(move |col| Cell::new(col as u32, row as u32))
        })
    }

    /// The rectangle with so many cells more on every side, as far as a grid has them.
    #[must_use]
    pub fn grown(&self, n_cells: usize, n_cols: usize, n_rows: usize) -> Self {
        let grow = |range: Range<usize>, n: usize| {
            range.start.saturating_sub(n_cells)..range.end.saturating_add(n_cells).min(n)
        };
        Self::of_ranges(&grow(self.cols(), n_cols), &grow(self.rows(), n_rows))
    }

    /// The least rectangle that holds this one and another.
    #[must_use]
    pub fn with(&self, other: &Self) -> Self {
        let both = |a: Range<usize>, b: Range<usize>| a.start.min(b.start)..a.end.max(b.end);
        Self::of_ranges(
            &both(self.cols(), other.cols()),
            &both(self.rows(), other.rows()),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::{OCCUPIED, OccupancyGrid};

    #[test]
    fn a_rectangle_of_a_map_is_replaced() {
        let mut map = OccupancyGrid::from_rows(&["...", "...", "###"], 1.0).unwrap();
        let region = CellRegion::new(Cell::new(1, 0), 2, 2);
        map.replace(&region, &[0, 0, 50, 100]).unwrap();
        assert_eq!(map.values(), [100, 0, 0, 0, 50, 100, 0, 0, 0]);
        let cells: Vec<_> = region.cells().map(|c| (c.col, c.row)).collect();
        assert_eq!(cells, [(1, 0), (2, 0), (1, 1), (2, 1)]);
        assert_eq!(
            region.grown(1, 3, 3),
            CellRegion::new(Cell::new(0, 0), 3, 3)
        );
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        let mut map = OccupancyGrid::from_rows(&["..", ".."], 1.0).unwrap();
        let mut replace = |col, row, n_cols, n_rows, values: &[i8]| {
            let region = CellRegion::new(Cell::new(col, row), n_cols, n_rows);
            map.replace(&region, values).unwrap_err().to_string()
        };
        assert_eq!(
            replace(1, 1, 2, 1, &[0, 0]),
            "region of 2 x 1 cells from (1, 1): the map has 2 x 2 cells; hint: leave out what lies off the map"
        );
        assert_eq!(replace(0, 0, 2, 1, &[0]), "1 cell values for 2 x 1 cells");
        assert!(replace(0, 1, 2, 1, &[0, OCCUPIED + 1]).starts_with("cell (1, 1) has value 101"));
        assert!(replace(u32::MAX, 0, usize::MAX, 1, &[]).starts_with("region"));
    }
}
