//! Tuning: a bee colony looks for a planner's parameters on some scenarios, and what it found is
//! held against the default on others.
//!
//! [`TuningSpace`] says which parameters, by the ranges of the configuration's schema; [`Tuning`]
//! on which scenarios and by which [`Objective`]; [`Tuning::begin`] and [`Tuning::cycle`] search,
//! and [`Tuning::verdict`] looks at the scenarios that were held back. Steps and costs decide,
//! never time, so that the same tuning gives the same result anywhere.

mod convergence;
mod document;
mod evaluate;
mod leaf;
mod objective;
mod runs;
mod space;
mod split;
mod state;
mod verdict;

pub use document::{is_as_tuned, tuned_text};
pub use evaluate::Tuning;
pub(crate) use leaf::ranges;
pub use objective::{Measure, Objective};
pub use runs::{Asked, TunedRun};
pub use space::{OwnRange, TuningSpace};
pub use split::split;
pub use state::TuningState;
pub use verdict::Verdict;

#[cfg(test)]
mod tests;
