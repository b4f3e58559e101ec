//! A run out of a file of another planner.

use formicar::validation::Samples;

/// A run out of a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Imported {
    /// The planner, where the file names it.
    pub planner: Option<String>,
    /// Its place among the runs of this planner, from 0 on.
    pub run: u64,
    /// True if the planner states that it has found a path.
    pub is_found: bool,
    /// Its path, where the file holds one.
    pub samples: Option<Samples>,
    /// Time of the query by its own clock, seconds.
    pub query_s: Option<f64>,
    /// Length of the path by its own measure, meters.
    pub length_m: Option<f64>,
}
