//! The cost of the corner before a step.

use crate::parameters::{Parameters, parameters, rules};

rules! {
    /// omega of Li 2024 (18): what the corner before a step costs, in terms of the steering phi
    /// that it needs and the steering `phi_c` that the vehicle has; a step that needs more is none.
    ///
    /// The factor of the generation k of N is (N - k) / k. It makes corners matter most at first,
    /// and not at all in the last generation.
    pub enum CornerTerm {
        /// omega = epsilon G |phi| / `phi_c` (N - k) / k, read as a product.
        Product(CornerRule),
        /// omega = (epsilon G + |phi| / `phi_c`) (N - k) / k, read as a sum.
        Sum(CornerRule),
        /// Corners cost nothing.
        None,
    }
}

parameters! {
    /// Parameters of the corner term.
    pub struct CornerRule {
        /// ε: weight of the turn.
        #[range(0.0..=1e6)]
        pub epsilon: f64 = 0.1,
        /// The quantity G.
        pub straightness: StraightnessUse = StraightnessUse::MeanTurn,
    }
}

/// The quantity G in the corner term.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum StraightnessUse {
    /// Li 2024 (19): the mean of the last turns, weighted by the steps beside them.
    #[default]
    MeanTurn,
    /// One.
    One,
}

impl Parameters for StraightnessUse {}

impl CornerTerm {
    /// omega of a step that needs a share |phi| / `phi_c` of the steering, with G and the factor
    /// of the generation.
    #[inline]
    pub(super) fn omega(&self, steering_share: f64, straightness: f64, factor: f64) -> f64 {
        let g = |rule: &CornerRule| match rule.straightness {
            StraightnessUse::MeanTurn => straightness,
            StraightnessUse::One => 1.0,
        };
        match self {
            Self::Product(rule) => rule.epsilon * g(rule) * steering_share * factor,
            Self::Sum(rule) => (rule.epsilon * g(rule) + steering_share) * factor,
            Self::None => 0.0,
        }
    }
}
