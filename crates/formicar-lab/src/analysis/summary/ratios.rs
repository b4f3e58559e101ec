//! Planners beside the first one, scenario by scenario within one run: times, costs and lengths as
//! ratios.

use super::places::places;
use crate::analysis::compare::{planners, runs_of};
use crate::analysis::statistics::{distinct, median, quantile_or_forever};
use crate::report::{Block, Field, Section, Table};
use crate::run::{Run, RunRecord, RunStatus, number};
use std::collections::BTreeMap;

/// How much more of a path may be driven in reverse than of the first planner's, so that their
/// lengths are compared, meters.
const MORE_REVERSE_M: f64 = 2.0;

type Place<'a> = [&'a str; 3];
type Of = fn(&RunRecord) -> Option<f64>;

/// The runs of a planner by scenario.
struct Side<'a> {
    planner: &'a str,
    by_place: BTreeMap<Place<'a>, Vec<&'a RunRecord>>,
}

/// Tables for each motion mode of the runs; nothing where there is no planner beside the first.
pub(super) fn ratios(runs: &[Run]) -> Option<Section> {
    let motions = distinct(places(runs).into_iter().map(|[_, _, motion]| motion));
    let tables: Vec<Table> = motions
        .iter()
        .flat_map(|motion| of_motion(runs, motion))
        .collect();
    (!tables.is_empty()).then(|| {
        let blocks = tables.into_iter().map(Block::Table).collect();
        Section::new("Beside the first, scenario by scenario", blocks)
    })
}

fn of_motion(runs: &[Run], motion: &str) -> Vec<Table> {
    let sides: Vec<Side> = planners(runs)
        .into_iter()
        .map(|planner| Side::new(runs_of(runs, planner), planner, motion))
        .filter(|side| !side.by_place.is_empty())
        .collect();
    match sides.split_first() {
        Some((first, others)) if !others.is_empty() => vec![
            times(motion, first, others),
            costs(motion, first, others),
            lengths(motion, first, others),
        ],
        _ => Vec::new(),
    }
}

impl<'a> Side<'a> {
    fn new(runs: Vec<&'a Run>, planner: &'a str, motion: &str) -> Self {
        let mut by_place: BTreeMap<Place, Vec<&RunRecord>> = BTreeMap::new();
        for run in runs.into_iter().filter(|run| run.place()[2] == motion) {
            by_place.entry(run.place()).or_default().push(&run.record);
        }
        Self { planner, by_place }
    }

    fn records(&self) -> impl Iterator<Item = &RunRecord> {
        self.by_place.values().flatten().copied()
    }

    fn n(&self, is_it: impl Fn(&RunRecord) -> bool) -> usize {
        self.records().filter(|record| is_it(record)).count()
    }

    /// The median over the seeds of a scenario, where a run without a valid path takes forever.
    fn time(&self, place: &Place, of: Of) -> Option<f64> {
        let seeds = self.by_place.get(place)?.iter();
        let value = |record: &&RunRecord| of(record).filter(|_| record.is_solved());
        let values: Vec<f64> = seeds
            .map(|record| value(record).unwrap_or(f64::INFINITY))
            .collect();
        median(&values)
    }

    /// The median over those seeds of a scenario whose paths are valid and wanted.
    fn value(&self, place: &Place, of: Of, is_wanted: impl Fn(&RunRecord) -> bool) -> Option<f64> {
        let seeds = self.by_place.get(place)?.iter();
        let wanted = seeds.filter(|record| record.is_solved() && is_wanted(record));
        median(&wanted.filter_map(|record| of(record)).collect::<Vec<_>>())
    }

    /// All times of the scenarios, median over seeds.
    fn times(&self, of: Of) -> Vec<f64> {
        self.by_place
            .keys()
            .filter_map(|place| self.time(place, of))
            .collect()
    }

    /// The median over the scenarios of medians over valid seeds.
    fn typical(&self, of: Of) -> Option<f64> {
        let values = self
            .by_place
            .keys()
            .filter_map(|place| self.value(place, of, |_| true));
        median(&values.collect::<Vec<_>>())
    }

    fn mean(&self, of: Of) -> Option<f64> {
        let values: Vec<f64> = self
            .records()
            .filter(|r| r.is_solved())
            .filter_map(of)
            .collect();
        (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
    }
}

fn first_s(record: &RunRecord) -> Option<f64> {
    record.first_feasible_cpu_s.or(record.first_feasible_s)
}

fn cold_first_s(record: &RunRecord) -> Option<f64> {
    record
        .cold_first_cpu_s
        .or(record.cold_first_s)
        .or_else(|| first_s(record))
}

fn query_s(record: &RunRecord) -> Option<f64> {
    record.query_cpu_s.or(record.query_s)
}

fn setup_s(record: &RunRecord) -> Option<f64> {
    record.map_setup_cpu_s.or(record.map_setup_s)
}

/// Seconds in milliseconds; a dash for what takes forever.
fn ms(seconds: Option<f64>) -> Field {
    Field::Number(seconds.filter(|s| s.is_finite()).map(|s| 1e3 * s), 1)
}

/// The median, in parentheses the largest, in brackets on how many it is above 1.
fn spread(ratios: &[f64], n_decimals: usize) -> Field {
    let (Some(middle), Some(largest)) = (median(ratios), quantile_or_forever(ratios, 1.0)) else {
        return Field::Number(None, 0);
    };
    let n_above = ratios.iter().filter(|ratio| **ratio > 1.0).count();
    let text = |ratio: f64| match ratio {
        ratio if ratio.is_infinite() => "unsolved".to_owned(),
        ratio => format!("{ratio:.n_decimals$}"),
    };
    let n = ratios.len();
    Field::Words(format!(
        "{} ({}) [{n_above}/{n}]",
        text(middle),
        text(largest)
    ))
}

/// Set-up and times to the first path; the first planner's over the other's.
fn times(motion: &str, first: &Side, others: &[Side]) -> Table {
    let heading = [
        "planner",
        "found",
        "valid",
        "set-up ms",
        "first path ms",
        "p90",
        "largest",
        "query ms",
        "cold ratio",
        "by ms",
        "warm ratio",
        "by ms",
    ];
    let mut table = Table::new(&format!("times {motion}"), &heading).captioned(&format!(
        "{}: processor time where it is told, medians over seeds, then over scenarios; a run \
         without a valid path takes forever. Ratios: the first path of `{}`, cold (a planner that \
         has just been made) and warm, over the other's, on the scenarios that the other solves: \
         median (largest) [on how many `{}` is slower], and by how many milliseconds at most.",
        words(motion),
        first.planner,
        first.planner
    ));
    for (name, of) in [(" cold", cold_first_s as Of), ("", first_s as Of)] {
        let fields = vec![Field::Number(None, 0); 4];
        table.row(times_row(
            first,
            &format!("{}{name}", first.planner),
            of,
            fields,
        ));
    }
    for other in others {
        let beside = [cold_first_s as Of, first_s as Of].map(|of| beside(first, of, other));
        table.row(times_row(other, other.planner, first_s, beside.concat()));
    }
    table
}

/// The first planner's times over the other's, and by how much they are longer at most.
fn beside(first: &Side, of: Of, other: &Side) -> Vec<Field> {
    let pair = |place: &Place| {
        let theirs_s = other.time(place, first_s).filter(|s| s.is_finite())?;
        Some([first.time(place, of).unwrap_or(f64::INFINITY), theirs_s])
    };
    let pairs: Vec<[f64; 2]> = other.by_place.keys().filter_map(pair).collect();
    let ratios: Vec<f64> = pairs
        .iter()
        .map(|[ours_s, theirs_s]| ours_s / theirs_s)
        .collect();
    let excess = pairs.iter().map(|[ours_s, theirs_s]| ours_s - theirs_s);
    let most_s = excess.reduce(f64::max).filter(|s| *s > 0.0);
    vec![spread(&ratios, 2), ms(most_s)]
}

fn times_row(side: &Side, name: &str, of: Of, ratios: Vec<Field>) -> Vec<Field> {
    let times = side.times(of);
    let n = side.records().count();
    let mut row = vec![
        Field::words(name),
        Field::Count(side.n(|record| record.status == RunStatus::Found), n),
        Field::Count(side.n(RunRecord::is_solved), n),
        ms(median(
            &side.records().filter_map(setup_s).collect::<Vec<_>>(),
        )),
    ];
    row.extend([0.5, 0.9, 1.0].map(|p| ms(quantile_or_forever(&times, p))));
    row.push(ms(side.typical(query_s)));
    row.extend(ratios);
    row
}

/// The paths in the end, by the usual cost; the other's over the first planner's.
fn costs(motion: &str, first: &Side, others: &[Side]) -> Table {
    let heading = [
        "planner",
        "cost ratio",
        "least",
        "clearance m",
        "cusps",
        "reverse m",
        "largest MB",
    ];
    let mut table = Table::new(&format!("costs {motion}"), &heading).captioned(&format!(
        "{}: valid paths in the end. Cost by the usual weights over that of `{}`, on the scenarios \
         that both solve: median (largest) [on how many it is dearer], and the least. Clearance: \
         median; cusps and length in reverse: means.",
        words(motion),
        first.planner
    ));
    for side in std::iter::once(first).chain(others) {
        let ratio = |place: &Place| {
            let cost = |side: &Side| side.value(place, |record| record.cost_m, |_| true);
            Some(cost(side)? / cost(first)?)
        };
        let ratios: Vec<f64> = side.by_place.keys().filter_map(ratio).collect();
        let least = quantile_or_forever(&ratios, 0.0);
        let is_first = side.planner == first.planner;
        let largest = side
            .records()
            .filter_map(|record| number(record.peak_rss_bytes));
        table.row(vec![
            Field::words(side.planner),
            if is_first {
                Field::Number(None, 0)
            } else {
                spread(&ratios, 3)
            },
            Field::Number(least.filter(|_| !is_first), 3),
            Field::Number(side.typical(|record| record.min_clearance_m), 3),
            Field::Number(side.mean(|record| number(record.n_cusps)), 2),
            Field::Number(side.mean(|record| record.reverse_length_m), 1),
            Field::Number(largest.reduce(f64::max).map(|bytes| bytes / 1e6), 1),
        ]);
    }
    table
}

/// Lengths in the end: the first planner's over the other's.
fn lengths(motion: &str, first: &Side, others: &[Side]) -> Table {
    let heading = ["planner", "length ratio, all", "length ratio, alike"];
    let mut table = Table::new(&format!("lengths {motion}"), &heading).captioned(&format!(
        "{}: length of the path of `{}` over that of the other's valid path: median (largest) [on \
         how many `{}` is longer]. Alike: against paths that reverse at most {MORE_REVERSE_M} m \
         more; shortest: the shortest of the others on each scenario.",
        words(motion),
        first.planner,
        first.planner
    ));
    for other in others {
        let sides = std::slice::from_ref(other);
        table.row(lengths_row(other.planner, first, sides));
    }
    table.row(lengths_row("shortest", first, others));
    table
}

fn lengths_row(name: &str, first: &Side, others: &[Side]) -> Vec<Field> {
    let ratios = |more_reverse_m: f64| {
        let ratio = |place: &Place| {
            let ours_m = first.value(place, |record| record.length_m, |_| true)?;
            let reverse_m = first.value(place, |record| record.reverse_length_m, |_| true)?;
            let is_alike = |record: &RunRecord| {
                record
                    .reverse_length_m
                    .is_none_or(|m| m <= reverse_m + more_reverse_m)
            };
            let lengths = others.iter();
            let lengths =
                lengths.filter_map(|o| o.value(place, |record| record.length_m, is_alike));
            Some(ours_m / lengths.reduce(f64::min)?)
        };
        spread(
            &first.by_place.keys().filter_map(ratio).collect::<Vec<_>>(),
            3,
        )
    };
    vec![
        Field::words(name),
        ratios(f64::INFINITY),
        ratios(MORE_REVERSE_M),
    ]
}

/// A motion mode in words.
fn words(motion: &str) -> String {
    match motion {
        "forward" => "Forward only".to_owned(),
        "reverse" => "Reverse allowed".to_owned(),
        "" => "All runs".to_owned(),
        other => format!("Motion `{other}`"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{Report, markdown};
    use serde_json::{Value, json};

    fn run(planner: &str, scenario: &str, values: &Value) -> Run {
        let mut run = Run::default();
        let row =
            json!({"scenario": scenario, "planner": planner, "status": "found", "valid": true});
        run.record.fill(&row).unwrap();
        run.record.fill(values).unwrap();
        run.origin.motion = "reverse".to_owned();
        run
    }

    fn ours(scenario: &str, cold_s: f64, warm_s: f64) -> Run {
        run(
            "ours",
            scenario,
            &json!({
                "cold_first_cpu_s": cold_s, "first_feasible_cpu_s": warm_s, "first_feasible_s": 9.0,
                "length_m": 10.0, "cost_m": 10.0, "reverse_length_m": 0.0, "map_setup_cpu_s": 0.002,
            }),
        )
    }

    fn theirs(scenario: &str, first_s: f64, length_m: f64, reverse_m: f64) -> Run {
        run(
            "theirs",
            scenario,
            &json!({
                "first_feasible_cpu_s": first_s, "length_m": length_m, "cost_m": length_m + reverse_m,
                "reverse_length_m": reverse_m,
            }),
        )
    }

    fn text(runs: &[Run]) -> String {
        markdown(&Report {
            sections: ratios(runs).into_iter().collect(),
            ..Report::default()
        })
    }

    #[test]
    fn a_row_is_a_ratio_within_the_run() {
        let runs = [
            ours("s", 0.008, 0.002),
            ours("t", 0.030, 0.001),
            theirs("s", 0.010, 8.0, 6.0),
            theirs("t", 0.010, 20.0, 2.0),
        ];
        let text = text(&runs);
        for row in [
            "| ours cold | 2/2 | 2/2 | 2.0 | 19.0 | 27.8 | 30.0 | - | - | - | - | - |",
            "| theirs | 2/2 | 2/2 | - | 10.0 | 10.0 | 10.0 | - | 1.90 (3.00) [1/2] | 20.0 | 0.15 (0.20) [0/2] | - |",
            "| theirs | 1.800 (2.200) [2/2] | 1.400 | - | - | 4.0 | - |",
            // The one that reverses 6 m is shorter, but another question.
            "| theirs | 0.875 (1.250) [1/2] | 0.500 (0.500) [0/1] |",
            "| shortest | 0.875 (1.250) [1/2] | 0.500 (0.500) [0/1] |",
        ] {
            assert!(text.contains(row), "no {row} in {text}");
        }
    }

    #[test]
    fn unsolved_scenarios_count_against_whoever_does_not_solve_them() {
        let mut failed = ours("t", 0.001, 0.001);
        failed.record.valid = Some(false);
        let mut refused = theirs("u", 0.001, 1.0, 0.0);
        refused.record.status = RunStatus::Refused;
        let runs = [
            ours("s", 0.005, 0.005),
            failed,
            ours("u", 0.005, 0.005),
            theirs("s", 0.010, 8.0, 0.0),
            theirs("t", 0.010, 8.0, 0.0),
            refused,
        ];
        let text = text(&runs);
        let row = "| theirs | 2/3 | 2/3 | - | 10.0 | - | - | - | unsolved (unsolved) [1/2] |";
        assert!(text.contains(row), "no {row} in {text}");
        assert!(
            text.contains("| shortest | 1.250 (1.250) [1/1] |"),
            "{text}"
        );
    }

    #[test]
    fn one_planner_has_nothing_beside_it() {
        assert_eq!(ratios(&[ours("s", 1.0, 1.0)]), None);
    }
}
