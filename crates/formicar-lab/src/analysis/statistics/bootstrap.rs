//! The confidence interval of a median.

use super::quantile;
use formicar::numeric::Seed;

/// Samples drawn anew.
const N_RESAMPLES: usize = 2000;

/// The 95 % interval of the median by the percentile bootstrap (Efron 1979): medians of 2000
/// samples drawn with replacement, the random numbers those of the seed. None of nothing.
pub fn bootstrap_median(values: &[f64], seed: Seed) -> Option<[f64; 2]> {
    if values.is_empty() {
        return None;
    }
    let mut sample = vec![0.0; values.len()];
    let medians: Vec<f64> = (0..N_RESAMPLES)
        .filter_map(|i| {
            let mut random = seed.stream([i as u64, 0]);
            sample.fill_with(|| values[random.below(values.len())]);
            quantile(&sample, 0.5)
        })
        .collect();
    Some([quantile(&medians, 0.025)?, quantile(&medians, 0.975)?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn covers_the_median_and_repeats_itself() {
        let values: Vec<f64> = (1..=31).map(f64::from).collect();
        let [low, high] = bootstrap_median(&values, Seed(0)).unwrap();
        // Of order statistics of 31 values, those 10 and 22 bound the median at 97 %, those 11
        // and 21 at 93 %.
        assert!((9.0..=12.0).contains(&low), "{low}");
        assert!((20.0..=23.0).contains(&high), "{high}");
        assert_eq!(bootstrap_median(&values, Seed(0)), Some([low, high]));
        assert_eq!(bootstrap_median(&[2.5; 4], Seed(3)), Some([2.5, 2.5]));
        assert_eq!(bootstrap_median(&[], Seed(3)), None);
    }
}
