//! Suites over the public interface.
#![allow(clippy::unwrap_used, reason = "helpers of tests may fail")]

mod agents;
mod common;
mod known;
mod unknown;
