//! A place in a grid.

/// A cell by column (along x) and row (along y); row 0 is the lowest, as in ROS.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Cell {
    /// Column, counted along x from 0.
    pub col: u32,
    /// Row, counted along y from 0 at the bottom.
    pub row: u32,
}

impl Cell {
    /// The cell at a column and a row.
    pub const fn new(col: u32, row: u32) -> Self {
        Self { col, row }
    }
}
