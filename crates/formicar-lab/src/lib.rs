//! Evidence about planners: experiments, campaigns, statistics, reports.
//!
//! An experiment is a list of [`Variant`]s, configurations with a name, that run on the same
//! [`Ground`]s with the same seeds; a [`Reproduction`] holds all rows and a [`report::Report`]. A
//! [`campaign::Campaign`] is what a user asks for in a file; its runs are kept in a store, which
//! becomes a report too, or one side of a comparison ([`mod@compare`]).

pub mod campaign;
pub mod claims;
pub mod compare;
mod correspondence;
mod exhibit;
mod experiment;
mod lei2020;
mod li2024;
mod parallel;
mod parameters;
mod replanning;
pub mod report;
mod reproduction;
pub mod rival;
mod scaling;
pub mod standing;
pub mod statistics;
pub mod stress;
mod trial;
mod trial_log;
mod trials;
pub mod tuning;
mod wang2019;

pub use experiment::{Ground, Scale, Setup, Variant};
pub use lei2020::lei2020;
pub use li2024::li2024;
pub use replanning::replanning;
pub use reproduction::Reproduction;
pub use scaling::scaling;
pub use trial::Trial;
pub use wang2019::wang2019;
