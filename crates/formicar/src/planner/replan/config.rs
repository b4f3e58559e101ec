//! Parameters of replanning.

use crate::numeric::{OutOfRange, check_range};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Parameters of replanning.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ReplanConfig {
    /// By which share of its cost a path planned anew must be cheaper than what has become of the
    /// previous path, to take its place; 0 to 1. At 1 the previous path stays as long as it can be
    /// mended.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub consistency: f64,
}

impl Default for ReplanConfig {
    fn default() -> Self {
        Self { consistency: 0.05 }
    }
}

impl ReplanConfig {
    /// Checks the ranges.
    ///
    /// # Errors
    /// The first parameter outside its range.
    pub fn check(&self) -> Result<(), OutOfRange> {
        check_range("replan.consistency", self.consistency, 0.0..=1.0)
    }
}
