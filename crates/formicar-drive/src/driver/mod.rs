//! The robot's side of the loop: map, route, times, controller.

mod choose;
mod config;
mod lanes;
mod reference;
mod robot;
mod routing;
mod senses;
mod times;

pub use config::{DriverConfig, UnknownGround};
pub use robot::{Driver, DriverCounts};
