//! Stepping back out of dead ends.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The ant steps back the way it came, as often as it takes, and never enters the dead end again.
/// Steps into it and back leave its way, so that a way has no spurs.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Retreat {
    /// Steps back that an ant may take in all before it dies.
    pub max_steps: u32,
}

impl Default for Retreat {
    fn default() -> Self {
        Self { max_steps: 1000 }
    }
}
