//! Experiments: what papers claim, repeated on maps of our own and measured.
//!
//! An experiment is a list of [`Variant`]s, configurations with a name, that run on the same
//! [`Ground`]s with the same seeds. Every run gives a [`Trial`], a row of `results.csv`; a
//! [`Reproduction`] holds all rows and a summary in Markdown.

mod experiment;
mod lei2020;
mod markdown;
pub mod statistics;
mod trial;
mod wang2019;

pub use experiment::{Ground, Reproduction, Scale, Variant};
pub use lei2020::lei2020;
pub use trial::Trial;
pub use wang2019::wang2019;
