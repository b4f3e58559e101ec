//! The judge: whether a vehicle can drive a path, proven independently of how it was found.

mod foreign;
mod report;

pub use foreign::{FOREIGN_CURVATURE_SLACK, path_through_points, path_through_poses};
pub use report::{Certificate, Report, Violation, ViolationKind};
