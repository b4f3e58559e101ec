//! Evidence about planners: experiments, campaigns, statistics, reports.
//!
//! A [`campaign::Campaign`] is what a user asks for in a file; its runs are kept in a store, which
//! becomes a report or one side of a comparison ([`analysis::compare`]). A reproduction of a paper
//! ([`papers`]) is a list of configurations that run on the same grounds with the same seeds.

pub mod analysis;
pub mod campaign;
pub mod papers;
pub mod report;
pub mod rival;
pub mod run;
pub mod stress;
pub mod tuning;
mod words;
