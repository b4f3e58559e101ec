//! The judge: whether a vehicle can drive a path, proven independently of how it was found.

mod report;

pub use report::{Certificate, Report, Violation, ViolationKind};
