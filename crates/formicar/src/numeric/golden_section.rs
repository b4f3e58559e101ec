//! The least value of a function of one variable.

/// Where a function with one valley is least between `low` and `high`, by golden sections (Kiefer
/// 1953): the interval shrinks to 0.618 of itself in each of `n_sections`.
pub fn golden_section(
    value: impl Fn(f64) -> f64,
    [mut low, mut high]: [f64; 2],
    n_sections: u32,
) -> f64 {
    let golden = 0.5 * (5_f64.sqrt() - 1.0);
    for _ in 0..n_sections {
        let (a, b) = (high - golden * (high - low), low + golden * (high - low));
        if value(a) <= value(b) {
            high = b;
        } else {
            low = a;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_valley_and_stays_within() {
        let valley = golden_section(|x| (x - 0.3).powi(2), [-1.0, 2.0], 40);
        assert!((valley - 0.3).abs() < 1e-6, "{valley}");
        let edge = golden_section(|x| x, [1.0, 2.0], 40);
        assert!((1.0..1.0 + 1e-6).contains(&edge), "{edge}");
    }
}
