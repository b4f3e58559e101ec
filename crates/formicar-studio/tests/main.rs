//! The server from outside, as one binary: a file for each theme.
#![allow(clippy::unwrap_used, reason = "helpers of tests may fail")]

mod common;
mod protocol;
mod robust;
mod session;
