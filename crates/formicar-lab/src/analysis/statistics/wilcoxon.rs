//! Wilcoxon's signed-rank test on paired values.

use super::normal::two_sided;
use super::signed_ranks::two_sided_exact;

/// The most differences whose probability is counted.
const MAX_EXACT: usize = 50;
/// The same where some differences are equal in size.
const MAX_EXACT_TIED: usize = 13;

/// The origin of the probability of a signed-rank test.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SignedRanks {
    /// Counted over all signs that the ranks can have.
    Exact,
    /// The normal distribution, its variance corrected for ties, without continuity correction.
    Normal,
}

/// The result of the signed-rank test on paired differences.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wilcoxon {
    /// Differences that are not 0.
    pub n: usize,
    /// The smaller of the sums of positive and of negative ranks.
    pub statistic: f64,
    /// Two-sided probability of a sum as small, if neither side were favored.
    pub p: f64,
    /// Its origin.
    pub method: SignedRanks,
}

/// The signed-rank test of Wilcoxon 1945, two-sided.
///
/// Differences of 0 are left out and equal ones share their mean rank. The probability is exact
/// for up to 50 differences of different sizes and for up to 13 of which some are equal; beyond
/// that it is that of the normal approximation with its variance corrected for ties and without
/// continuity correction: as `SciPy`'s `wilcoxon(d[d != 0], correction=False, method="auto")`.
/// None where all differences are 0 or there are none.
pub fn wilcoxon(differences: &[f64]) -> Option<Wilcoxon> {
    let ranked = Ranked::new(differences)?;
    let most = if ranked.is_tied {
        MAX_EXACT_TIED
    } else {
        MAX_EXACT
    };
    let is_exact = ranked.ranks.len() <= most;
    Some(Wilcoxon {
        n: ranked.ranks.len(),
        statistic: ranked.positive.min(ranked.negative),
        p: if is_exact {
            two_sided_exact(&ranked.ranks, ranked.positive)
        } else {
            ranked.p_normal()
        },
        method: if is_exact {
            SignedRanks::Exact
        } else {
            SignedRanks::Normal
        },
    })
}

/// The same by the normal approximation, however few differences there are.
pub fn wilcoxon_normal(differences: &[f64]) -> Option<Wilcoxon> {
    let ranked = Ranked::new(differences)?;
    Some(Wilcoxon {
        n: ranked.ranks.len(),
        statistic: ranked.positive.min(ranked.negative),
        p: ranked.p_normal(),
        method: SignedRanks::Normal,
    })
}

/// The sum of the positive ranks minus that of the negative ones: to which side the differences
/// lean.
pub fn rank_balance(differences: &[f64]) -> f64 {
    Ranked::new(differences).map_or(0.0, |ranked| ranked.positive - ranked.negative)
}

/// Differences other than 0, ranked by size.
struct Ranked {
    /// Ranks in ascending order, equal differences sharing theirs.
    ranks: Vec<f64>,
    /// Sum of the ranks of positive differences.
    positive: f64,
    negative: f64,
    /// Sum of t^3 - t over groups of t equal sizes.
    ties: f64,
    is_tied: bool,
}

impl Ranked {
    fn new(differences: &[f64]) -> Option<Self> {
        let mut sorted: Vec<f64> = differences.iter().copied().filter(|d| *d != 0.0).collect();
        sorted.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
        if sorted.is_empty() {
            return None;
        }
        let mut ranked = Self {
            ranks: Vec::with_capacity(sorted.len()),
            positive: 0.0,
            negative: 0.0,
            ties: 0.0,
            is_tied: false,
        };
        for equal in sorted.chunk_by(|a, b| a.abs() == b.abs()) {
            let n = equal.len() as f64;
            let mean_rank = ranked.ranks.len() as f64 + 0.5 * (n + 1.0);
            let n_positive = equal.iter().filter(|d| **d > 0.0).count() as f64;
            ranked.positive += mean_rank * n_positive;
            ranked.negative += mean_rank * (n - n_positive);
            ranked.ties += n * (n * n - 1.0);
            ranked.is_tied |= equal.len() > 1;
            ranked.ranks.extend(equal.iter().map(|_| mean_rank));
        }
        Some(ranked)
    }

    fn p_normal(&self) -> f64 {
        let n = self.ranks.len() as f64;
        let mean = 0.25 * n * (n + 1.0);
        let variance = (n * (n + 1.0) * (2.0 * n + 1.0) - 0.5 * self.ties) / 24.0;
        two_sided((self.positive - mean) / variance.sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_differences_are_counted_and_many_are_not() {
        let distinct: Vec<f64> = (1..=10).map(f64::from).collect();
        let found = wilcoxon(&distinct).unwrap();
        assert_eq!((found.n, found.statistic), (10, 0.0));
        // Two of 2^10 choices of signs are as one-sided.
        assert!((found.p - 2.0 / 1024.0).abs() < 1e-15, "{found:?}");
        assert_eq!(found.method, SignedRanks::Exact);
        let tied = wilcoxon(&[0.5; 14]).unwrap();
        assert_eq!(tied.method, SignedRanks::Normal);
        assert_eq!(Some(tied), wilcoxon_normal(&[0.5; 14]));
        assert_eq!(
            wilcoxon(&[0.5; 13]).map(|test| test.method),
            Some(SignedRanks::Exact)
        );
    }

    #[test]
    fn nothing_is_found_in_nothing() {
        assert_eq!(wilcoxon(&[]), None);
        assert_eq!(wilcoxon(&[0.0, 0.0]), None);
    }
}
