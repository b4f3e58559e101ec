//! Suites over the public API, as one binary: a file each.
#![allow(clippy::unwrap_used, reason = "helpers of tests may fail")]

mod own_planner;
mod statistics;
