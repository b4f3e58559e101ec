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
    pub(super) all: Vec<Pair<'a>>,
    /// Runs of the first and of the second side that the other has not.
    pub(super) n_alone: [usize; 2],
    /// Runs of each side that repeat another one of theirs, under another name of the vehicle.
    n_repeats: [usize; 2],
}

/// Scenario, vehicle, motion and seed. Tables that know no vehicle or motion have but one.
type Place<'a> = [&'a str; 4];

fn place<'a>(record: &'a Record, vehicle: &str) -> Place<'a> {
    ["scenario", vehicle, "motion", "seed"].map(|column| record.get(column))
}

/// By which column vehicles are told apart: by what the judge sees of them, since one vehicle may
/// go by two names, or by name where that is not known of all runs.
fn vehicle_column(a: &[&Record], b: &[&Record]) -> &'static str {
    let mut runs = a.iter().chain(b);
    if runs.all(|run| !run.get("vehicle_hash").is_empty()) {
        "vehicle_hash"
    } else {
        "vehicle"
    }
}

/// The first run of each place.
fn by_place<'a>(runs: &[&'a Record], vehicle: &str) -> BTreeMap<Place<'a>, &'a Record> {
    let mut by_place = BTreeMap::new();
    for run in runs {
        by_place.entry(place(run, vehicle)).or_insert(*run);
    }
    by_place
}

impl<'a> Pairs<'a> {
    /// Pairs of runs, each of one planner.
    ///
    /// # Errors
    /// Scenarios of one name whose maps or vehicles are not the same; sides without a pair.
    pub(super) fn new(a: &[&'a Record], b: &[&'a Record]) -> Result<Self> {
        let named = by_place(b, "vehicle");
        for record in a {
            let other = named.get(&place(record, "vehicle"));
            other.map_or(Ok(()), |other| check(record, other))?;
        }
        let vehicle = vehicle_column(a, b);
        let of_b = by_place(b, vehicle);
        let (mut pairs, mut met) = (Vec::new(), BTreeSet::new());
        for record in a.iter().filter(|run| met.insert(place(run, vehicle))) {
            if let Some(other) = of_b.get(&place(record, vehicle)) {
                check(record, other)?;
                pairs.push(Pair {
                    a: record,
                    b: other,
                });
            }
        }
        Ok(Self {
            n_alone: [met.len() - pairs.len(), of_b.len() - pairs.len()],
            n_repeats: [a.len() - met.len(), b.len() - of_b.len()],
            all: pairs,
        })
    }

    /// Why measurements of the sides do not compare; none where they do.
    pub(super) fn unlike_measurements(&self) -> Option<String> {
        for (column, what) in [
            ("machine", "machines"),
            ("build", "builds"),
            ("cold", "warm-up"),
        ] {
            let mut values = self
                .all
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
            self.all.iter().map(side).collect()
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

    /// Runs that are left out since they repeat others, in words.
    pub(super) fn repeats(&self) -> Option<String> {
        let [a, b] = self.n_repeats;
        (a + b > 0).then(|| {
            format!(
                "Runs of one scenario, motion mode and seed with the same vehicle under two names \
                 (the same footprint and tightest turn) count once: {a} of the first side and {b} \
                 of the second are left out."
            )
        })
    }

    /// Runs that one side alone solves, by what tells them apart; how the other side refused is
    /// told behind them. `solved` is whether each side does.
    pub(super) fn names(&self, solved: [bool; 2]) -> Vec<String> {
        let Some(first) = self.all.first().map(Pair::scenario) else {
            return Vec::new();
        };
        let varies = |i: usize| self.all.iter().any(|p| p.scenario()[i] != first[i]);
        let is_named = [true, varies(1), varies(2)];
        let wanted = |pair: &&Pair| [pair.a.row.is_solved(), pair.b.row.is_solved()] == solved;
        let name = |pair: &Pair| {
            let words = pair.scenario().into_iter().zip(is_named);
            let words: Vec<&str> = words.filter(|(_, named)| *named).map(|(w, _)| w).collect();
            let other = if solved[0] { pair.b } else { pair.a };
            let status = not_run(other).map_or(String::new(), |status| format!(" ({status})"));
            format!("{} seed {}{status}", words.join(" "), pair.a.get("seed"))
        };
        self.all.iter().filter(wanted).map(name).collect()
    }

    /// Other limits of the two sides, in words.
    pub(super) fn unlike_limits(&self) -> Option<String> {
        let differs = |column: &str| {
            let mut pairs = self.all.iter();
            pairs.any(|pair| pair.a.get(column) != pair.b.get(column))
        };
        let columns = ["budget_steps", "deadline_ms"];
        let unlike: Vec<&str> = columns.into_iter().filter(|c| differs(c)).collect();
        let names = unlike.join(" and ");
        (!unlike.is_empty()).then(|| format!("The sides ran under other limits: {names} differ."))
    }
}

/// The pairs of two sides, as [`Pairs`] makes them.
///
/// # Errors
/// Scenarios of one name whose maps or vehicles are not the same.
pub(crate) fn paired<'a>(a: &[&'a Record], b: &[&'a Record]) -> Result<Vec<[&'a Record; 2]>> {
    let pairs = Pairs::new(a, b)?.all.into_iter();
    Ok(pairs.map(|pair| [pair.a, pair.b]).collect())
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
