//! Every ant that arrived deposits (Dorigo, Maniezzo & Colorni 1996).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Q / F from every ant that arrived: the ant-cycle form of the Ant System.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct AllAnts {
    /// Q, from 1e-6 to 1e9.
    #[schemars(range(min = 1e-6, max = 1e9))]
    pub q: f64,
}

impl Default for AllAnts {
    fn default() -> Self {
        Self { q: 100.0 }
    }
}
