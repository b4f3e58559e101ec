//! Verdicts on claims, from comparisons and counts.

use super::{Claim, Claims, Comparison, Counted, Evidence, Expected};
use crate::analysis::statistics::{
    bootstrap_median, holm, quantile, rank_balance, vargha_delaney_a, wilcoxon,
};
use crate::report::Verdict;
use formicar::numeric::Seed;

/// Probabilities from here on are chance.
const LEVEL: f64 = 0.05;
/// With fewer counted runs nothing is said.
const MIN_COUNTED: usize = 6;

/// The vote of a comparison or a count on its claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Vote {
    For,
    /// The opposite is as sure.
    Against,
    /// No difference was found.
    Open,
    /// There are too few runs to find one.
    TooFew,
}

/// A comparison with its numbers.
#[derive(Clone, Debug)]
pub struct Tested<'a> {
    pub(crate) comparison: &'a Comparison,
    /// Medians of the first and of the other.
    pub(crate) medians: Option<[f64; 2]>,
    /// Median difference with its 95 % interval.
    pub(crate) difference: Option<[f64; 3]>,
    pub(crate) p: Option<f64>,
    pub(crate) p_holm: Option<f64>,
    /// Probability that the first has the larger value.
    pub(crate) a: Option<f64>,
    pub(crate) vote: Vote,
}

/// A claim with its verdict.
#[derive(Clone, Debug)]
pub struct Judged<'a> {
    /// The claim.
    pub claim: &'a Claim,
    /// The verdict.
    pub verdict: Verdict,
    pub(crate) tests: Vec<Tested<'a>>,
    pub(crate) counts: Vec<(&'a Counted, Vote)>,
}

impl Claims {
    /// All claims with their verdicts; Holm's correction is over all comparisons.
    pub fn judged(&self) -> Vec<Judged<'_>> {
        let all = || self.0.iter().flat_map(comparisons);
        let p: Vec<Option<f64>> = all().map(p_of).collect();
        let corrected = holm(&p.iter().flatten().copied().collect::<Vec<_>>());
        let n_tests = corrected.len();
        let mut corrected = corrected.into_iter();
        let mut tested = all().zip(p).map(|(comparison, p)| {
            let p_holm = p.and_then(|_| corrected.next());
            Tested::new(comparison, [p, p_holm], n_tests)
        });
        let judge = |claim| {
            let n = comparisons(claim).count();
            let tests: Vec<Tested> = tested.by_ref().take(n).collect();
            Judged::new(claim, tests)
        };
        self.0.iter().map(judge).collect()
    }
}

fn comparisons(claim: &Claim) -> impl Iterator<Item = &Comparison> {
    let comparisons: &[Comparison] = match &claim.evidence {
        Evidence::Paired(comparisons) => comparisons,
        Evidence::Counted(_) => &[],
    };
    comparisons.iter()
}

fn counts(claim: &Claim) -> &[Counted] {
    match &claim.evidence {
        Evidence::Paired(_) => &[],
        Evidence::Counted(counts) => counts,
    }
}

/// The probability of what is corrected by Holm; `None` for comparisons without a signed-rank test.
fn p_of(comparison: &Comparison) -> Option<f64> {
    match comparison.expected {
        Expected::Same(_) => None,
        Expected::Less | Expected::More => wilcoxon(&comparison.differences()).map(|test| test.p),
    }
}

impl Comparison {
    /// First less other, pair by pair.
    pub(crate) fn differences(&self) -> Vec<f64> {
        self.pairs
            .iter()
            .map(|[first, other]| first - other)
            .collect()
    }

    fn values(&self, which: usize) -> Vec<f64> {
        self.pairs.iter().map(|pair| pair[which]).collect()
    }
}

impl<'a> Tested<'a> {
    fn new(comparison: &'a Comparison, [p, p_holm]: [Option<f64>; 2], n_tests: usize) -> Self {
        let [first, other] = [0, 1].map(|which| comparison.values(which));
        let medians = quantile(&first, 0.5).zip(quantile(&other, 0.5));
        let differences = comparison.differences();
        let vote = match comparison.expected {
            Expected::Same(share) => vote_of_sameness(comparison, share),
            expected => vote_of_test(&differences, p_holm, expected, n_tests),
        };
        Self {
            comparison,
            medians: medians.map(|(a, b)| [a, b]),
            difference: bootstrap_median(&differences, Seed(0))
                .zip(quantile(&differences, 0.5))
                .map(|([low, high], median)| [low, median, high]),
            p,
            p_holm,
            a: vargha_delaney_a(&first, &other),
            vote,
        }
    }
}

/// Tells if so many pairs could pass the test at all: with all differences on one side the exact
/// probability is 2^(1 - n), which Holm multiplies by up to the number of tests.
fn is_enough(n_pairs: usize, n_tests: usize) -> bool {
    let least = 0.5_f64.powi(n_pairs.min(1000) as i32 - 1);
    least * n_tests.max(1) as f64 <= LEVEL
}

fn vote_of_test(
    differences: &[f64],
    p_holm: Option<f64>,
    expected: Expected,
    n_tests: usize,
) -> Vote {
    if !is_enough(differences.len(), n_tests) {
        return Vote::TooFew;
    }
    if p_holm.is_none_or(|p| p >= LEVEL) {
        return Vote::Open;
    }
    let is_less = rank_balance(differences) < 0.0;
    if is_less == (expected == Expected::Less) {
        Vote::For
    } else {
        Vote::Against
    }
}

/// For where the 95 % interval of the median difference, over the other's value, lies within the
/// share; against where it lies beyond.
fn vote_of_sameness(comparison: &Comparison, share: f64) -> Vote {
    let relative = |[first, other]: &[f64; 2]| (first - other) / other.abs().max(f64::MIN_POSITIVE);
    let relative: Vec<f64> = comparison.pairs.iter().map(relative).collect();
    match bootstrap_median(&relative, Seed(0)) {
        _ if relative.len() < MIN_COUNTED => Vote::TooFew,
        Some([low, high]) if low >= -share && high <= share => Vote::For,
        Some([low, high]) if low > share || high < -share => Vote::Against,
        _ => Vote::Open,
    }
}

fn vote_of_count(count: &Counted) -> Vote {
    match count {
        count if count.of < MIN_COUNTED => Vote::TooFew,
        count if count.n == count.of => Vote::For,
        count if 2 * count.n > count.of => Vote::Open,
        _ => Vote::Against,
    }
}

impl<'a> Judged<'a> {
    fn new(claim: &'a Claim, tests: Vec<Tested<'a>>) -> Self {
        let counts: Vec<(&Counted, Vote)> = counts(claim)
            .iter()
            .map(|count| (count, vote_of_count(count)))
            .collect();
        let mut judged = Self {
            claim,
            verdict: Verdict::Undecided,
            tests,
            counts,
        };
        judged.verdict = judged.verdict();
        judged
    }

    fn votes(&self) -> impl Iterator<Item = Vote> + '_ {
        let tests = self.tests.iter().map(|test| test.vote);
        tests.chain(self.counts.iter().map(|count| count.1))
    }

    /// Votes for, against, and open.
    pub(crate) fn tally(&self) -> [usize; 3] {
        [Vote::For, Vote::Against, Vote::Open]
            .map(|kind| self.votes().filter(|vote| *vote == kind).count())
    }

    fn verdict(&self) -> Verdict {
        let n_told = self.votes().filter(|vote| *vote != Vote::TooFew).count();
        let n_for = self.tally()[0];
        // A count short of all runs but above half is a claim that holds in part.
        let is_mostly = self.counts.iter().any(|count| count.1 == Vote::Open);
        match (n_told, n_for) {
            (0, _) => Verdict::Undecided,
            (_, n_for) if n_for == self.votes().count() => Verdict::Holds,
            (_, 0) if !is_mostly => Verdict::Fails,
            _ => Verdict::InPart,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn comparison(differences: &[f64], expected: Expected) -> Comparison {
        Comparison {
            name: "a - b".to_owned(),
            quantity: "m".to_owned(),
            n_decimals: 1,
            pairs: differences.iter().map(|d| [10.0 + d, 10.0]).collect(),
            expected,
        }
    }

    fn less(by: f64) -> Comparison {
        let differences: Vec<f64> = (0..31).map(|i| -by - 0.01 * f64::from(i)).collect();
        comparison(&differences, Expected::Less)
    }

    /// As often above as below.
    fn noise() -> Comparison {
        let differences: Vec<f64> = (0..30)
            .map(|i| f64::from(i / 2 + 1) * if i % 2 == 0 { 0.1 } else { -0.1 })
            .collect();
        comparison(&differences, Expected::Less)
    }

    fn verdict(comparisons: Vec<Comparison>) -> Verdict {
        let claims = Claims(vec![Claim::new("less", "", "-", comparisons)]);
        let judged = claims.judged();
        judged[0].verdict
    }

    #[test]
    fn verdicts_follow_the_votes() {
        assert_eq!(verdict(vec![less(1.0), less(2.0)]), Verdict::Holds);
        assert_eq!(verdict(vec![less(1.0), noise()]), Verdict::InPart);
        assert_eq!(verdict(vec![noise()]), Verdict::Fails);
        // The opposite.
        assert_eq!(verdict(vec![less(-9.0)]), Verdict::Fails);
        // Three pairs can at best have a probability of one in four.
        assert_eq!(
            verdict(vec![comparison(&[-1.0, -2.0, -3.0], Expected::Less)]),
            Verdict::Undecided
        );
        // No difference at all is none of less.
        assert_eq!(
            verdict(vec![comparison(&[0.0; 31], Expected::Less)]),
            Verdict::Fails
        );
    }

    #[test]
    fn sameness_is_an_interval_within_a_share() {
        let same = |by: f64| verdict(vec![comparison(&[by; 31], Expected::Same(0.01))]);
        assert_eq!(same(0.05), Verdict::Holds);
        assert_eq!(same(0.2), Verdict::Fails);
    }

    #[test]
    fn counts_hold_where_all_do() {
        let verdict = |n: usize, of: usize| {
            let count = Counted {
                name: "arrived".to_owned(),
                n,
                of,
            };
            Claims(vec![Claim::new("all arrive", "", "-", vec![count])]).judged()[0].verdict
        };
        assert_eq!(verdict(31, 31), Verdict::Holds);
        assert_eq!(verdict(20, 31), Verdict::InPart);
        assert_eq!(verdict(10, 31), Verdict::Fails);
        assert_eq!(verdict(3, 3), Verdict::Undecided);
    }

    #[test]
    fn holm_counts_all_comparisons_of_the_page() {
        let claims = Claims(vec![
            Claim::new("one", "", "-", vec![less(1.0)]),
            Claim::new("two", "", "-", vec![less(1.0), noise()]),
        ]);
        let judged = claims.judged();
        let test = &judged[0].tests[0];
        let (p, p_holm) = (test.p.unwrap(), test.p_holm.unwrap());
        assert!((p - 2.0_f64.powi(-30)).abs() < 1e-15, "{p}");
        assert!((p_holm - 3.0 * p).abs() < 1e-15, "{p_holm}");
        assert_eq!(judged[1].tests.len(), 2);
        assert_eq!(judged[1].tally(), [1, 0, 1]);
    }
}
