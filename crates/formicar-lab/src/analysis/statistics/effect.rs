//! The size of the difference between two groups.

/// The A of Vargha & Delaney 2000: the probability that a value of `a` is above one of `b`, equal
/// ones counting half; none where a group is empty.
pub fn vargha_delaney_a(a: &[f64], b: &[f64]) -> Option<f64> {
    if a.is_empty() || b.is_empty() {
        return None;
    }
    let above = |x: f64, y: f64| 0.5 * (f64::from(u8::from(x > y)) + f64::from(u8::from(x >= y)));
    let sum: f64 = a
        .iter()
        .map(|&x| b.iter().map(|&y| above(x, y)).sum::<f64>())
        .sum();
    Some(sum / (a.len() * b.len()) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_pairs_in_order() {
        assert_eq!(vargha_delaney_a(&[3.0, 4.0], &[1.0, 2.0]), Some(1.0));
        assert_eq!(vargha_delaney_a(&[1.0, 2.0], &[1.0, 2.0]), Some(0.5));
        // 2 > 1, 2 = 2, 2 < 3, and 5 above all: 4.5 of 6.
        assert_eq!(vargha_delaney_a(&[2.0, 5.0], &[1.0, 2.0, 3.0]), Some(0.75));
        assert_eq!(vargha_delaney_a(&[], &[1.0]), None);
    }
}
