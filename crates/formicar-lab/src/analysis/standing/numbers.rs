//! Runs by scenario.

pub(super) use crate::analysis::statistics::median;
use crate::analysis::statistics::quantile_or_forever;
use crate::run::RunRecord;
use std::collections::BTreeMap;

/// The runs of one planner.
pub(super) struct Runs<'a> {
    pub(super) planner: &'a str,
    pub(super) all: Vec<&'a RunRecord>,
    /// The runs of each scenario.
    pub(super) by_scenario: BTreeMap<&'a str, Vec<&'a RunRecord>>,
}

impl<'a> Runs<'a> {
    pub(super) fn new(runs: impl IntoIterator<Item = &'a RunRecord>) -> Self {
        let all: Vec<&RunRecord> = runs.into_iter().collect();
        let mut by_scenario: BTreeMap<&str, Vec<&RunRecord>> = BTreeMap::new();
        for run in &all {
            by_scenario.entry(&run.scenario).or_default().push(run);
        }
        Self {
            planner: all.first().map_or("", |run| &run.planner),
            all,
            by_scenario,
        }
    }

    /// The same runs, of some scenarios alone.
    pub(super) fn only(&self, is_wanted: impl Fn(&RunRecord) -> bool) -> Self {
        let runs = self.all.iter().copied().filter(|run| is_wanted(run));
        Self {
            planner: self.planner,
            ..Self::new(runs)
        }
    }

    /// The files or maps that the scenarios are of.
    pub(super) fn sources(&self) -> Vec<&'a str> {
        let mut sources: Vec<&str> = self.all.iter().map(|run| run.source.as_str()).collect();
        sources.sort_unstable();
        sources.dedup();
        sources
    }

    pub(super) fn n_solved(&self) -> usize {
        self.all.iter().filter(|run| run.is_solved()).count()
    }

    /// A value of every run that has it.
    pub(super) fn values(&self, of: impl Fn(&RunRecord) -> Option<f64>) -> Vec<f64> {
        self.all.iter().filter_map(|run| of(run)).collect()
    }

    /// Times to the first path of all runs; those without a path take forever.
    pub(super) fn first_s(&self) -> Vec<f64> {
        self.all.iter().map(|run| first_s(run)).collect()
    }

    /// The median over the seeds of a scenario, where a run without the value counts as infinite;
    /// none of a scenario that was not run.
    pub(super) fn median_of(
        &self,
        scenario: &str,
        of: impl Fn(&RunRecord) -> Option<f64>,
    ) -> Option<f64> {
        let runs = self.by_scenario.get(scenario)?;
        let values: Vec<f64> = runs
            .iter()
            .map(|run| of(run).unwrap_or(f64::INFINITY))
            .collect();
        median(&values)
    }
}

/// Time to the first certified path, or forever.
pub(super) fn first_s(run: &RunRecord) -> f64 {
    let first_s = run.first_feasible_s.filter(|_| run.is_solved());
    first_s.unwrap_or(f64::INFINITY)
}

/// The value that nine tenths do not exceed.
pub(super) fn p90(values: &[f64]) -> Option<f64> {
    quantile_or_forever(values, 0.9)
}

/// The largest value.
pub(super) fn largest(values: &[f64]) -> Option<f64> {
    values.iter().copied().max_by(f64::total_cmp)
}

/// The smallest value.
pub(super) fn smallest(values: &[f64]) -> Option<f64> {
    values.iter().copied().min_by(f64::total_cmp)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_with_values_that_take_forever() {
        let forever = f64::INFINITY;
        assert_eq!(median(&[1.0, 2.0, forever]), Some(2.0));
        assert_eq!(median(&[1.0, forever]), Some(forever));
        assert_eq!(median(&[forever, forever]), Some(forever));
        assert_eq!(p90(&[3.0]), Some(3.0));
        assert_eq!(median(&[]), None);
    }
}
