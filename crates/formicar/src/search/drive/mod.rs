//! Shared by planners that drive from pose to pose: a map prepared for a vehicle's motions, the
//! motions and costs of a query, and the guide to its goal.

mod config;
mod drivable_cells;
mod drivable_map;
mod guide;
mod motions;
mod one_way;
mod price;
mod problem;
mod shots;
mod state;

pub use config::HybridAstarConfig;
pub use drivable_map::{DrivableMap, DrivableMapParts};
pub use guide::Guide;
pub use problem::DriveProblem;
pub use state::{Driven, FieldGrid, Inflation, Side, State};
