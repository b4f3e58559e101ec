//! Numbers about many runs.

/// The quantile `p` in 0 to 1 of values in any order, by linear interpolation between order
/// statistics (Hyndman & Fan 1996, type 7); none of nothing.
pub fn quantile(values: &[f64], p: f64) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let last = sorted.len().checked_sub(1)?;
    let place = p.clamp(0.0, 1.0) * last as f64;
    let (below, share) = (place.floor() as usize, place.fract());
    let above = (below + 1).min(last);
    Some(sorted[below] + share * (sorted[above] - sorted[below]))
}

/// Median and quartiles: 0.25, 0.5, 0.75.
pub fn quartiles(values: &[f64]) -> Option<[f64; 3]> {
    let [a, b, c] = [0.25, 0.5, 0.75].map(|p| quantile(values, p));
    Some([a?, b?, c?])
}

/// The 95 % interval of a rate after `n_success` of `n` (Wilson 1927).
pub fn wilson_interval(n_success: usize, n: usize) -> (f64, f64) {
    const Z: f64 = 1.959_963_984_540_054;
    if n == 0 {
        return (0.0, 1.0);
    }
    let (n, rate) = (n as f64, n_success as f64 / n as f64);
    let middle = rate + Z * Z / (2.0 * n);
    let half = Z * (rate * (1.0 - rate) / n + Z * Z / (4.0 * n * n)).sqrt();
    let scale = 1.0 + Z * Z / n;
    ((middle - half) / scale, (middle + half) / scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_interpolate() {
        assert_eq!(quantile(&[4.0, 1.0, 3.0, 2.0], 0.5), Some(2.5));
        assert_eq!(quartiles(&[1.0, 2.0, 3.0, 4.0, 5.0]), Some([2.0, 3.0, 4.0]));
        assert_eq!(quantile(&[], 0.5), None);
    }

    #[test]
    fn wilson_is_that_of_the_tables() {
        // 8 of 10: 0.490 to 0.943.
        let (low, high) = wilson_interval(8, 10);
        assert!((low - 0.4902).abs() < 1e-4 && (high - 0.9433).abs() < 1e-4);
        let (low, high) = wilson_interval(31, 31);
        assert!((high - 1.0).abs() < 1e-12 && (low - 0.8897).abs() < 1e-4);
    }
}
