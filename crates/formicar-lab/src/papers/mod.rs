//! Reproductions of papers, and measurements of our own in the same form.
//!
//! An experiment is a list of [`Variant`]s, configurations with a name, that run on the same
//! [`Ground`]s with the same seeds; a [`Reproduction`] holds all rows and a
//! [`Report`](crate::report::Report).

pub mod claims;
mod correspondence;
mod drawn_run;
pub(crate) mod experiment;
mod group;
mod lei2020;
mod li2024;
pub(crate) mod parameters;
mod replanning;
pub(crate) mod reproduction;
mod scaling;
mod trial;
mod trial_log;
mod trials;
mod wang2019;

pub use experiment::{Ground, Scale, Setup, Variant};
pub use lei2020::lei2020;
pub use li2024::li2024;
pub use replanning::replanning;
pub use reproduction::Reproduction;
pub use scaling::scaling;
pub use trial::Trial;
pub use wang2019::wang2019;
