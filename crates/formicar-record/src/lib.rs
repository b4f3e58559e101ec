//! ROS 2 bags: messages, their encoding, files in MCAP, and what formicar takes out of them.
//!
//! [`Bag`] reads a file and [`BagWriter`] writes one. [`read_log`] turns laser scans, odometry and
//! transforms into the log that mapping takes, [`read_map`] turns an occupancy grid into a map to
//! plan on, and [`Recording`] writes a plan for players and viewers of ROS. Nothing here opens a
//! file or reads a clock: a source of bytes comes in.
#![forbid(unsafe_code)]

mod bag;
mod beams;
pub mod cdr;
mod error;
mod foreign;
mod frames;
mod grid;
mod log;
pub mod messages;
mod qos;
mod recording;
mod ride;
mod topic;
mod walk;
mod writer;

pub use bag::Bag;
pub use error::RecordError;
pub use foreign::{check_folder, check_kind};
pub use grid::{MapAt, from_message, read_map, to_message};
pub use log::{LogOptions, read_log};
pub use qos::Durability;
pub use recording::Recording;
pub use topic::{RawMessage, Topic};
pub use writer::BagWriter;
