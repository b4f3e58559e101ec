//! The judge: whether a vehicle can drive a path, proven independently of how it was found.
//!
//! A path is valid when its swept body keeps more than [`crate::collision::MIN_CLEARANCE_M`] from
//! every lethal cell square and from the border, its curvature stays within the vehicle's limit,
//! its segments join, and it goes from start to a goal past all
//! via points in the gears that the request allows. Only a
//! valid path gets a [`Certificate`], and only the judge makes one. Where the request asks for
//! continuous curvature, the curvature of a valid path jumps nowhere inside one gear and changes no
//! faster than was asked.

mod columns;
mod continuity;
mod ends;
mod foreign;
mod foreign_path;
mod in_time;
mod judge;
mod report;
#[cfg(feature = "formats")]
mod ros_path;
mod samples;
mod samples_error;
mod shape;
mod swept;
mod tangents;
mod via;

pub use ends::missed_start;
pub use foreign::{FOREIGN_CURVATURE_SLACK, path_through_points, path_through_poses};
pub use foreign_path::ForeignPath;
pub use in_time::{
    DriveRules, Nearest, TimedCertificate, TimedReport, TimedViolation, TimedViolationKind,
    judge_in_time,
};
pub(crate) use judge::judge_while;
pub use judge::{judge, judge_path, path_hash_with_signs};
pub use report::{Certificate, Report, Violation, ViolationKind};
pub use samples::{ReadSamples, Samples};
pub use samples_error::SamplesError;

/// The largest gap between two segments: meters, and radians.
pub const JOINT_TOLERANCE: f64 = 1e-6;

/// The share of the limit by which a curvature or its rate of change may exceed it.
pub const CURVATURE_TOLERANCE: f64 = 1e-9;
