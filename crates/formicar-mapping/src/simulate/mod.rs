//! Simulation: worlds of segments with exact rays, drives with people, sensors and odometry that err.

mod drive;
mod office;
mod world;

pub use drive::{Drive, DriveRule, ReverseSign};
pub use office::{Office, Room};
pub use world::{Segment, World};
