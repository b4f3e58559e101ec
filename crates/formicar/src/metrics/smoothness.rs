//! The smoothness of OMPL's `PathGeometric`, which MATLAB's `pathmetrics` shares.

use std::f64::consts::PI;

/// Sum over consecutive states of [2 (pi - angle) / (a + b)]^2, where a, b, c are the distances of
/// three states in order and the angle is that opposite c. Terms whose cosine lies outside (-1, 1)
/// are skipped, as there.
pub(super) fn smoothness<S>(states: &[S], distance: impl Fn(&S, &S) -> f64) -> f64 {
    let term = |w: &[S]| {
        let (a, b) = (distance(&w[0], &w[1]), distance(&w[1], &w[2]));
        let c = distance(&w[0], &w[2]);
        let cos = (a * a + b * b - c * c) / (2.0 * a * b);
        if cos > -1.0 && cos < 1.0 {
            (2.0 * (PI - cos.acos()) / (a + b)).powi(2)
        } else {
            0.0
        }
    };
    // From 0, since the empty sum is -0.
    states.windows(3).map(term).fold(0.0, |sum, t| sum + t)
}
