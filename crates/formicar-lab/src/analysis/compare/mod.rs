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

pub(crate) use not_run::{not_run, told_not_run};
pub(crate) use pairs::paired;

use crate::campaign::Record;
use anyhow::{Result, bail};
use pairs::Pairs;
use serde::Serialize;

/// Runs under a name.
#[derive(Clone, Debug, Default)]
pub struct Side {
    /// What it goes by in tables.
    pub name: String,
    /// Its runs, of one planner or several.
    pub records: Vec<Record>,
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
    /// What is to be known about the comparison.
    pub notes: Vec<String>,
    /// Runs that the first solves and the second does not: scenario, seed, vehicle and motion
    /// where there are several, and the status where the second did not run.
    pub lost: Vec<String>,
    /// Runs that the second solves and the first does not.
    pub gained: Vec<String>,
    /// What each metric says.
    pub findings: Vec<Finding>,
}

impl Comparison {
    /// Compares the planners that both sides have by name or, where each side has but one, those.
    ///
    /// # Errors
    /// Sides without a planner or a run in common; scenarios of one name that are not the same.
    pub fn new(a: &Side, b: &Side, scope: Scope) -> Result<Self> {
        let of_sides = [planners(&a.records), planners(&b.records)];
        let mut duels = Vec::new();
        for [of_a, of_b] in opponents(&of_sides) {
            let (of_a, of_b) = (runs_of(&a.records, of_a), runs_of(&b.records, of_b));
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

    /// Whether any metric is worse.
    pub fn is_worse(&self) -> bool {
        let mut findings = self.duels.iter().flat_map(|duel| &duel.findings);
        findings.any(|finding| finding.verdict == Verdict::Worse)
    }

    /// Whether any run that the first side solves is not solved by the second.
    pub fn has_lost(&self) -> bool {
        self.duels.iter().any(|duel| !duel.lost.is_empty())
    }
}

impl Duel {
    /// Of runs of one planner each.
    ///
    /// # Errors
    /// Scenarios of one name that are not the same.
    pub fn new(a: &[&Record], b: &[&Record], scope: Scope) -> Result<Self> {
        let pairs = Pairs::new(a, b)?;
        let planner = |of: &[&Record]| of.first().map_or("", |r| r.get("planner")).to_owned();
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
pub(crate) fn planners(records: &[Record]) -> Vec<&str> {
    let mut names = Vec::new();
    for record in records {
        let name = record.get("planner");
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
}

/// The runs of a planner.
pub(crate) fn runs_of<'a>(records: &'a [Record], planner: &str) -> Vec<&'a Record> {
    let records = records.iter();
    records.filter(|r| r.get("planner") == planner).collect()
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
