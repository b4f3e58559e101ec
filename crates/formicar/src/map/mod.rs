//! Occupancy grids: what is known of the ground, in a ROS frame.

mod bit_grid;
pub mod builtin;
mod cell;
mod components;
mod costmap;
mod dilation;
mod distance;
mod distance_transform;
mod error;
#[cfg(feature = "formats")]
pub mod format;
mod frame;
pub mod generate;
mod grid;
mod keep_out;
mod line_of_sight;
mod move_masks;
mod neighborhood;
mod orientation;
mod padded_grid;
mod raster;
mod region;
mod regrow;
mod sketch;
mod step_cost;
mod values;

pub use bit_grid::BitGrid;
pub(crate) use bit_grid::{set_bits, shifted};
pub use cell::Cell;
pub use components::Components;
pub use distance::DistanceField;
pub use error::{MAX_CELLS, MAX_ORIGIN_M, MAX_RESOLUTION_M, MIN_RESOLUTION_M, MapError};
pub use frame::GridFrame;
pub use grid::{OccupancyGrid, UnknownPolicy};
pub use line_of_sight::{cells_in_sight, line_of_sight, touched_cells};
pub use move_masks::MoveMasks;
pub use neighborhood::{Connectivity, DiagonalRule, STEPS, ring};
pub use padded_grid::PaddedGrid;
pub use region::CellRegion;
pub(crate) use regrow::{middle_cell, regrow};
pub(crate) use step_cost::STEP_COSTS;
pub use step_cost::{DIAGONAL_COST, STRAIGHT_COST};
pub(crate) use values::lethal;
pub use values::{FREE, OCCUPIED, UNKNOWN};
