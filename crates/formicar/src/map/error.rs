//! Errors of maps.

use super::cell::Cell;
use super::region::CellRegion;
use thiserror::Error;

/// The most cells that a grid may have: 2^28, about 16 000 x 16 000.
pub const MAX_CELLS: usize = 1 << 28;

/// The smallest side of a cell, meters.
pub const MIN_RESOLUTION_M: f64 = 1e-9;
/// The largest side of a cell, meters.
pub const MAX_RESOLUTION_M: f64 = 1e6;
/// The largest coordinate of an origin, meters: beyond, doubles do not tell micrometers apart.
pub const MAX_ORIGIN_M: f64 = 1e9;

/// An invalid map.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum MapError {
    /// No cells.
    #[error("the map has {n_cols} x {n_rows} cells; at least 1 x 1 is needed")]
    Empty {
        /// Columns given.
        n_cols: usize,
        /// Rows given.
        n_rows: usize,
    },
    /// Too many cells.
    #[error(
        "the map has {n_cols} x {n_rows} cells; the limit is {MAX_CELLS} in all; hint: crop it or use a coarser resolution"
    )]
    TooLarge {
        /// Columns given.
        n_cols: usize,
        /// Rows given.
        n_rows: usize,
    },
    /// A resolution that is no length.
    #[error(
        "resolution {} m per cell; it must be from {MIN_RESOLUTION_M:e} to {MAX_RESOLUTION_M:e} m", short(*resolution_m)
    )]
    BadResolution {
        /// The resolution given.
        resolution_m: f64,
    },
    /// An origin that is no pose.
    #[error(
        "origin ({}, {}, {yaw}); x and y must be within {MAX_ORIGIN_M:e} m of 0 and the yaw a finite number", short(*x), short(*y)
    )]
    BadOrigin {
        /// Meters.
        x: f64,
        /// Meters.
        y: f64,
        /// Radians.
        yaw: f64,
    },
    /// As many values as cells are needed.
    #[error("{n_values} cell values for {n_cols} x {n_rows} cells")]
    WrongCellCount {
        /// Values given.
        n_values: usize,
        /// Columns.
        n_cols: usize,
        /// Rows.
        n_rows: usize,
    },
    /// A value outside -1..=100.
    #[error("cell ({}, {}) has value {value}; allowed are -1 (unknown) and 0 (free) to 100 (occupied)", cell.col, cell.row)]
    BadValue {
        /// The cell.
        cell: Cell,
        /// The value found.
        value: i8,
    },
    /// A rectangle of cells that the map does not have.
    #[error(
        "region of {} x {} cells from ({}, {}): the map has {n_cols} x {n_rows} cells; hint: leave out what lies off the map",
        region.n_cols, region.n_rows, region.corner.col, region.corner.row
    )]
    RegionOffMap {
        /// The rectangle given.
        region: CellRegion,
        /// Columns of the map.
        n_cols: usize,
        /// Rows of the map.
        n_rows: usize,
    },
}

/// A number, without a row of zeros where it is very large or small.
fn short(number: f64) -> String {
    if number == 0.0 || !number.is_finite() || (1e-4..1e7).contains(&number.abs()) {
        number.to_string()
    } else {
        format!("{number:e}")
    }
}
