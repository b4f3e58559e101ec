//! The gamma function.

/// Bernoulli numbers B(2k) / (2k (2k - 1)).
const SERIES: [f64; 7] = [
    1.0 / 12.0,
    -1.0 / 360.0,
    1.0 / 1260.0,
    -1.0 / 1680.0,
    1.0 / 1188.0,
    -691.0 / 360_360.0,
    1.0 / 156.0,
];

/// ln Gamma(x) for x > 0, to about 1e-14 of itself: Stirling's series from 10 on, and below it the
/// recurrence Gamma(x + 1) = x Gamma(x).
pub fn ln_gamma(x: f64) -> f64 {
    let (mut x, mut product) = (x, 1.0);
    while x < 10.0 {
        product *= x;
        x += 1.0;
    }
    let inverse_square = 1.0 / (x * x);
    let series = SERIES
        .iter()
        .rev()
        .fold(0.0, |sum, term| sum * inverse_square + term)
        / x;
    let half_ln_tau = 0.5 * std::f64::consts::TAU.ln();
    (x - 0.5) * x.ln() - x + half_ln_tau + series - product.ln()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_the_logarithm_of_the_factorial() {
        let mut log_factorial = 0.0_f64;
        for n in 1..300_u32 {
            let error = ln_gamma(f64::from(n)) - log_factorial;
            assert!(error.abs() < 1e-12 * log_factorial.max(1.0), "{n}: {error}");
            log_factorial += f64::from(n).ln();
        }
        let half = std::f64::consts::PI.sqrt().ln();
        assert!((ln_gamma(0.5) - half).abs() < 1e-13);
    }
}
