//! Maps from lidar logs: signed distances, closed loops, and the robot found again in its map.
#![forbid(unsafe_code)]

mod error;
pub mod log;
pub mod matching;
pub mod matrix;
pub mod scan;
pub mod sdf;

pub use error::MappingError;
pub use log::Log;
pub use scan::{LaserScan, RangePolicy};
