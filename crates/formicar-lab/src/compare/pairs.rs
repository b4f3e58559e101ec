//! Runs of two sides on the same scenario, vehicle, motion mode and seed.

use super::not_run::{not_run, told_not_run};
use crate::campaign::Record;
use anyhow::{Result, bail};
use std::collections::{BTreeMap, BTreeSet};

/// Two runs of the same scenario with the same seed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair<'a> {
    pub(super) a: &'a Record,
    pub(super) b: &'a Record,
}

/// The pairs of two sides, in the order of the first.
#[derive(Clone, Debug, Default)]
pub(super) struct Pairs<'a> {
    pub(super) pairs: Vec<Pair<'a>>,
    /// Runs of the first and of the second side that the other has not.
    pub(super) n_alone: [usize; 2],
}

/// Scenario, vehicle, motion and seed. Tables that know no vehicle or motion have but one.
type Place<'a> = [&'a str; 4];

fn place(record: &Record) -> Place<'_> {
    ["scenario", "vehicle", "motion", "seed"].map(|column| record.get(column))
}

impl<'a> Pairs<'a> {
    /// Pairs of runs, each of one planner.
    ///
    /// # Errors
    /// Scenarios of one name whose maps or vehicles are not the same; sides without a pair.
    pub(super) fn new(a: &[&'a Record], b: &[&'a Record]) -> Result<Self> {
        let of_b: BTreeMap<Place, &Record> = b.iter().map(|r| (place(r), *r)).collect();
        let (mut pairs, mut met) = (Vec::new(), BTreeSet::new());
        for record in a.iter().filter(|record| met.insert(place(record))) {
            if let Some(other) = of_b.get(&place(record)) {
                check(record, other)?;
                pairs.push(Pair {
                    a: record,
                    b: other,
                });
            }
        }
        let n_alone = [met.len() - pairs.len(), of_b.len() - pairs.len()];
        Ok(Self { pairs, n_alone })
    }

    /// Why measurements of the sides do not compare; none where they do.
    pub(super) fn unlike_measurements(&self) -> Option<String> {
        for (column, what) in [
            ("machine", "machines"),
            ("build", "builds"),
            ("cold", "warm-up"),
        ] {
            let mut values = self
                .pairs
                .iter()
                .flat_map(|pair| [pair.a.get(column), pair.b.get(column)]);
            let first = values.next().unwrap_or_default();
            if let Some(other) = values.find(|value| *value != first) {
                return Some(format!(
                    "Times and memory are not comparable: {what} differ ({} and {}).",
                    named(first),
                    named(other)
                ));
            }
            if first.is_empty() && column == "machine" {
                return Some(
                    "Times and memory are not comparable: the machine is not known.".to_owned(),
                );
            }
        }
        None
    }

    /// Which runs of each side count for nothing, in words.
    pub(super) fn not_run(&self) -> Option<String> {
        let runs = |side: fn(&Pair<'a>) -> &'a Record| -> Vec<&Record> {
            self.pairs.iter().map(side).collect()
        };
        let of_sides = [
            ("first", runs(|pair| pair.a)),
            ("second", runs(|pair| pair.b)),
        ];
        let told = of_sides
            .iter()
            .filter_map(|(side, runs)| Some(format!("of the {side} side {}", told_not_run(runs)?)));
        let told: Vec<String> = told.collect();
        (!told.is_empty()).then(|| {
            format!(
                "Pairs with a run that did not take place are left out of rates and tests: {}.",
                told.join("; ")
            )
        })
    }

    /// Runs that one side alone solves, by what tells them apart; how the other side refused is
    /// told behind them. `solved` is whether each side does.
    pub(super) fn names(&self, solved: [bool; 2]) -> Vec<String> {
        let Some(first) = self.pairs.first().map(Pair::scenario) else {
            return Vec::new();
        };
        let varies = |i: usize| self.pairs.iter().any(|p| p.scenario()[i] != first[i]);
        let is_named = [true, varies(1), varies(2)];
        let wanted = |pair: &&Pair| [pair.a.row.is_solved(), pair.b.row.is_solved()] == solved;
        let name = |pair: &Pair| {
            let words = pair.scenario().into_iter().zip(is_named);
            let words: Vec<&str> = words.filter(|(_, named)| *named).map(|(w, _)| w).collect();
            let other = if solved[0] { pair.b } else { pair.a };
            let status = not_run(other).map_or(String::new(), |status| format!(" ({status})"));
            format!("{} seed {}{status}", words.join(" "), pair.a.get("seed"))
        };
        self.pairs.iter().filter(wanted).map(name).collect()
    }

    /// Other limits of the two sides, in words.
    pub(super) fn unlike_limits(&self) -> Option<String> {
        let differs = |column: &str| {
            let mut pairs = self.pairs.iter();
            pairs.any(|pair| pair.a.get(column) != pair.b.get(column))
        };
        let columns = ["budget_steps", "deadline_ms"];
        let unlike: Vec<&str> = columns.into_iter().filter(|c| differs(c)).collect();
        let names = unlike.join(" and ");
        (!unlike.is_empty()).then(|| format!("The sides ran under other limits: {names} differ."))
    }
}

impl<'a> Pair<'a> {
    /// Scenario, vehicle, motion.
    pub(super) fn scenario(&self) -> [&'a str; 3] {
        ["scenario", "vehicle", "motion"].map(|column| self.a.get(column))
    }
}

fn named(value: &str) -> &str {
    if value.is_empty() { "unknown" } else { value }
}

/// Refuses runs that only share the name of their scenario.
fn check(a: &Record, b: &Record) -> Result<()> {
    for (column, what) in [("map_hash", "maps"), ("vehicle_hash", "vehicles")] {
        let (of_a, of_b) = (a.get(column), b.get(column));
        if !of_a.is_empty() && !of_b.is_empty() && of_a != of_b {
            bail!(
                "scenario {:?}: the {what} of the two sides are not the same ({of_a} and {of_b})",
                a.get("scenario")
            );
        }
    }
    Ok(())
}
