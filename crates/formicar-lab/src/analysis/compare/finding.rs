//! The finding of a metric on two sides.

use super::metric::{Better, Kind, METRICS, Metric, SUCCESS, Scope};
use super::pairs::{Pair, Pairs};
use crate::analysis::statistics::{
    bootstrap_median, holm, quantile, rank_balance, vargha_delaney_a, wilcoxon,
};
use formicar::numeric::Seed;
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};

/// The level of the tests, over all metrics of a table.
const LEVEL: f64 = 0.05;

/// Measurements whose median ratio is within this of 1 show no difference: where code and data
/// come to lie in memory moves times by as much.
const NOISE: f64 = 0.01;

/// The verdict on the second side beside the first.
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
    /// Pairs in which both sides have a value. Where all seeds of a scenario give the same result
    /// one of them counts.
    pub n_pairs: usize,
    /// The same with all seeds.
    pub n_all_pairs: usize,
    /// Scenarios of which one of several seeds counts.
    pub n_still: usize,
    /// Pairs of equal values.
    pub n_equal: usize,
    /// The median of each side; of success the share over all seeds.
    pub of_sides: Option<[f64; 2]>,
    /// The median of the ratios second over first, with its 95 % bootstrap interval around it.
    pub ratio: Option<[f64; 3]>,
    /// The probability of the signed-rank test, adjusted after Holm; none where all are equal.
    pub p: Option<f64>,
    /// Vargha & Delaney's A: how probable it is that the second side's value is above the first's,
    /// on one scenario, averaged over scenarios.
    pub above: Option<f64>,
    /// The verdict.
    pub verdict: Verdict,
}

/// Findings of the metrics in question, the probabilities adjusted over them.
pub(super) fn findings(pairs: &Pairs, scope: Scope) -> Vec<Finding> {
    let is_like = pairs.unlike_measurements().is_none();
    let comparable = |metric: &Metric| is_like || metric.kind == Kind::Result;
    let metrics = METRICS.iter().filter(|metric| scope.holds(metric));
    let both: Vec<(&Metric, Values)> = metrics
        .map(|metric| (metric, Values::new(metric, &pairs.all)))
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

/// The results of which one of several seeds counts, in words; none where there are none.
pub(super) fn repeats(findings: &[Finding]) -> Option<String> {
    let still = findings.iter().filter(|finding| finding.n_still > 0);
    let still: Vec<String> = still
        .map(|f| format!("{} on {}", f.metric, f.n_still))
        .collect();
    (!still.is_empty()).then(|| {
        format!(
            "Where the seed does not change a result on either side, one seed of the scenario \
             counts in the tests. Scenarios of which that is so: {}.",
            still.join(", ")
        )
    })
}

/// The values of a metric, pair by pair, by scenario.
struct Values<'a> {
    /// The pairs that count.
    pairs: Vec<[f64; 2]>,
    /// All pairs.
    by_scenario: BTreeMap<[&'a str; 3], Vec<[f64; 2]>>,
    /// Scenarios of which one of several pairs counts.
    n_still: usize,
}

impl<'a> Values<'a> {
    fn new(metric: &Metric, pairs: &[Pair<'a>]) -> Self {
        let both = |pair: &Pair| Some([metric.of(pair.a)?, metric.of(pair.b)?]);
        let all = pairs
            .iter()
            .filter_map(|pair| Some((pair.scenario(), both(pair)?)));
        let all: Vec<([&str; 3], [f64; 2])> = all.collect();
        let mut by_scenario = BTreeMap::<_, Vec<_>>::new();
        for (scenario, values) in &all {
            by_scenario.entry(*scenario).or_default().push(*values);
        }
        // Runs that only repeat each other are no more evidence than one of them.
        let repeats =
            |values: &[[f64; 2]]| values.len() > 1 && values.iter().all(|v| *v == values[0]);
        let still = by_scenario
            .iter()
            .filter(|(_, values)| metric.kind == Kind::Result && repeats(values));
        let still: BTreeSet<[&str; 3]> = still.map(|(scenario, _)| *scenario).collect();
        let mut met = BTreeSet::new();
        let counted = all
            .iter()
            .filter(|(at, _)| !still.contains(at) || met.insert(*at));
        Self {
            pairs: counted.map(|(_, values)| *values).collect(),
            n_still: still.len(),
            by_scenario,
        }
    }

    /// All pairs, those too that repeat others.
    fn all(&self) -> impl Iterator<Item = &[f64; 2]> {
        self.by_scenario.values().flatten()
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
        let weighted = self.by_scenario.values().filter_map(|pairs| {
            let side = |i: usize| pairs.iter().map(|pair| pair[i]).collect::<Vec<f64>>();
            Some(vargha_delaney_a(&side(1), &side(0))? * pairs.len() as f64)
        });
        let n = self.all().count();
        (n > 0).then(|| weighted.sum::<f64>() / n as f64)
    }

    fn verdict(&self, metric: &Metric, p: Option<f64>) -> Verdict {
        let lean = rank_balance(&self.differences());
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
            if metric.name == SUCCESS {
                let n = self.all().count();
                return (n > 0).then(|| self.all().map(|pair| pair[i]).sum::<f64>() / n as f64);
            }
            let values: Vec<f64> = self.pairs.iter().map(|pair| pair[i]).collect();
            quantile(&values, 0.5)
        };
        Some([side(0)?, side(1)?])
    }

    fn finding(&self, metric: &Metric, p: Option<f64>, verdict: Verdict) -> Finding {
        let is_success = metric.name == SUCCESS;
        Finding {
            metric: metric.name,
            n_pairs: self.pairs.len(),
            n_all_pairs: self.all().count(),
            n_still: self.n_still,
            n_equal: self.pairs.iter().filter(|[a, b]| a == b).count(),
            of_sides: self.of_sides(metric),
            ratio: self.ratio().filter(|_| !is_success),
            p,
            above: self.above(),
            verdict,
        }
    }
}
