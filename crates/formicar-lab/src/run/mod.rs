//! Runs of planners: how a query is measured, and how runs are spread over threads.

mod measure;
pub mod pool;
pub mod usage;

pub use measure::{Improvement, Measured, TimedIteration, measure};
