//! Always the same share.

use crate::numeric::{OutOfRange, check_range};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A constant rho (Dorigo, Maniezzo & Colorni 1996).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Constant {
    /// Share that evaporates, from 0 to 1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub rho: f64,
}

impl Default for Constant {
    fn default() -> Self {
        Self { rho: 0.5 }
    }
}

impl Constant {
    pub(super) fn check(&self) -> Result<(), OutOfRange> {
        check_range("colony.evaporation.rho", self.rho, 0.0..=1.0)
    }
}
