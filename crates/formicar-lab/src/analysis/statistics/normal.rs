//! Tails of the normal distribution.

use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// Below this the series of the error function converges fast, above it the continued fraction.
const SERIES_TO: f64 = 2.0;

/// The probability that a standard normal number lies as far from 0 as `z`, or farther.
pub(super) fn two_sided(z: f64) -> f64 {
    erfc(z.abs() * FRAC_1_SQRT_2)
}

/// The complementary error function of a number from 0 on.
fn erfc(x: f64) -> f64 {
    if x < SERIES_TO {
        1.0 - erf_series(x)
    } else {
        erfc_fraction(x)
    }
}

/// Abramowitz & Stegun 7.1.6: erf x = 2/sqrt(pi) exp(-x^2) sum of 2^n x^(2n+1) / (2n+1)!!.
fn erf_series(x: f64) -> f64 {
    let (mut term, mut sum, mut n) = (x, x, 0.0);
    while term > 1e-17 * sum {
        n += 1.0;
        term *= 2.0 * x * x / (2.0 * n + 1.0);
        sum += term;
    }
    2.0 / PI.sqrt() * (-x * x).exp() * sum
}

/// Abramowitz & Stegun 7.1.14, from the inside out.
fn erfc_fraction(x: f64) -> f64 {
    let inner = (1..=80)
        .rev()
        .fold(x, |inner, k| x + 0.5 * f64::from(k) / inner);
    (-x * x).exp() / (PI.sqrt() * inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tails_are_those_of_the_tables() {
        for (z, p) in [
            (0.0, 1.0),
            (1.0, 0.317_310_507_862_914_1),
            (-1.959_963_984_540_054, 0.05),
            (2.8, 0.005_110_260_660_855_875),
            (3.5, 0.000_465_258_158_071_050_03),
            (6.0, 1.973_175_290_075_403_6e-9),
        ] {
            let found = two_sided(z);
            assert!(
                (found - p).abs() <= 1e-10 * p,
                "{z}: {found} instead of {p}"
            );
        }
    }
}
