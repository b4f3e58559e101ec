//! Suites over the public interface.

mod agents;
mod common;
mod known;
mod unknown;
