//! The command from outside, as one binary: a file for each verb or theme.
#![allow(clippy::unwrap_used, reason = "helpers of tests may fail")]

mod ants;
mod bad_input;
mod bench;
mod campaign;
mod check;
mod common;
mod console_examples;
mod demo;
#[cfg(feature = "drive")]
mod drive;
mod lidar;
mod map;
mod motion;
mod plan;
mod reports;
mod reproduce;
mod requests;
mod rivals;
mod stress;
mod track;
mod tune;
mod words;
