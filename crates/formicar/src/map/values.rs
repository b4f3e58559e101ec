//! Values of cells: their meaning and their range.

use super::cell::Cell;
use super::error::MapError;
use super::frame::GridFrame;
use super::region::CellRegion;

/// Value of a free cell.
pub const FREE: i8 = 0;
/// Value of an occupied (lethal) cell.
pub const OCCUPIED: i8 = 100;
/// Value of an unknown cell.
pub const UNKNOWN: i8 = -1;

/// True if a value stops the vehicle.
pub(crate) fn lethal(value: i8) -> bool {
    !(0..OCCUPIED).contains(&value)
}

/// Checks that all values are in -1..=100; `cell` is the cell of an index.
pub(super) fn check_values(values: &[i8], cell: impl Fn(usize) -> Cell) -> Result<(), MapError> {
    // Whether all are good is found many at a time: shifted, -1 is the least.
    let shifted = values.iter().map(|&value| (value as u8).wrapping_add(1));
    if shifted.max() <= Some(OCCUPIED as u8 + 1) {
        return Ok(());
    }
    let is_bad = |value: &i8| !(UNKNOWN..=OCCUPIED).contains(value);
    match values.iter().position(is_bad) {
        Some(i) => Err(MapError::BadValue {
            cell: cell(i),
            value: values[i],
        }),
        None => Ok(()),
    }
}

impl CellRegion {
    /// Checks that values fit into the rectangle on a map.
    ///
    /// # Errors
    /// A part of it off the map, another number of values than cells, or a value outside
    /// -1..=100.
    pub fn check(&self, frame: &GridFrame, values: &[i8]) -> Result<(), MapError> {
        if self.cols().end > frame.n_cols() || self.rows().end > frame.n_rows() {
            return Err(MapError::RegionOffMap {
                region: *self,
                n_cols: frame.n_cols(),
                n_rows: frame.n_rows(),
            });
        }
        if values.len() != self.n_cols * self.n_rows {
            return Err(MapError::WrongCellCount {
                n_values: values.len(),
                n_cols: self.n_cols,
                n_rows: self.n_rows,
            });
        }
        check_values(values, |i| {
            let (col, row) = (i % self.n_cols, i / self.n_cols);
            Cell::new(self.corner.col + col as u32, self.corner.row + row as u32)
        })
    }
}
