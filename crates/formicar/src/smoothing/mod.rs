//! From a grid path to a curve that a car can drive.

mod config;
mod redundant_nodes;
mod two_turning;

pub use config::{Corners, SmoothingConfig};
pub use redundant_nodes::{RedundantNodes, remove_redundant_nodes};
pub use two_turning::{TurnOrder, TwoTurning};
