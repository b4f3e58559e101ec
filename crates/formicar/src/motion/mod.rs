//! Speed along a path: how fast, when to wait, and the time that it takes.
//!
//! A certified path says where a vehicle drives, not when. [`fastest`] gives it the fastest drive
//! within the limits of speed, acceleration and steering rate. [`plan_motion`] does the same among
//! obstacles that move: in the plane of arc length and time, their predictions close regions, and the
//! fastest drive around these is found on a lattice of speeds. The result is a
//! [`TimedPath`](crate::path::TimedPath), which
//! [`judge_in_time`](crate::validation::judge_in_time) certifies without knowing this module.

mod bits;
mod config;
mod error;
mod fastest;
mod forbidden;
mod hull;
mod lattice;
mod outcome;
mod plan;
mod steps;
mod stretch;
mod swept_path;

pub use config::{MotionConfig, MotionProblem};
pub use error::MotionError;
pub use fastest::{fastest, travel_time_s};
pub use forbidden::Region;
pub use outcome::{MotionPlan, MotionStatus, ProfileSource};
pub use plan::plan_motion;
