//! Runs as sections of a report.

use super::goals;
use super::numbers::{Runs, first_s, median, p90};
use super::peers::Peer;
use super::rivals::Standing;
use crate::report::{Column, Field, Section, Table};
use crate::run::{RunRecord, RunStatus, number};

/// Goals of a planner, and whether they are met.
pub(super) fn goals(standing: &Standing, runs: &Runs) -> Section {
    let mut goals = goals::own(runs);
    goals.extend(standing.against_peers(runs));
    let n_met = goals.iter().filter(|goal| goal.is_met).count();
    let caption = format!(
        "Goals met: {n_met} of the {} that these runs can tell.",
        goals.len()
    );
    let table = goals::table(&goals).captioned(&caption);
    Section::of_table(&format!("Goals of `{}`", runs.planner), table)
}

/// Planners, or variants of one, beside the first of them.
pub(super) fn variants(of_planners: &[Runs]) -> Section {
    type Of = fn(&RunRecord) -> Option<f64>;
    let value = |runs: &Runs, of: Of| median(&runs.values(of));
    let ratio = |runs: &Runs, of: Of| {
        let ratio = |run: &RunRecord| {
            let same = of_planners[0].by_scenario.get(run.scenario.as_str())?;
            let same = same.iter().find(|other| other.seed == run.seed)?;
            Some(of(run)? / of(same)?)
        };
        Field::Number(median(&runs.values(ratio)), 4)
    };
    let columns: [Column<&Runs>; 12] = [
        ("planner", &|r| Field::words(r.planner)),
        ("solved", &|r| Field::Count(r.n_solved(), r.all.len())),
        ("first path ms", &|r| time(median(&r.first_s()))),
        ("p90", &|r| time(p90(&r.first_s()))),
        ("steps to it", &|r| {
            Field::Number(value(r, |run| number(run.first_steps)), 0)
        }),
        ("steps", &|r| {
            Field::Number(value(r, |run| number(run.steps)), 0)
        }),
        ("query ms", &|r| time(value(r, |run| run.query_s))),
        ("first length / first", &|r| {
            ratio(r, |run| run.first_length_m)
        }),
        ("length / first", &|r| ratio(r, |run| run.length_m)),
        ("cost / first", &|r| ratio(r, |run| run.cost_m)),
        ("clearance m", &|r| {
            Field::Number(value(r, |run| run.min_clearance_m), 3)
        }),
        ("cusps", &|r| Field::Number(mean_cusps(r), 2)),
    ];
    let table = Table::of("variants", of_planners, &columns).captioned(
        "Medians over all runs, of lengths and costs those of the ratios to the first planner's \
         run of the same scenario and seed; cusps are means.",
    );
    Section::of_table("Variants", table)
}

fn mean_cusps(runs: &Runs) -> Option<f64> {
    let cusps = runs.values(|run| number(run.n_cusps));
    (!cusps.is_empty()).then(|| cusps.iter().sum::<f64>() / cusps.len() as f64)
}

/// Every peer's row beside ours, a section for each file of scenarios; none without peers.
pub(super) fn beside_peers(standing: &Standing, of_planners: &[Runs]) -> Vec<Section> {
    let Some(first) = of_planners.first() else {
        return Vec::new();
    };
    let has_peers = |source: &&str| {
        let runs = first.only(|run| run.source == *source);
        let mut peers = standing.peers.iter();
        peers.any(|peer| runs.by_scenario.contains_key(peer.scenario.as_str()))
    };
    let sources = first.sources().into_iter().filter(has_peers);
    sources
        .map(|source| {
            let heading = [
                "who",
                "solved",
                "valid",
                "first path ms",
                "length at 0.1 s",
                "at 1 s",
                "cusps",
                "clearance m",
                "peak MB",
            ];
            let mut table = Table::new(&format!("peers {source}"), &heading)
                .captioned("Ours are medians over the seeds, with the most memory of any.");
            let scenarios = first.only(|run| run.source == source);
            for scenario in scenarios.by_scenario.keys() {
                for runs in of_planners {
                    table.row(our_row(scenario, runs));
                }
                let peers = standing.peers.iter().filter(|p| p.scenario == *scenario);
                for peer in peers {
                    table.row(peer_row(peer));
                }
            }
            Section::of_table(&format!("Beside peers: `{source}`"), table)
        })
        .collect()
}

fn our_row(scenario: &str, all: &Runs) -> Vec<Field> {
    let runs = all.only(|run| run.scenario == scenario);
    let value =
        |of: fn(&RunRecord) -> Option<f64>| all.median_of(scenario, of).filter(|v| v.is_finite());
    let peaks = runs.values(|run| number(run.peak_rss_bytes));
    let n = runs.all.len();
    vec![
        Field::Words(format!("{scenario} {}", all.planner)),
        Field::Count(
            runs.all
                .iter()
                .filter(|run| run.status == RunStatus::Found)
                .count(),
            n,
        ),
        Field::Count(runs.n_solved(), n),
        time(all.median_of(scenario, |run| Some(first_s(run)))),
        Field::Number(value(|run| run.length_by_tenth_m), 2),
        Field::Number(value(|run| run.length_by_second_m), 2),
        Field::Number(value(|run| number(run.n_cusps)), 1),
        Field::Number(value(|run| run.min_clearance_m), 3),
        Field::Number(
            peaks.into_iter().reduce(f64::max).map(|bytes| bytes / 1e6),
            1,
        ),
    ]
}

fn peer_row(peer: &Peer) -> Vec<Field> {
    let word = |is: Option<u8>| match is {
        Some(0) => "no",
        Some(_) => "yes",
        None => "-",
    };
    vec![
        Field::Words(format!("{} {}", peer.scenario, peer.peer)),
        Field::words(word(Some(peer.solved))),
        Field::words(word(peer.valid)),
        time(peer.first_s),
        Field::Number(None, 2),
        Field::Number(peer.length_1s_m, 2),
        Field::Number(peer.cusps, 1),
        Field::Number(peer.min_clearance_m, 3),
        Field::Number(peer.peak_mb, 1),
    ]
}

/// Every run of a planner.
pub(super) fn runs(runs: &Runs) -> Section {
    let megabytes = |bytes: Option<u64>| number(bytes).map(|bytes| bytes / 1e6);
    let columns: [Column<&&RunRecord>; 12] = [
        ("run", &|run| {
            Field::Words(format!("{} seed {}", run.scenario, run.seed))
        }),
        ("ended", &|run| Field::words(run.status.name())),
        ("first path ms", &|run| time(run.first_feasible_s)),
        ("query ms", &|run| time(run.query_s)),
        ("first length m", &|run| {
            Field::Number(run.first_length_m, 2)
        }),
        ("at 0.1 s", &|run| Field::Number(run.length_by_tenth_m, 2)),
        ("at 1 s", &|run| Field::Number(run.length_by_second_m, 2)),
        ("in the end", &|run| Field::Number(run.length_m, 2)),
        ("clearance m", &|run| Field::Number(run.min_clearance_m, 3)),
        ("cusps", &|run| Field::Number(number(run.n_cusps), 0)),
        ("steps", &|run| Field::Number(number(run.steps), 0)),
        ("peak MB", &|run| {
            Field::Number(megabytes(run.peak_rss_bytes), 1)
        }),
    ];
    let heading = format!("Every run of `{}`", runs.planner);
    Section::of_table(&heading, Table::of("runs", &runs.all, &columns))
}

/// Seconds in milliseconds; nothing where it takes forever.
fn time(seconds: Option<f64>) -> Field {
    Field::Number(seconds.filter(|s| s.is_finite()).map(goals::ms), 1)
}
