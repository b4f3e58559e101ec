//! From a grid path to a curve that a car can drive.
//!
//! [`smooth`] drops redundant nodes, rounds corners by 2-turning (Lei & Zheng 2020, sec. III), and
//! joins the headings at both ends by Dubins or Reeds-Shepp curves. Every piece is checked with the
//! swept body; a failure names the first place that cannot be passed. The alternative is a B-spline
//! over the nodes (Li 2024), which ignores obstacles. [`Improver`] makes any drivable path cheaper.

mod chain;
mod config;
mod continuous;
mod error;
mod explain;
mod improve;
mod open_list;
mod polyline;
mod problem;
mod redundant_nodes;
mod roadmap;
mod smooth;
mod smoothed;
mod spline;
mod task;
mod two_turning;
mod wide_arcs;

pub use config::{Corners, SmoothingConfig};
pub use continuous::{Continuity, NoTransition};
pub use error::{CornerProblem, SmoothingError};
pub use improve::{ImproveConfig, ImproveProblem, Improved, Improver};
pub use problem::SmoothingProblem;
pub use redundant_nodes::{RedundantNodes, remove_redundant_nodes};
pub use smooth::smooth;
pub(crate) use smooth::smooth_while;
pub use smoothed::{CornerRecord, Rounding, Smoothed};
pub use two_turning::{TurnOrder, TwoTurning};
