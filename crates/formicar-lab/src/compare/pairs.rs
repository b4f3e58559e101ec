//! Runs of two sides on the same scenario, vehicle, motion mode and seed.

use super::metric::{Kind, METRICS};
use crate::campaign::Record;
use anyhow::{Result, bail};
use std::collections::{BTreeMap, BTreeSet};

/// Two runs of the same scenario with the same seed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair<'a> {
    pub(super) a: &'a Record,
    pub(super) b: &'a Record,
    /// Whether another seed has given the same results before, where all seeds of a scenario do.
    pub(super) repeats: bool,
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
        let mut pairs = Vec::new();
        for record in a {
            if let Some(other) = of_b.get(&place(record)) {
                check(record, other)?;
                pairs.push(Pair {
                    a: record,
                    b: other,
                    repeats: false,
                });
            }
        }
        let n_alone = [a.len() - pairs.len(), of_b.len() - pairs.len()];
        mark_repeats(&mut pairs);
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

    /// On how many scenarios the seed changes nothing, in words.
    pub(super) fn repeats(&self) -> Option<String> {
        let repeats = self.pairs.iter().filter(|pair| pair.repeats);
        let scenarios: BTreeSet<_> = repeats.map(|pair| scenario(pair.a)).collect();
        (!scenarios.is_empty()).then(|| {
            format!(
                "On {} scenarios the seed changes nothing on either side: there one seed counts, \
                 but for times and memory.",
                scenarios.len()
            )
        })
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

/// Scenario, vehicle, motion.
fn scenario(record: &Record) -> [&str; 3] {
    ["scenario", "vehicle", "motion"].map(|column| record.get(column))
}

/// Runs that only repeat each other are no more evidence than one of them.
fn mark_repeats(pairs: &mut [Pair]) {
    let results = |pair: &Pair| -> Vec<[Option<f64>; 2]> {
        let metrics = METRICS.iter().filter(|metric| metric.kind == Kind::Result);
        metrics.map(|m| [m.of(pair.a), m.of(pair.b)]).collect()
    };
    let mut of_scenarios: BTreeMap<[&str; 3], Vec<usize>> = BTreeMap::new();
    for (i, pair) in pairs.iter().enumerate() {
        of_scenarios.entry(scenario(pair.a)).or_default().push(i);
    }
    for places in of_scenarios.into_values() {
        let first = results(&pairs[places[0]]);
        if places.iter().all(|&i| results(&pairs[i]) == first) {
            places.iter().skip(1).for_each(|&i| pairs[i].repeats = true);
        }
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
