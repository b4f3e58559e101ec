//! Goals that runs meet or miss by themselves: certificates, times, memory, clearance.

use super::numbers::{Runs, largest, median, p90};
use crate::report::{Column, Field, Table};
use crate::run::{RunRecord, RunStatus, number};

/// Goals for maps of a size: columns and rows, map set-up (median), and the first path (median,
/// p90, largest), milliseconds.
const SIZES: [([u64; 2], f64, [f64; 3]); 3] = [
    ([800, 500], 1.5, [8.0, 35.0, 110.0]),
    ([2000, 2000], 15.0, [25.0, f64::INFINITY, f64::INFINITY]),
    ([5000, 5000], 100.0, [150.0, f64::INFINITY, f64::INFINITY]),
];
/// Limit for the first path of a new planner on 800 x 500 cells, milliseconds.
const COLD_MS: f64 = 60.0;
/// Limit for the judge on 100 m of path, milliseconds.
const JUDGE_MS: f64 = 1.0;
/// Memory that a process may use, megabytes.
const PEAK_MB: f64 = 32.0;
/// Clearance that paths keep where their ends allow it, meters.
const CLEARANCE_M: f64 = 0.25;

/// A goal, and what came of it.
pub(super) struct Goal {
    pub(super) what: String,
    pub(super) wanted: String,
    pub(super) reached: String,
    pub(super) is_met: bool,
}

impl Goal {
    pub(super) fn new(what: &str, wanted: &str, reached: String, is_met: bool) -> Self {
        Self {
            what: what.to_owned(),
            wanted: wanted.to_owned(),
            reached,
            is_met,
        }
    }
}

/// Goals as a table.
pub(super) fn table(goals: &[Goal]) -> Table {
    let columns: [Column<&Goal>; 4] = [
        ("goal", &|goal| Field::words(&goal.what)),
        ("wanted", &|goal| Field::words(&goal.wanted)),
        ("reached", &|goal| Field::words(&goal.reached)),
        ("met", &|goal| {
            Field::words(if goal.is_met { "yes" } else { "no" })
        }),
    ];
    Table::of("goals", goals, &columns)
}

/// Goals that need no peers.
pub(super) fn own(runs: &Runs) -> Vec<Goal> {
    let mut goals = vec![certified(runs)];
    goals.extend(SIZES.iter().flat_map(|&(size, setup_ms, first_ms)| {
        let runs = runs.only(|run| [run.n_cols, run.n_rows] == size.map(Some));
        of_size(&runs, size, setup_ms, first_ms)
    }));
    goals.extend(cold(
        &runs.only(|run| [run.n_cols, run.n_rows] == SIZES[0].0.map(Some)),
    ));
    goals.extend(
        [judge(runs), memory(runs), clearance(runs)]
            .into_iter()
            .flatten(),
    );
    goals
}

fn certified(runs: &Runs) -> Goal {
    let n_found = runs
        .all
        .iter()
        .filter(|run| run.status == RunStatus::Found)
        .count();
    let n_solved = runs.n_solved();
    let reached = format!("{n_solved} of {n_found}");
    Goal::new(
        "certified, of the paths returned",
        "all",
        reached,
        n_solved == n_found,
    )
}

fn of_size(
    runs: &Runs,
    [n_cols, n_rows]: [u64; 2],
    setup_ms: f64,
    first_ms: [f64; 3],
) -> Vec<Goal> {
    if runs.all.is_empty() {
        return Vec::new();
    }
    let mut goals = Vec::new();
    if let Some(median_ms) = median(&runs.values(|run| run.map_setup_s)).map(ms) {
        goals.push(Goal::new(
            &format!("map set-up, {n_cols} x {n_rows}"),
            &format!("median <= {setup_ms} ms"),
            format!("{median_ms:.2} ms"),
            median_ms <= setup_ms,
        ));
    }
    let first_s = runs.first_s();
    let reached = [median(&first_s), p90(&first_s), largest(&first_s)];
    let [Some(median_ms), Some(p90_ms), Some(largest_ms)] = reached.map(|s| s.map(ms)) else {
        return goals;
    };
    let wanted = ["median", "p90", "largest"].iter().zip(first_ms);
    let wanted = wanted.filter(|(_, limit)| limit.is_finite());
    let wanted: Vec<_> = wanted
        .map(|(name, limit)| format!("{name} <= {limit} ms"))
        .collect();
    let is_met = [median_ms, p90_ms, largest_ms]
        .iter()
        .zip(first_ms)
        .all(|(a, b)| *a <= b);
    goals.push(Goal::new(
        &format!("first certified path, {n_cols} x {n_rows}"),
        &wanted.join(", "),
        format!("{median_ms:.1} / {p90_ms:.1} / {largest_ms:.1} ms"),
        is_met,
    ));
    goals
}

fn cold(runs: &Runs) -> Option<Goal> {
    let times = runs
        .all
        .iter()
        .map(|run| run.cold_first_s.unwrap_or(f64::INFINITY));
    let times: Vec<f64> = times.collect();
    let (median_ms, largest_ms) = (ms(median(&times)?), ms(largest(&times)?));
    Some(Goal::new(
        "first certified path of a new planner, 800 x 500",
        &format!("median <= {COLD_MS} ms"),
        format!("{median_ms:.1} ms, largest {largest_ms:.1}"),
        median_ms <= COLD_MS,
    ))
}

fn judge(runs: &Runs) -> Option<Goal> {
    let per_100_m = runs.values(|run| Some(ms(run.judge_s?) * 100.0 / run.length_m?.max(1.0)));
    let (median_ms, largest_ms) = (median(&per_100_m)?, largest(&per_100_m)?);
    let reached = format!("{median_ms:.2} ms, largest {largest_ms:.2}");
    let is_met = median_ms <= JUDGE_MS;
    let wanted = format!("median <= {JUDGE_MS} ms");
    Some(Goal::new("judge, 100 m of path", &wanted, reached, is_met))
}

fn memory(runs: &Runs) -> Option<Goal> {
    let largest_mb = largest(&runs.values(|run| number(run.peak_rss_bytes)))? / 1e6;
    let (wanted, reached) = (format!("<= {PEAK_MB} MB"), format!("{largest_mb:.1} MB"));
    Some(Goal::new(
        "peak memory",
        &wanted,
        reached,
        largest_mb <= PEAK_MB,
    ))
}

fn clearance(runs: &Runs) -> Option<Goal> {
    let allowed = runs.only(|run| run.ends_clearance_m.is_some_and(|m| m >= CLEARANCE_M));
    let n_scenarios = allowed.by_scenario.len();
    // No path keeps no clearance.
    let of_scenario = |runs: &Vec<&RunRecord>| {
        let values = runs.iter().map(|run| run.min_clearance_m.unwrap_or(0.0));
        median(&values.collect::<Vec<_>>())
    };
    let medians: Vec<f64> = allowed
        .by_scenario
        .values()
        .filter_map(of_scenario)
        .collect();
    let median_m = median(&medians)?;
    Some(Goal::new(
        "clearance where start and goal allow it",
        &format!("median >= {CLEARANCE_M} m"),
        format!("{median_m:.3} m, of {n_scenarios} scenarios"),
        median_m >= CLEARANCE_M,
    ))
}

/// Seconds in milliseconds.
pub(super) fn ms(seconds: f64) -> f64 {
    1e3 * seconds
}
