//! What a metric says about two sides.

use super::metric::{Better, Kind, METRICS, Metric, SUCCESS, Scope};
use super::pairs::{Pair, Pairs};
use crate::statistics::{bootstrap_median, holm, quantile, vargha_delaney_a, wilcoxon};
use formicar::numeric::Seed;
use serde::Serialize;
use std::collections::BTreeMap;

/// The level of the tests, over all metrics of a table.
const LEVEL: f64 = 0.05;

/// Measurements whose median ratio is within this of 1 show no difference: where code and data
/// come to lie in memory moves times by as much.
const NOISE: f64 = 0.01;

/// What is said of the second side beside the first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// It is better.
    Better,
    /// It is worse.
    Worse,
    /// The test shows no difference at the level 0.05.
    NoDifferenceShown,
    /// The sides cannot be compared.
    NotComparable,
}

impl Verdict {
    /// The verdict in words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Better => "better",
            Self::Worse => "worse",
            Self::NoDifferenceShown => "no difference shown",
            Self::NotComparable => "not comparable",
        }
    }
}

/// A metric of both sides.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// Its name.
    pub metric: &'static str,
    /// Pairs in which both sides have a value.
    pub n_pairs: usize,
    /// Pairs of equal values.
    pub n_equal: usize,
    /// The median of each side; of success the share.
    pub of_sides: Option<[f64; 2]>,
    /// The median of the ratios second over first, with its 95 % bootstrap interval around it.
    pub ratio: Option<[f64; 3]>,
    /// The probability of the signed-rank test, adjusted after Holm; none where all are equal.
    pub p: Option<f64>,
    /// Vargha & Delaney's A: how probable it is that the second side's value is above the first's,
    /// on one scenario, averaged over scenarios.
    pub above: Option<f64>,
    /// What it comes to.
    pub verdict: Verdict,
}

/// Findings of the metrics in question, the probabilities adjusted over them.
pub(super) fn findings(pairs: &Pairs, scope: Scope) -> Vec<Finding> {
    let is_like = pairs.unlike_measurements().is_none();
    let comparable = |metric: &Metric| is_like || metric.kind == Kind::Result;
    let metrics = METRICS.iter().filter(|metric| scope.holds(metric));
    let both: Vec<(&Metric, Values)> = metrics
        .map(|metric| (metric, Values::new(metric, &pairs.pairs)))
        .collect();
    let tested = both.iter().filter(|(metric, _)| comparable(metric));
    let raw: Vec<f64> = tested.filter_map(|(_, values)| values.p()).collect();
    let mut adjusted = holm(&raw).into_iter();
    let findings = both.iter().map(|(metric, values)| {
        let is_tested = comparable(metric) && values.p().is_some();
        let p = is_tested.then(|| adjusted.next()).flatten();
        let verdict = if comparable(metric) && !values.pairs.is_empty() {
            values.verdict(metric, p)
        } else {
            Verdict::NotComparable
        };
        values.finding(metric, p, verdict)
    });
    findings.collect()
}

/// The values of a metric, pair by pair, by scenario.
struct Values {
    pairs: Vec<[f64; 2]>,
    by_scenario: BTreeMap<[String; 3], [Vec<f64>; 2]>,
}

impl Values {
    fn new(metric: &Metric, pairs: &[Pair]) -> Self {
        let (mut both, mut by_scenario) = (Vec::new(), BTreeMap::<_, [Vec<f64>; 2]>::new());
        let counts = |pair: &&Pair| metric.kind == Kind::Measurement || !pair.repeats;
        for pair in pairs.iter().filter(counts) {
            let (Some(a), Some(b)) = (metric.of(pair.a), metric.of(pair.b)) else {
                continue;
            };
            both.push([a, b]);
            let place = ["scenario", "vehicle", "motion"].map(|c| pair.a.get(c).to_owned());
            let [of_a, of_b] = by_scenario.entry(place).or_default();
            of_a.push(a);
            of_b.push(b);
        }
        Self {
            pairs: both,
            by_scenario,
        }
    }

    fn differences(&self) -> Vec<f64> {
        self.pairs.iter().map(|[a, b]| b - a).collect()
    }

    fn p(&self) -> Option<f64> {
        wilcoxon(&self.differences()).map(|test| test.p)
    }

    /// The median of the ratios between the bounds of its interval.
    fn ratio(&self) -> Option<[f64; 3]> {
        let ratios = self.pairs.iter().filter(|[a, _]| *a > 0.0);
        let ratios: Vec<f64> = ratios.map(|[a, b]| b / a).collect();
        let [low, high] = bootstrap_median(&ratios, Seed(0))?;
        Some([low, quantile(&ratios, 0.5)?, high])
    }

    fn above(&self) -> Option<f64> {
        let weighted = self.by_scenario.values().filter_map(|[a, b]| {
            let above = vargha_delaney_a(b, a)?;
            Some(above * a.len() as f64)
        });
        let n = self.pairs.len();
        (n > 0).then(|| weighted.sum::<f64>() / n as f64)
    }

    fn verdict(&self, metric: &Metric, p: Option<f64>) -> Verdict {
        let lean = lean(&self.differences());
        let is_noise = metric.kind == Kind::Measurement
            && self
                .ratio()
                .is_none_or(|[_, mid, _]| (mid - 1.0).abs() < NOISE);
        if p.is_none_or(|p| p >= LEVEL) || is_noise || lean == 0.0 {
            return Verdict::NoDifferenceShown;
        }
        if (lean > 0.0) == (metric.better == Better::Higher) {
            Verdict::Better
        } else {
            Verdict::Worse
        }
    }

    fn of_sides(&self, metric: &Metric) -> Option<[f64; 2]> {
        let side = |i: usize| -> Option<f64> {
            let values: Vec<f64> = self.pairs.iter().map(|pair| pair[i]).collect();
            if metric.name == SUCCESS {
                let n = values.len();
                return (n > 0).then(|| values.iter().sum::<f64>() / n as f64);
            }
            quantile(&values, 0.5)
        };
        Some([side(0)?, side(1)?])
    }

    fn finding(&self, metric: &Metric, p: Option<f64>, verdict: Verdict) -> Finding {
        let is_success = metric.name == SUCCESS;
        Finding {
            metric: metric.name,
            n_pairs: self.pairs.len(),
            n_equal: self.pairs.iter().filter(|[a, b]| a == b).count(),
            of_sides: self.of_sides(metric),
            ratio: self.ratio().filter(|_| !is_success),
            p,
            above: self.above(),
            verdict,
        }
    }
}

/// The sum of the positive ranks minus that of the negative ones, as the signed-rank test counts
/// them: to which side the differences lean.
fn lean(differences: &[f64]) -> f64 {
    let mut sorted: Vec<f64> = differences.iter().copied().filter(|d| *d != 0.0).collect();
    sorted.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
    let (mut sum, mut rank) = (0.0, 0.0);
    for equal in sorted.chunk_by(|a, b| a.abs() == b.abs()) {
        let n = equal.len() as f64;
        sum += (rank + 0.5 * (n + 1.0)) * equal.iter().map(|d| d.signum()).sum::<f64>();
        rank += n;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_lean_to_the_greater_rank_sum() {
        // Ranks 1.5, 1.5 and 3: up 1.5, down 4.5.
        assert_eq!(lean(&[1.0, -1.0, 0.0, -2.0]), -3.0);
        assert_eq!(lean(&[0.0, 0.0]), 0.0);
        assert_eq!(lean(&[5.0]), 1.0);
    }
}
