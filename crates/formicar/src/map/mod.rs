//! Occupancy grids: what is known of the ground, in a ROS frame.

mod bit_grid;
mod cell;
mod costmap;
mod distance;
pub mod format;
mod frame;
mod grid;
mod raster;

pub use bit_grid::BitGrid;
pub(crate) use bit_grid::set_bits;
pub use cell::Cell;
pub use distance::DistanceField;
pub use frame::GridFrame;
pub use grid::{FREE, MAX_CELLS, MapError, OCCUPIED, OccupancyGrid, UNKNOWN, UnknownPolicy};
