//! Evaporation that settles as the generations go by.

use crate::parameters::{Parameters, parameters};

parameters! {
    /// zeta(t) = zeta(0) a^(t / N) in generation t of N, from zeta(0) to a zeta(0): a reading of Li
    /// 2024 (24), whose text has it largest at first and settling later.
    ///
    /// To the letter, [`Recursion::Compound`], each generation multiplies the last one's share by
    /// a^(t / N): the powers add up, and evaporation all but ends after a few generations, so that
    /// it takes a floor.
    pub struct Generational {
        /// ζ₀: share that evaporates at first.
        #[range(0.0..=1.0)]
        pub rho: f64 = 0.5,
        /// a: what is left of that share in the last generation.
        #[range(0.001..=1.0)]
        pub decay: f64 = 0.4,
        /// Whether shares are multiplied on from generation to generation.
        pub recursion: Recursion = Recursion::Direct,
        /// The least share.
        #[range(0.0..=1.0)]
        pub rho_min: f64 = 0.05,
    }
}

/// Whether shares are multiplied on from generation to generation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Recursion {
    /// By the number of the generation alone.
    #[default]
    Direct,
    /// From the last generation's share.
    Compound,
}

impl Parameters for Recursion {}

impl Generational {
    /// rho after generation `iteration` of `n_iterations`, both counted from 0.
    pub fn rho(&self, iteration: u32, n_iterations: u32) -> f64 {
        let (t, n) = (f64::from(iteration), f64::from(n_iterations.max(1)));
        let exponent = match self.recursion {
            Recursion::Direct => t / n,
            // The sum of 1 / N, 2 / N and so on to t / N.
            Recursion::Compound => t * (t + 1.0) / (2.0 * n),
        };
        (self.rho * self.decay.powf(exponent)).max(self.rho_min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn falls_from_its_first_share_to_the_last() {
        let rule = Generational::default();
        assert_eq!(rule.rho(0, 50), 0.5);
        assert!((rule.rho(50, 50) - 0.2).abs() < 1e-12);
    }

    #[test]
    fn to_the_letter_it_ends_at_its_floor() {
        let rule = Generational {
            recursion: Recursion::Compound,
            ..Generational::default()
        };
        // Step by step as printed.
        let mut rho = rule.rho;
        for t in 1..8 {
            rho *= rule.decay.powf(f64::from(t) / 50.0);
            assert!((rule.rho(t, 50) - rho).abs() < 1e-12);
        }
        assert_eq!(rule.rho(49, 50), 0.05);
    }
}
