//! Whether paired values differ.

use super::normal::two_sided;

/// What the signed-rank test finds in paired differences.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wilcoxon {
    /// Differences that are not 0.
    pub n: usize,
    /// The smaller of the sums of positive and of negative ranks.
    pub statistic: f64,
    /// Two-sided probability of a sum as small, if neither side were favored.
    pub p: f64,
}

/// The signed-rank test of Wilcoxon 1945, two-sided, by the normal approximation.
///
/// Differences of 0 are left out, equal ones share their mean rank, the variance is corrected for
/// ties, and there is no continuity correction: as `SciPy`'s `wilcoxon(zero_method="wilcox",
/// correction=False, method="approx")`. None where all differences are 0 or there are none. The
/// approximation is coarse below about ten differences.
pub fn wilcoxon(differences: &[f64]) -> Option<Wilcoxon> {
    let mut sorted: Vec<f64> = differences.iter().copied().filter(|d| *d != 0.0).collect();
    sorted.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
    if sorted.is_empty() {
        return None;
    }
    let (mut positive, mut negative, mut ties, mut rank) = (0.0, 0.0, 0.0, 0.0);
    for equal in sorted.chunk_by(|a, b| a.abs() == b.abs()) {
        let n = equal.len() as f64;
        let mean_rank = rank + 0.5 * (n + 1.0);
        let n_positive = equal.iter().filter(|d| **d > 0.0).count() as f64;
        positive += mean_rank * n_positive;
        negative += mean_rank * (n - n_positive);
        ties += n * (n * n - 1.0);
        rank += n;
    }
    let statistic = positive.min(negative);
    let mean = 0.25 * rank * (rank + 1.0);
    let variance = (rank * (rank + 1.0) * (2.0 * rank + 1.0) - 0.5 * ties) / 24.0;
    Some(Wilcoxon {
        n: sorted.len(),
        statistic,
        p: two_sided((statistic - mean) / variance.sqrt()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of `SciPy` 1.17.1.
    #[test]
    fn statistics_are_those_of_scipy() {
        let cases: [(&[f64], f64, f64); 3] = [
            (
                &[
                    6.0, 8.0, 14.0, 16.0, 23.0, 24.0, 28.0, 29.0, 41.0, -48.0, 49.0, 56.0, 60.0,
                    -67.0, 75.0,
                ],
                24.0,
                0.040_888_132_911_855_91,
            ),
            (
                &[
                    0.5, -0.5, 1.0, 0.0, 2.0, 2.0, -1.0, 0.0, 3.0, 4.5, -0.25, 2.0,
                ],
                8.0,
                0.045_997_790_011_386_3,
            ),
            (
                &[
                    -1.5, -2.0, 0.25, -3.0, -4.0, -0.5, -0.5, -6.0, -7.5, 1.0, -8.0,
                ],
                5.0,
                0.012_747_931_865_588_54,
            ),
        ];
        for (differences, statistic, p) in cases {
            let found = wilcoxon(differences).unwrap();
            assert_eq!(found.statistic, statistic);
            assert!((found.p - p).abs() < 1e-12, "{found:?}");
        }
    }

    #[test]
    fn nothing_is_found_in_nothing() {
        assert_eq!(wilcoxon(&[]), None);
        assert_eq!(wilcoxon(&[0.0, 0.0]), None);
    }
}
