//! Evaporation along a Poisson distribution (Lei & Zheng 2020).

use crate::numeric::ln_gamma;
use crate::parameters::{OutOfRange, parameters};

parameters! {
    /// rho(k) = A lambda^k exp(-lambda) / k! + B: Lei & Zheng 2020 (1), "D-Rho".
    ///
    /// k is the number of the iteration divided by `stretch`, and k! is Gamma(k + 1). At 1 the
    /// formula is taken to the letter: with lambda = 10 the trough lies at iterations 9 and 10. At
    /// N / 20 it lies in the middle of a run of N iterations, as the text on figure 5 has it.
    pub struct PoissonEvaporation {
        /// λ: mean of the distribution.
        #[range(1e-3..=1000.0)]
        pub lambda: f64 = 10.0,
        /// A: depth of the trough, negative.
        #[range(-100.0..=100.0)]
        pub amplitude: f64 = -5.0,
        /// B: the share far from the trough.
        #[range(0.0..=1.0)]
        pub offset: f64 = 0.9,
        /// Iterations to a unit of k.
        #[range(1e-3..=1e6)]
        pub stretch: f64 = 1.0,
    }
}

impl PoissonEvaporation {
    /// Checks that the share stays between 0 and 1 in every iteration of a run.
    pub(super) fn check_run(&self, n_iterations: u32) -> Result<(), OutOfRange> {
        let mut shares = (0..n_iterations).map(|iteration| (iteration, self.rho(iteration)));
        let bad = shares.find(|&(_, rho)| rho <= 0.0 || rho >= 1.0);
        bad.map_or(Ok(()), |(iteration, rho)| {
            Err(OutOfRange {
                key: format!("rho at iteration {iteration}"),
                value: rho,
                range: "above 0 and below 1; hint: change amplitude or offset".to_owned(),
            })
        })
    }

    /// rho after an iteration.
    pub fn rho(&self, iteration: u32) -> f64 {
        // Lei 2020 (1), in logarithms: the factorial overflows from k = 171 on.
        let k = f64::from(iteration) / self.stretch;
        let log_probability = k * self.lambda.ln() - self.lambda - ln_gamma(k + 1.0);
        self.amplitude * log_probability.exp() + self.offset
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn has_its_trough_at_iterations_9_and_10() {
        let rule = PoissonEvaporation::default();
        let rho = |iteration| rule.rho(iteration);
        assert!((rho(0) - (0.9 - 5.0 * (-10.0_f64).exp())).abs() < 1e-12);
        assert!((rho(9) - 0.2745).abs() < 1e-4 && (rho(9) - rho(10)).abs() < 1e-12);
        assert!((0..150).all(|k| rho(k) >= rho(9)));
        assert!(rho(17) < 0.85 && rho(18) > 0.85);
        assert!((rho(10_000) - 0.9).abs() < 1e-12);
    }

    #[test]
    fn stretched_it_has_its_trough_in_the_middle() {
        let rule = PoissonEvaporation {
            stretch: 150.0 / 20.0,
            ..PoissonEvaporation::default()
        };
        let least = (0..150).min_by(|&a, &b| rule.rho(a).total_cmp(&rule.rho(b)));
        assert!((68..=76).contains(&least.unwrap()), "{least:?}");
    }

    #[test]
    fn names_the_iteration_that_leaves_the_range() {
        let rule = PoissonEvaporation {
            offset: 0.6,
            ..PoissonEvaporation::default()
        };
        let error = rule.check_run(150).unwrap_err();
        assert_eq!(error.key, "rho at iteration 9");
        assert!(rule.check_run(9).is_ok());
        let just_enough = PoissonEvaporation {
            offset: 0.6256,
            ..PoissonEvaporation::default()
        };
        assert!(just_enough.check_run(150).is_ok());
    }
}
