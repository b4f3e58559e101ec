//! Runs made into statements: statistics, comparisons of two sides, goals and peers, reports.

pub mod compare;
pub mod standing;
pub mod statistics;
mod summary;

pub use summary::{Summary, ompl_logs, parameter_section, report};
