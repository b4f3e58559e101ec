//! Checks of the module structure of all crates, as tests of this one.
//!
//! A module uses only modules of lower rank, files do not use each other in circles, and the
//! library does not touch the outside world. The lists of ranks are in `ranks.rs`.

mod circles;
mod purity;
mod ranks;
mod scan;
mod source;

pub use circles::circles;
pub use purity::{Purity, purity_faults};
pub use ranks::{CLI, DRIVE, LAB, LIBRARY, MAPPING, PYTHON, RECORD, STUDIO, rank_faults};
pub use source::{Crate, File};

#[cfg(test)]
mod tests;
