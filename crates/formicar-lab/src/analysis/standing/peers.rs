//! Results of other tools on the same scenarios.

use anyhow::{Context, Result};
use serde::Deserialize;

/// A peer on a scenario.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
pub struct Peer {
    /// The scenario.
    pub scenario: String,
    /// The peer.
    pub peer: String,
    /// 1 where it returned a path.
    pub solved: u8,
    /// 1 where the path can be driven; missing where nobody looked.
    pub valid: Option<u8>,
    /// Time to its first path, seconds.
    pub first_s: Option<f64>,
    /// Length of its path after 1 s, meters.
    pub length_1s_m: Option<f64>,
    /// Changes of gear.
    pub cusps: Option<f64>,
    /// Least clearance, meters.
    pub min_clearance_m: Option<f64>,
    /// Most memory, megabytes.
    pub peak_mb: Option<f64>,
}

impl Peer {
    /// The rows of a `peers.csv`.
    ///
    /// # Errors
    /// A table with other columns, or with values that are none.
    pub fn read(text: &str) -> Result<Vec<Self>> {
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let rows: csv::Result<_> = reader.deserialize().collect();
        rows.context("a table of peers")
    }

    /// True if its path can be driven.
    pub(super) fn is_valid(&self) -> bool {
        self.solved == 1 && self.valid == Some(1)
    }

    /// True if it drives forward only.
    pub(super) fn is_dubins(&self) -> bool {
        self.peer.ends_with("dubins")
    }
}
