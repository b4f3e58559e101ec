//! Runs of stores as a report: planners, each beside the first, and every scenario.
//!
//! A section is a function here; [`report()`] lists them.

use super::places::places;
use super::{anytime, charts, ratios};
use crate::analysis::compare::{
    Duel, METHOD, METRICS, Metric, SUCCESS, Scope, describe_not_run, not_run, paired, planners,
    runs_of,
};
use crate::analysis::statistics::quartiles;
use crate::report::{Field, Report, Section, Table};
use crate::run::Run;
use anyhow::Result;
use formicar::numeric::counted;

/// The report of runs under a name.
///
/// # Errors
/// Scenarios of one name whose maps or vehicles are not the same.
pub fn report(name: &str, runs: &[Run]) -> Result<Report> {
    let mut sections = vec![of_planners(runs)];
    sections.extend(ratios::ratios(runs));
    sections.extend(anytime::anytime(runs));
    sections.push(charts::spreads(runs));
    sections.extend(charts::convergence(runs));
    sections.extend(beside_the_first(runs)?);
    sections.push(of_scenarios(runs));
    Ok(Report {
        name: name_of(name),
        title: name.to_owned(),
        intro: intro(runs),
        sections,
    })
}

/// The prefix of names of numbers: the campaign's name if it has letters or digits.
fn name_of(name: &str) -> String {
    let is_word = name.contains(|c: char| c.is_ascii_alphanumeric());
    if is_word { name } else { "campaign" }.to_owned()
}

fn intro(runs: &[Run]) -> String {
    let n_planners = planners(runs).len();
    let method = if n_planners > 1 {
        format!(" Planners beside the first: {METHOD}")
    } else {
        String::new()
    };
    format!(
        "{} of {} on {}. Solved: a path with the judge's \
         certificate was returned. Metrics are those of solved runs, as median and quartiles.\
         {method}",
        counted(runs.len(), "run"),
        counted(n_planners, "planner"),
        counted(places(runs).len(), "scenario")
    )
}

/// Every planner with its rate of success, each metric, and the runs that did not take place.
fn of_planners(runs: &[Run]) -> Section {
    let names = planners(runs).into_iter();
    let runs: Vec<(&str, Vec<&Run>)> = names.map(|n| (n, runs_of(runs, n))).collect();
    let not_run_words = runs
        .iter()
        .filter_map(|(planner, runs)| Some(format!("`{planner}` {}", describe_not_run(runs)?)));
    let not_run_words: Vec<String> = not_run_words.collect();
    let mut caption =
        "Solved runs with the 95 % interval of the rate (Wilson); median [quartiles].".to_owned();
    let mut heading = vec!["planner", "solved"];
    if !not_run_words.is_empty() {
        heading.push("not run");
        caption += " Runs that did not take place are in no rate and no test: ";
        caption += &not_run_words.join("; ");
        caption += ".";
    }
    heading.extend(metrics().map(|metric| metric.name));
    let mut table = Table::new("planners", &heading).captioned(&caption);
    for (planner, runs) in &runs {
        let mut row = row_of(planner, runs, Field::Rate);
        if !not_run_words.is_empty() {
            let n = runs.iter().filter(|run| not_run(run).is_some()).count();
            row.insert(2, Field::Number(Some(n as f64), 0));
        }
        table.row(row);
    }
    Section::of_table("Planners", table)
}

/// Every other planner beside the first, paired by scenario and seed.
fn beside_the_first(runs: &[Run]) -> Result<Vec<Section>> {
    let names = planners(runs);
    let Some((first, others)) = names.split_first() else {
        return Ok(Vec::new());
    };
    let of_first = runs_of(runs, first);
    let sections = others.iter().map(|other| {
        let of_other = runs_of(runs, other);
        let duel = Duel::new(&of_first, &of_other, Scope::All)?;
        let mut section = duel.section([first, other]);
        section
            .blocks
            .extend(charts::differences(&paired(&of_first, &of_other)?));
        Ok(section)
    });
    sections.collect()
}

/// Every scenario with every planner.
fn of_scenarios(runs: &[Run]) -> Section {
    let mut heading = vec!["scenario", "solved"];
    heading.extend(metrics().map(|metric| metric.name));
    let mut table = Table::new("scenarios", &heading).captioned(
        "Over the seeds: median [quartiles]; a dash where no run took place or none is solved.",
    );
    let places = places(runs);
    let is_plain = |i: usize| places.iter().all(|p| p[i] == places[0][i]);
    let plain = [false, is_plain(1), is_plain(2)];
    for of_place in &places {
        for planner in planners(runs) {
            let runs = runs_of(runs, planner);
            let runs: Vec<&Run> = runs
                .into_iter()
                .filter(|r| r.place() == *of_place)
                .collect();
            if !runs.is_empty() {
                let words = of_place.iter().zip(plain).filter(|(_, is_plain)| !is_plain);
                let mut words: Vec<&str> = words.map(|(word, _)| *word).collect();
                words.push(planner);
                table.row(row_of(&words.join(" "), &runs, Field::Count));
            }
        }
    }
    Section::of_table("Scenarios", table)
}

/// All metrics but success.
fn metrics() -> impl Iterator<Item = &'static Metric> {
    METRICS.iter().filter(|metric| metric.name != SUCCESS)
}

fn row_of(name: &str, runs: &[&Run], solved: fn(usize, usize) -> Field) -> Vec<Field> {
    let n_solved = runs.iter().filter(|run| run.record.is_solved()).count();
    let n_run = runs.iter().filter(|run| not_run(run).is_none()).count();
    let solved = match n_run {
        0 => Field::Number(None, 0),
        _ => solved(n_solved, n_run),
    };
    let mut row = vec![Field::words(name), solved];
    row.extend(metrics().map(|metric| {
        let values: Vec<f64> = runs.iter().filter_map(|run| metric.of(run)).collect();
        Field::Spread(quartiles(&values), metric.n_decimals)
    }));
    row
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::markdown;
    use crate::run::RunStatus;
    use serde_json::json;

    fn run(scenario: &str, planner: &str, seed: u64, length_m: Option<f64>) -> Run {
        let mut run = Run::default();
        run.record
            .fill(&json!({
                "scenario": scenario, "planner": planner, "seed": seed, "length_m": length_m,
                "status": if length_m.is_some() { "found" } else { "no_path" },
                "valid": length_m.map(|_| true),
            }))
            .unwrap();
        run
    }

    #[test]
    fn planners_and_scenarios_have_a_row_each() {
        let runs: Vec<Run> = (0..3)
            .flat_map(|seed| {
                let x = seed as f64;
                [
                    run("s", "one", seed, Some(10.0 + x)),
                    run("s", "two", seed, (seed > 0).then_some(20.0 + x)),
                ]
            })
            .collect();
        let text = markdown(&report("a campaign", &runs).unwrap());
        assert!(
            text.contains("6 runs of 2 planners on 1 scenario."),
            "{text}"
        );
        assert!(text.contains("| one | 3/3 [44, 100] % | - | - | 11.000 [10.500, 11.500] |"));
        assert!(text.contains("## `two` beside `one`"), "{text}");
        let figures = [
            "Solved runs, length over the least",
            "Pairs of one scenario and seed",
        ];
        assert!(
            figures.iter().all(|caption| text.contains(caption)),
            "{text}"
        );
        assert!(text.contains("Solved by one alone: s seed 0."), "{text}");
        assert!(
            text.contains("| s two | 2/3 | - | - | 21.500 [21.250, 21.750] |"),
            "{text}"
        );
    }

    #[test]
    fn runs_that_did_not_take_place_are_told_and_in_no_rate() {
        let mut runs = vec![
            run("s", "one", 0, Some(10.0)),
            run("s", "two", 0, None),
            run("t", "two", 0, Some(9.0)),
            run("s", "three", 0, None),
        ];
        let refused = json!({"status": "invalid_request", "reason": "the vehicle is a point"});
        runs[1].record.fill(&refused).unwrap();
        runs[3].record.status = RunStatus::Unavailable;
        let text = markdown(&report("c", &runs).unwrap());
        for part in [
            "`two` 1 (invalid request: the vehicle is a point); `three` 1 (unavailable).",
            "| planner | solved | not run | first path ms |",
            "| one | 1/1 [21, 100] % | 0 |",
            "| two | 1/1 [21, 100] % | 1 |",
            "| three | - | 1 |",
            "| s two | - | - |",
            "| t two | 1/1 | - |",
        ] {
            assert!(text.contains(part), "no {part} in {text}");
        }
    }

    #[test]
    fn vehicles_are_named_where_there_are_several() {
        let mut runs = vec![run("s", "p", 0, Some(1.0)), run("s", "p", 0, Some(2.0))];
        runs[0].origin.vehicle = "own".to_owned();
        runs[1].origin.vehicle = "sedan".to_owned();
        let text = markdown(&report("c", &runs).unwrap());
        assert!(
            text.contains("| s own p |") && text.contains("| s sedan p |"),
            "{text}"
        );
    }
}
