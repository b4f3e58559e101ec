//! Speed along a path: how fast, when to wait, and the time that it takes.

mod fastest;
mod steps;

pub use fastest::{fastest, travel_time_s};
