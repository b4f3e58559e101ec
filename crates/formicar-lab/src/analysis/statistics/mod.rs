//! Numbers about many runs.

mod bootstrap;
mod effect;
mod holm;
mod normal;
mod signed_ranks;
mod wilcoxon;
mod wilson;

pub use bootstrap::bootstrap_median;
pub use effect::vargha_delaney_a;
pub use holm::holm;
pub use wilcoxon::{SignedRanks, Wilcoxon, rank_balance, wilcoxon, wilcoxon_normal};
pub use wilson::wilson_interval;

/// Every value once, in the order in which they come.
pub(crate) fn distinct<T: PartialEq>(values: impl Iterator<Item = T>) -> Vec<T> {
    let mut known = Vec::new();
    for value in values {
        if !known.contains(&value) {
            known.push(value);
        }
    }
    known
}

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

/// A quantile of values of which some may be infinite: where it lies between values of which one
/// is, it is infinite too.
pub(crate) fn quantile_or_forever(values: &[f64], p: f64) -> Option<f64> {
    let between = quantile(values, p)?;
    if !between.is_nan() {
        return Some(between);
    }
    // Infinity less itself, or none of infinity: the value lies on its lower neighbor.
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted
        .get((p * (sorted.len() - 1) as f64) as usize)
        .copied()
}

/// The median of values of which some may be infinite.
pub(crate) fn median(values: &[f64]) -> Option<f64> {
    quantile_or_forever(values, 0.5)
}

/// Median and quartiles: 0.25, 0.5, 0.75.
pub fn quartiles(values: &[f64]) -> Option<[f64; 3]> {
    let [a, b, c] = [0.25, 0.5, 0.75].map(|p| quantile(values, p));
    Some([a?, b?, c?])
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
}
