//! Rows of `results.csv`, as far as they are looked at here.

use anyhow::{Context, Result};
use serde::Deserialize;

/// A run; what it did not come to is missing.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
pub struct Measured {
    /// The scenario.
    pub scenario: String,
    /// The planner, or the variant of one.
    pub planner: String,
    /// The seed.
    pub seed: u64,
    /// How it ended.
    pub status: String,
    /// Whether the judge certified the path.
    pub valid: Option<bool>,
    /// The file or map that the scenario is of.
    pub source: String,
    /// Columns of the map.
    pub n_cols: Option<u32>,
    /// Rows of the map.
    pub n_rows: Option<u32>,
    /// Map set-up, seconds.
    pub map_setup_s: Option<f64>,
    /// Time to the first certified path, seconds.
    pub first_feasible_s: Option<f64>,
    /// The same of a planner that has just been made, seconds.
    pub cold_first_s: Option<f64>,
    /// The whole query, seconds.
    pub query_s: Option<f64>,
    /// Judging the path once more, seconds.
    pub judge_s: Option<f64>,
    /// Most memory of the process, bytes.
    pub peak_rss_bytes: Option<f64>,
    /// Length of the first certified path, metres.
    pub first_length_m: Option<f64>,
    /// Length of the best path 0.1 s into the query.
    #[serde(rename = "length_0.1s_m")]
    pub length_by_tenth_m: Option<f64>,
    /// Length of the best path 1 s into the query.
    #[serde(rename = "length_1s_m")]
    pub length_by_second_m: Option<f64>,
    /// Length of the path in the end.
    pub length_m: Option<f64>,
    /// What it costs to drive, metres.
    pub cost_m: Option<f64>,
    /// Its least clearance, metres.
    pub min_clearance_m: Option<f64>,
    /// The lesser of the clearances at start and goal alone, metres.
    pub ends_clearance_m: Option<f64>,
    /// Changes of gear.
    pub n_cusps: Option<f64>,
    /// Steps to the first certified path.
    pub first_steps: Option<f64>,
    /// Steps in all.
    pub steps: Option<f64>,
}

impl Measured {
    /// Whether a path was returned that carries a certificate.
    pub(super) fn is_solved(&self) -> bool {
        self.status == "found" && self.valid == Some(true)
    }
}

pub(super) fn read(text: &str) -> Result<Vec<Measured>> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let rows: csv::Result<_> = reader.deserialize().collect();
    rows.context("results")
}
