//! The distance term of a step's weight.

use crate::numeric::{OutOfRange, check_range};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Q = D + 1 / d of Li 2024 (27), with the straight distance d from a step's end to the goal in
/// cells.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "rule", rename_all = "kebab-case")]
pub enum DistanceTerm {
    /// D by what is known of ways from here.
    KnownLengths(KnownLengths),
    /// D = 0.
    None,
}

/// D of Li 2024 (20): eta (`L_max` - d) / (1 + `L_max` - `L_min`) (N - k) / k, where `L_max` and
/// `L_min` are the longest and the shortest way to the goal found so far from the ant's cell, in
/// cells. Before there is any they are read as the goal field's value and the largest one among
/// cell and candidates.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct KnownLengths {
    /// eta, from 0 to 1e6.
    #[schemars(range(min = 0.0, max = 1e6))]
    pub eta: f64,
}

impl Default for KnownLengths {
    fn default() -> Self {
        Self { eta: 1.1 }
    }
}

impl DistanceTerm {
    pub(super) fn check(&self) -> Result<(), OutOfRange> {
        match self {
            Self::KnownLengths(rule) => check_range("chords.distance.eta", rule.eta, 0.0..=1e6),
            Self::None => Ok(()),
        }
    }

    /// Q of a step that ends `distance` from the goal, from a cell with the longest and the
    /// shortest known way, with the factor of the generation.
    #[inline]
    pub(super) fn quality(&self, distance: f64, [longest, shortest]: [f64; 2], factor: f64) -> f64 {
        let nearness = 1.0 / distance.max(0.5);
        match self {
            Self::KnownLengths(rule) => {
                let saved = (longest - distance).max(0.0);
                rule.eta * saved / (1.0 + longest - shortest) * factor + nearness
            }
            Self::None => nearness,
        }
    }
}
