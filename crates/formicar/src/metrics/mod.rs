//! Metrics of paths.
//!
//! [`PathMetrics`] are exact: computed from segments, not from samples. [`CompatibleMetrics`]
//! repeat what other tools compute, so that numbers can be laid side by side; they depend on the
//! sampling and are no ground for a decision.

mod benchmr;
mod compatible;
mod flip;
mod nodes;
mod path_metrics;
mod resample;
mod smoothness;
mod steering_share;
mod winding;

pub use compatible::CompatibleMetrics;
pub use flip::flip;
pub use nodes::NodeMetrics;
pub use path_metrics::{ClearanceSummary, PathMetrics};
pub use steering_share::SteeringShare;
pub use winding::flips;
