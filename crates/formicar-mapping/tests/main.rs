//! Suites over the public interface, in simulation.
#![allow(clippy::unwrap_used, reason = "a test suite: its helpers may fail")]

mod drives;
mod localization;
mod mapping;
mod real_logs;
