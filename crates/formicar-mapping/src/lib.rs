//! Maps from lidar logs: signed distances, closed loops, and the robot found again in its map.
#![forbid(unsafe_code)]

pub mod config;
mod error;
pub mod evaluate;
pub mod front_end;
pub mod graph;
pub mod localize;
pub mod log;
pub mod loops;
pub mod mapper;
pub mod matching;
pub mod matrix;
pub mod motion;
pub mod occupancy;
pub mod refine;
pub mod report;
pub mod scan;
pub mod sdf;
mod session;
pub mod simulate;
pub mod trajectory;

pub use config::MappingConfig;
pub use error::MappingError;
pub use localize::{LocalizationMap, Localizer};
pub use log::Log;
pub use mapper::{BuiltMap, Go, LogProgress, Mapper, Progress};
pub use report::MapReport;
pub use scan::{LaserScan, RangePolicy};
pub use session::SESSION_VERSION;
