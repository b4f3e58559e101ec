//! Two sides beside each other, run by run: other versions, machines or planners on the same
//! scenarios with the same seeds.

mod finding;
mod metric;
mod not_run;
mod pairs;
mod tables;

pub use finding::{Finding, Verdict};
pub use metric::{Better, Kind, METRICS, Metric, SUCCESS, Scope};
pub use tables::METHOD;

pub(crate) use not_run::{describe_not_run, not_run};
pub(crate) use pairs::paired;

use crate::analysis::statistics::distinct;
use crate::run::Run;
use anyhow::{Result, bail};
use pairs::Pairs;
use serde::Serialize;

/// Runs under a name.
#[derive(Clone, Debug, Default)]
pub struct Side {
    /// The name in tables.
    pub name: String,
    /// Its runs, of one planner or several.
    pub runs: Vec<Run>,
}

/// A second side beside a first one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Comparison {
    /// The names of the sides.
    pub sides: [String; 2],
    /// Planner by planner.
    pub duels: Vec<Duel>,
}

/// A planner of the second side beside one of the first.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Duel {
    /// The two planners.
    pub planners: [String; 2],
    /// Runs that both have done.
    pub n_pairs: usize,
    /// Runs that only one has done.
    pub n_alone: [usize; 2],
    /// Remarks on the comparison.
    pub notes: Vec<String>,
    /// Runs that the first solves and the second does not: scenario, seed, vehicle and motion
    /// where there are several, and the status where the second did not run.
    pub lost: Vec<String>,
    /// Runs that the second solves and the first does not.
    pub gained: Vec<String>,
    /// The findings, metric by metric.
    pub findings: Vec<Finding>,
}

impl Comparison {
    /// Compares the planners that both sides have by name or, where each side has but one, those.
    ///
    /// # Errors
    /// Sides without a planner or a run in common; scenarios of one name that are not the same.
    pub fn new(a: &Side, b: &Side, scope: Scope) -> Result<Self> {
        let of_sides = [planners(&a.runs), planners(&b.runs)];
        let mut duels = Vec::new();
        for [of_a, of_b] in opponents(&of_sides) {
            let (of_a, of_b) = (runs_of(&a.runs, of_a), runs_of(&b.runs, of_b));
            duels.push(Duel::new(&of_a, &of_b, scope)?);
        }
        if duels.is_empty() {
            let [of_a, of_b] = of_sides.map(|names| names.join(", "));
            bail!(
                "no planner is in both: {} has {of_a}; {} has {of_b}",
                a.name,
                b.name
            );
        }
        if duels.iter().all(|duel| duel.n_pairs == 0) {
            bail!(
                "{} and {} have no run in common: no scenario with the same vehicle, motion mode \
                 and seed",
                a.name,
                b.name
            );
        }
        Ok(Self {
            sides: [a.name.clone(), b.name.clone()],
            duels,
        })
    }

    /// True if any metric is worse.
    pub fn is_worse(&self) -> bool {
        let mut findings = self.duels.iter().flat_map(|duel| &duel.findings);
        findings.any(|finding| finding.verdict == Verdict::Worse)
    }

    /// True if the first side solves a run that the second does not.
    pub fn has_lost(&self) -> bool {
        self.duels.iter().any(|duel| !duel.lost.is_empty())
    }
}

impl Duel {
    /// Compares runs of one planner each.
    ///
    /// # Errors
    /// Scenarios of one name that are not the same.
    pub fn new(a: &[&Run], b: &[&Run], scope: Scope) -> Result<Self> {
        let pairs = Pairs::new(a, b)?;
        let planner = |of: &[&Run]| {
            let first = of.first();
            first.map_or_else(String::new, |run| run.record.planner.clone())
        };
        let findings = finding::findings(&pairs, scope);
        let notes = [
            pairs.unlike_measurements().filter(|_| scope == Scope::All),
            pairs.unlike_limits(),
            pairs.repeats(),
            pairs.not_run(),
            finding::repeats(&findings),
        ];
        Ok(Self {
            planners: [planner(a), planner(b)],
            n_pairs: pairs.all.len(),
            n_alone: pairs.n_alone,
            lost: pairs.names([true, false]),
            gained: pairs.names([false, true]),
            findings,
            notes: notes.into_iter().flatten().collect(),
        })
    }
}

/// The planners of runs, in the order of their first.
pub(crate) fn planners(runs: &[Run]) -> Vec<&str> {
    distinct(runs.iter().map(|run| run.record.planner.as_str()))
}

/// The runs of a planner.
pub(crate) fn runs_of<'a>(runs: &'a [Run], planner: &str) -> Vec<&'a Run> {
    let runs = runs.iter();
    runs.filter(|run| run.record.planner == planner).collect()
}

fn opponents<'a>([a, b]: &[Vec<&'a str>; 2]) -> Vec<[&'a str; 2]> {
    if let ([only_a], [only_b]) = (&a[..], &b[..]) {
        return vec![[*only_a, *only_b]];
    }
    let both = a.iter().filter(|name| b.contains(name));
    both.map(|name| [*name; 2]).collect()
}

#[cfg(test)]
mod tests;
