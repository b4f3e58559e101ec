//! Suites over the public API, as one binary: a file each.
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "helpers of tests may fail, say that they skip, and tell what they measured"
)]

/// One number for every run of the tests, another for the slow tier (`FORMICAR_SLOW=1`).
fn quick_or_full<T>(quick: T, full: T) -> T {
    if std::env::var_os("FORMICAR_SLOW").is_some() {
        full
    } else {
        quick
    }
}

mod answers;
mod chords;
mod collision;
mod colony;
mod continuous;
mod curves;
mod documents;
mod explanations;
mod formats;
mod grid_search;
mod improve;
mod maneuvers;
mod motion;
mod parameters;
mod pictures;
mod planners;
mod references;
mod replanning;
mod requests;
mod rivals;
mod smoothing;
mod threads;
mod tracking;
mod tuning;
mod validation;
