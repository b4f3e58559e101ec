//! Dead ends: cells from which no step is left.

mod retreat;

pub use retreat::Retreat;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The behavior of an ant at a dead end, where every neighbor is blocked or visited.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "rule", rename_all = "kebab-case")]
pub enum DeadEnd {
    /// It dies.
    #[default]
    Die,
    /// It steps back.
    Retreat(Retreat),
}

impl DeadEnd {
    /// Steps back that an ant may take in all.
    pub(super) fn max_retreats(&self) -> u32 {
        match self {
            Self::Die => 0,
            Self::Retreat(rule) => rule.max_steps,
        }
    }
}
