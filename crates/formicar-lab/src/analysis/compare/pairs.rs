//! Runs of two sides on the same scenario, vehicle, motion mode and seed.

use super::not_run::{describe_not_run, not_run};
use crate::run::{Origin, Run};
use anyhow::{Result, bail};
use std::collections::{BTreeMap, BTreeSet};

/// Two runs of the same scenario with the same seed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair<'a> {
    pub(super) a: &'a Run,
    pub(super) b: &'a Run,
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

/// Scenario, vehicle and motion, and the seed. Tables without a vehicle or a motion have but one.
type Place<'a> = ([&'a str; 3], u64);

/// The text that tells vehicles apart.
type VehicleOf = fn(&Run) -> &str;

fn place(run: &Run, vehicle: VehicleOf) -> Place<'_> {
    let [scenario, _, motion] = run.place();
    ([scenario, vehicle(run), motion], run.record.seed)
}

fn name(run: &Run) -> &str {
    &run.origin.vehicle
}

/// Vehicles are told apart by what the judge sees of them, since one vehicle may go by two names;
/// or by name where that is not known of all runs.
fn vehicle_of(a: &[&Run], b: &[&Run]) -> VehicleOf {
    let mut runs = a.iter().chain(b);
    if runs.all(|run| !run.origin.vehicle_hash.is_empty()) {
        |run| &run.origin.vehicle_hash
    } else {
        name
    }
}

/// The first run of each place.
fn by_place<'a>(runs: &[&'a Run], vehicle: VehicleOf) -> BTreeMap<Place<'a>, &'a Run> {
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
    pub(super) fn new(a: &[&'a Run], b: &[&'a Run]) -> Result<Self> {
        let named = by_place(b, name);
        for record in a {
            let other = named.get(&place(record, name));
            other.map_or(Ok(()), |other| check(record, other))?;
        }
        let vehicle = vehicle_of(a, b);
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

    /// The reason why measurements of the sides do not compare; none where they do.
    pub(super) fn unlike_measurements(&self) -> Option<String> {
        let columns: [(TextOf, &str); 3] = [
            (|origin| &origin.machine, "machines"),
            (|origin| &origin.build, "builds"),
            (|origin| warm_up(origin.cold), "warm-up"),
        ];
        for (text, what) in columns {
            let pairs = self.all.iter();
            let mut values = pairs.flat_map(|pair| [text(&pair.a.origin), text(&pair.b.origin)]);
            let first = values.next().unwrap_or_default();
            if let Some(other) = values.find(|value| *value != first) {
                return Some(format!(
                    "Times and memory are not comparable: {what} differ ({} and {}).",
                    named(first),
                    named(other)
                ));
            }
            if first.is_empty() && what == "machines" {
                return Some(
                    "Times and memory are not comparable: the machine is not known.".to_owned(),
                );
            }
        }
        None
    }

    /// The runs of each side that did not take place, in words.
    pub(super) fn not_run(&self) -> Option<String> {
        let runs =
            |side: fn(&Pair<'a>) -> &'a Run| -> Vec<&Run> { self.all.iter().map(side).collect() };
        let of_sides = [
            ("first", runs(|pair| pair.a)),
            ("second", runs(|pair| pair.b)),
        ];
        let parts = of_sides.iter().filter_map(|(side, runs)| {
            Some(format!("of the {side} side {}", describe_not_run(runs)?))
        });
        let parts: Vec<String> = parts.collect();
        (!parts.is_empty()).then(|| {
            format!(
                "Pairs with a run that did not take place are left out of rates and tests: {}.",
                parts.join("; ")
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

    /// Runs that one side alone solves, named by what tells them apart, with the status where the
    /// other side did not run. `solved` says which side solves them.
    pub(super) fn names(&self, solved: [bool; 2]) -> Vec<String> {
        let Some(first) = self.all.first().map(Pair::scenario) else {
            return Vec::new();
        };
        let varies = |i: usize| self.all.iter().any(|p| p.scenario()[i] != first[i]);
        let is_named = [true, varies(1), varies(2)];
        let wanted =
            |pair: &&Pair| [pair.a.record.is_solved(), pair.b.record.is_solved()] == solved;
        let name = |pair: &Pair| {
            let words = pair.scenario().into_iter().zip(is_named);
            let words: Vec<&str> = words.filter(|(_, named)| *named).map(|(w, _)| w).collect();
            let other = if solved[0] { pair.b } else { pair.a };
            let status = not_run(other);
            let status = status.map_or(String::new(), |status| format!(" ({})", status.name()));
            format!("{} seed {}{status}", words.join(" "), pair.a.record.seed)
        };
        self.all.iter().filter(wanted).map(name).collect()
    }

    /// Other limits of the two sides, in words.
    pub(super) fn unlike_limits(&self) -> Option<String> {
        let differs = |is_other: fn(&Origin, &Origin) -> bool| {
            let mut pairs = self.all.iter();
            pairs.any(|pair| is_other(&pair.a.origin, &pair.b.origin))
        };
        let unlike = [
            (
                differs(|a, b| a.budget_steps != b.budget_steps),
                "budget_steps",
            ),
            (
                differs(|a, b| a.deadline_ms != b.deadline_ms),
                "deadline_ms",
            ),
        ];
        let unlike = unlike.iter().filter(|(is_other, _)| *is_other);
        let unlike: Vec<&str> = unlike.map(|(_, name)| *name).collect();
        let names = unlike.join(" and ");
        (!unlike.is_empty()).then(|| format!("The sides ran under other limits: {names} differ."))
    }
}

/// The pairs of two sides, as [`Pairs`] makes them.
///
/// # Errors
/// Scenarios of one name whose maps or vehicles are not the same.
pub(crate) fn paired<'a>(a: &[&'a Run], b: &[&'a Run]) -> Result<Vec<[&'a Run; 2]>> {
    let pairs = Pairs::new(a, b)?.all.into_iter();
    Ok(pairs.map(|pair| [pair.a, pair.b]).collect())
}

impl<'a> Pair<'a> {
    /// Scenario, vehicle, motion.
    pub(super) fn scenario(&self) -> [&'a str; 3] {
        self.a.place()
    }
}

/// A text of an origin.
type TextOf = fn(&Origin) -> &str;

fn warm_up(is_cold: Option<bool>) -> &'static str {
    match is_cold {
        Some(true) => "true",
        Some(false) => "false",
        None => "",
    }
}

fn named(value: &str) -> &str {
    if value.is_empty() { "unknown" } else { value }
}

/// Refuses runs that only share the name of their scenario.
fn check(a: &Run, b: &Run) -> Result<()> {
    let (origin_a, origin_b) = (&a.origin, &b.origin);
    for (of_a, of_b, what) in [
        (&origin_a.map_hash, &origin_b.map_hash, "maps"),
        (&origin_a.vehicle_hash, &origin_b.vehicle_hash, "vehicles"),
    ] {
        if !of_a.is_empty() && !of_b.is_empty() && of_a != of_b {
            bail!(
                "scenario {:?}: the {what} of the two sides are not the same ({of_a} and {of_b})",
                a.record.scenario
            );
        }
    }
    Ok(())
}
