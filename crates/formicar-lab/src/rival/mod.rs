//! Rivals from outside: planners that are programs of others, and paths out of their files.
//!
//! A program reads one [`Question`] from stdin and prints one [`RivalAnswer`]. Its path is read as
//! `check` reads foreign paths and gets a [`Verdict`] of the judge, so that it stands in the same
//! table as our own. The crate `pathfinding` is the smallest such rival: [`pathfinding_answer`].

mod answer;
mod grid;
pub mod import;
mod process;
mod question;
mod verdict;

pub use answer::RivalAnswer;
pub use grid::pathfinding_answer;
pub use process::{Ended, run};
pub use question::{Ask, Question, RivalMap, RivalRequest, RivalVehicle, SCHEMA};
pub use verdict::{START_TOLERANCE, Verdict};
