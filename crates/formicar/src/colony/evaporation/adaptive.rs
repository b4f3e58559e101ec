//! Evaporation that falls whenever the colony stagnates.

use crate::numeric::{OutOfRange, check_range};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// rho = max(`rho_min`, rho `decay`^n) after n iterations that brought no better path.
///
/// The usual adaptive form; it stands for the "adaptive model" of Zhang 2016, which Wang 2019
/// names and does not write down.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Adaptive {
    /// Share that evaporates at first, from 0 to 1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub rho: f64,
    /// What it is multiplied with by an iteration without a better path, from 0.01 to 1.
    #[schemars(range(min = 0.01, max = 1.0))]
    pub decay: f64,
    /// The least share, from 0 to 1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub rho_min: f64,
}

impl Default for Adaptive {
    fn default() -> Self {
        Self {
            rho: 0.43,
            decay: 0.95,
            rho_min: 0.1,
        }
    }
}

impl Adaptive {
    pub(super) fn check(&self) -> Result<(), OutOfRange> {
        check_range("colony.evaporation.rho", self.rho, 0.0..=1.0)?;
        check_range("colony.evaporation.decay", self.decay, 0.01..=1.0)?;
        check_range("colony.evaporation.rho_min", self.rho_min, 0.0..=1.0)
    }

    /// rho after so many iterations without a better path.
    pub fn rho(&self, n_stagnant: u32) -> f64 {
        (self.rho * self.decay.powf(f64::from(n_stagnant))).max(self.rho_min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn falls_to_its_least() {
        let rule = Adaptive::default();
        assert_eq!(rule.rho(0), 0.43);
        assert!((rule.rho(1) - 0.4085).abs() < 1e-12);
        assert_eq!(rule.rho(1000), 0.1);
    }
}
