//! Occupancy grids: what is known of the ground, in a ROS frame.

mod bit_grid;
pub mod builtin;
mod cell;
mod frame;
pub mod generate;
mod grid;
mod raster;
mod sketch;

pub use bit_grid::BitGrid;
pub use cell::Cell;
pub use frame::GridFrame;
pub use grid::{FREE, MAX_CELLS, MapError, OCCUPIED, OccupancyGrid, UNKNOWN, UnknownPolicy};
