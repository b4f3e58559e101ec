//! The occupancy grid.

use super::bit_grid::BitGrid;
use super::cell::Cell;
use super::error::MapError;
use super::frame::GridFrame;
use super::region::CellRegion;
use super::values::{FREE, OCCUPIED, UNKNOWN, check_values, lethal};
use crate::geometry::{Point2, Pose2};

/// The meaning of unknown cells.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum UnknownPolicy {
    /// As free ground.
    Free,
    /// As obstacles.
    #[default]
    Occupied,
}

/// A map of square cells: -1 unknown, 0 free, 1 to 99 graded, 100 occupied.
///
/// Only cells at 100 and unknown cells stop a vehicle; graded values are preferences at most.
/// Values are row-major with row 0 at the bottom, as in a ROS `OccupancyGrid` message.
///
/// ```
/// use formicar::OccupancyGrid;
/// use formicar::map::{Cell, UNKNOWN};
///
/// let map = OccupancyGrid::from_rows(&["..#", "...", "?.."], 0.5)?;
/// assert!(map.is_lethal(Cell::new(2, 2)) && !map.is_lethal(Cell::new(0, 1)));
/// assert_eq!(map.value(Cell::new(0, 0)), UNKNOWN);
/// # Ok::<(), formicar::MapError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct OccupancyGrid {
    frame: GridFrame,
    values: Vec<i8>,
}

impl OccupancyGrid {
    /// A grid from its values.
    ///
    /// # Errors
    /// As many values as cells, each in -1..=100, are needed.
    pub fn new(frame: GridFrame, values: Vec<i8>) -> Result<Self, MapError> {
        if values.len() != frame.n_cells() {
            let (n_cols, n_rows) = (frame.n_cols(), frame.n_rows());
            return Err(MapError::WrongCellCount {
                n_values: values.len(),
                n_cols,
                n_rows,
            });
        }
        check_values(&values, |i| frame.cell(i))?;
        Ok(Self { frame, values })
    }

    /// A grid whose cells are all free.
    pub fn free(frame: GridFrame) -> Self {
        let values = vec![FREE; frame.n_cells()];
        Self { frame, values }
    }

    /// A grid with origin (0, 0, 0) from rows of text, first row on top: `#` is occupied, `?`
    /// unknown, anything else free. For tests, examples and built-in maps.
    ///
    /// # Errors
    /// Rows of unequal length, no cells, or a bad resolution.
    pub fn from_rows(rows: &[&str], resolution_m: f64) -> Result<Self, MapError> {
        let n_cols = rows.first().map_or(0, |row| row.chars().count());
        let frame = GridFrame::new(n_cols, rows.len(), resolution_m, Pose2::default())?;
        let value = |c| match c {
            '#' => OCCUPIED,
            '?' => UNKNOWN,
            _ => FREE,
        };
        Self::new(
            frame,
            rows.iter()
                .rev()
                .flat_map(|row| row.chars().map(value))
                .collect(),
        )
    }

    /// Size, resolution and origin.
    pub fn frame(&self) -> &GridFrame {
        &self.frame
    }

    /// All values, row-major, row 0 (bottom) first.
    pub fn values(&self) -> &[i8] {
        &self.values
    }

    /// The value of a cell.
    pub fn value(&self, cell: Cell) -> i8 {
        self.values[self.frame.index(cell)]
    }

    /// Sets the value of a cell; it must be in -1..=100.
    pub fn set(&mut self, cell: Cell, value: i8) {
        debug_assert!((UNKNOWN..=OCCUPIED).contains(&value));
        let index = self.frame.index(cell);
        self.values[index] = value;
    }

    /// Sets the values of a rectangle of cells, row by row, lowest row first.
    ///
    /// # Errors
    /// A part of it off the map, another number of values than cells, or a value outside
    /// -1..=100; nothing is changed then.
    pub fn replace(&mut self, region: &CellRegion, values: &[i8]) -> Result<(), MapError> {
        region.check(&self.frame, values)?;
        for (cell, &value) in region.cells().zip(values) {
            self.set(cell, value);
        }
        Ok(())
    }

    /// The same map with unknown cells decided; without this they count as occupied.
    #[must_use]
    pub fn with_unknown(mut self, policy: UnknownPolicy) -> Self {
        let decided = match policy {
            UnknownPolicy::Free => FREE,
            UnknownPolicy::Occupied => OCCUPIED,
        };
        for value in &mut self.values {
            if *value == UNKNOWN {
                *value = decided;
            }
        }
        self
    }

    /// True if a cell stops the vehicle: occupied or unknown.
    pub fn is_lethal(&self, cell: Cell) -> bool {
        lethal(self.value(cell))
    }

    /// The lethal cells as bits.
    pub fn lethal_cells(&self) -> BitGrid {
        BitGrid::of_values(self.frame.n_cols(), &self.values, lethal)
    }

    /// Sets every cell that a polygon's inside or boundary touches; corners in world meters, in
    /// order, convex or not. A corner that is not finite makes the polygon cover the whole map.
    pub fn fill_polygon(&mut self, corners: &[Point2], value: i8) {
        super::raster::touched_cells(&self.frame, corners, |index| self.values[index] = value);
    }
}
