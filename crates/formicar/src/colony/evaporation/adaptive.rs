//! Evaporation that falls whenever the colony stagnates.

use crate::parameters::parameters;

parameters! {
    /// rho = max(`rho_min`, rho `decay`^n) after n iterations that brought no better path.
    ///
    /// The usual adaptive form; it stands for the "adaptive model" of Zhang 2016, which Wang 2019
    /// names and does not write down.
    pub struct Adaptive {
        /// ρ₀: share that evaporates at first.
        #[range(0.0..=1.0)]
        pub rho: f64 = 0.43,
        /// Factor on ρ for each iteration without a better path.
        #[range(0.01..=1.0)]
        pub decay: f64 = 0.95,
        /// The least share.
        #[range(0.0..=1.0)]
        pub rho_min: f64 = 0.1,
    }
}

impl Adaptive {
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
