//! Deposits of pheromone by the spread of turns and by length.

use crate::colony::generation::Generation;
use crate::objective::PolylineCost;
use crate::parameters::{Parameters, parameters};

parameters! {
    /// dtau = `P_h` (kappa1 `W_ref` / W + kappa2 `L_ref` / L) of Li 2024 (23), with W the mean
    /// squared deviation of the walking angle, at least (1 degree)^2, and L the length of a way.
    ///
    /// The references are those of the shortest path over cells, so that both parts have one scale
    /// (a reading: the paper divides by W and by L).
    pub struct SpreadDeposit {
        /// κ₁: weight of the spread of turns.
        #[range(0.0..=1e6)]
        pub spread_weight: f64 = 0.8,
        /// κ₂: weight of the length.
        #[range(0.0..=1e6)]
        pub length_weight: f64 = 0.2,
        /// `P_h`: pheromone.
        #[range(1e-6..=1e6)]
        pub pheromone: f64 = 1.0,
        /// The ants that deposit.
        pub by: Depositor = Depositor::Best,
    }
}

/// The ants that deposit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Depositor {
    /// The best of the generation.
    #[default]
    Best,
    /// All that arrived.
    All,
}

impl Parameters for Depositor {}

/// The least W: (1 degree)^2.
const MIN_VARIANCE_RAD2: f64 = 3.046_174_197_867_086e-4;

impl SpreadDeposit {
    /// The amount along the reference path itself.
    pub(super) fn unit(&self) -> f64 {
        self.pheromone * (self.spread_weight + self.length_weight)
    }

    /// The ants that deposit, in their order.
    pub(super) fn depositors(&self, generation: &Generation<PolylineCost>) -> Vec<usize> {
        match self.by {
            Depositor::Best => generation.best().into_iter().collect(),
            Depositor::All => generation.arrived().collect(),
        }
    }

    /// The amount that an ant adds along its path, given the reference path.
    pub(super) fn amount(&self, way: &PolylineCost, reference: &PolylineCost) -> f64 {
        let variance = |cost: &PolylineCost| cost.turn_variance_rad2.max(MIN_VARIANCE_RAD2);
        let spread = variance(reference) / variance(way);
        // A path without length is as good as its reference.
        let length = if way.length_m > 0.0 {
            reference.length_m / way.length_m
        } else {
            1.0
        };
        self.pheromone * (self.spread_weight * spread + self.length_weight * length)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn straighter_and_shorter_ways_get_more() {
        let way = |variance_deg2: f64, length_m: f64| PolylineCost {
            turn_variance_rad2: variance_deg2 * MIN_VARIANCE_RAD2,
            length_m,
            ..PolylineCost::default()
        };
        let (rule, reference) = (SpreadDeposit::default(), way(100.0, 50.0));
        let amount = |variance, length| rule.amount(&way(variance, length), &reference);
        assert!((amount(100.0, 50.0) - 1.0).abs() < 1e-12);
        assert!((amount(50.0, 100.0) - 1.7).abs() < 1e-12);
        // The spread counts as at least one degree.
        assert!((amount(0.0, 50.0) - 80.2).abs() < 1e-9);
    }
}
