//! The judge in time: whether a drive keeps its limits and its distance from what moves.

mod distance;
mod judge;
mod profile;
mod report;
mod rules;

pub use judge::judge_in_time;
pub use report::{Nearest, TimedCertificate, TimedReport, TimedViolation, TimedViolationKind};
pub use rules::DriveRules;
