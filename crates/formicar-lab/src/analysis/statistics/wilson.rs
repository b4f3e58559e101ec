//! Intervals of rates.

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
    fn wilson_is_that_of_the_tables() {
        // 8 of 10: 0.490 to 0.943.
        let (low, high) = wilson_interval(8, 10);
        assert!((low - 0.4902).abs() < 1e-4 && (high - 0.9433).abs() < 1e-4);
        let (low, high) = wilson_interval(31, 31);
        assert!((high - 1.0).abs() < 1e-12 && (low - 0.8897).abs() < 1e-4);
    }
}
