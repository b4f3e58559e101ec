//! Runs of stores as logs of OMPL, which Planner Arena opens.

use super::places::places;
use crate::analysis::compare::planners;
use crate::report::{OmplLog, OmplPlanner, OmplRun, Property, PropertyKind};
use crate::run::{Run, RunRecord, number};

/// A property of a run: OMPL's own name where it has one, its type, and its value.
type RunProperty = (&'static str, PropertyKind, fn(&RunRecord) -> Option<f64>);

const PROPERTIES: [RunProperty; 9] = [
    ("solved", PropertyKind::Boolean, |run| {
        Some(f64::from(u8::from(run.is_solved())))
    }),
    ("time", PropertyKind::Real, |run| run.query_s),
    ("time to first solution", PropertyKind::Real, |run| {
        run.first_feasible_s
    }),
    ("memory", PropertyKind::Real, |run| {
        Some(number(run.peak_rss_bytes)? / BYTES_PER_MB)
    }),
    ("solution length", PropertyKind::Real, |run| run.length_m),
    ("solution clearance", PropertyKind::Real, |run| {
        run.min_clearance_m
    }),
    ("solution cost", PropertyKind::Real, |run| run.cost_m),
    ("cusps", PropertyKind::Integer, |run| number(run.n_cusps)),
    ("steps", PropertyKind::Integer, |run| number(run.steps)),
];

/// OMPL counts memory in MB.
const BYTES_PER_MB: f64 = 1e6;

/// A log per scenario, vehicle and motion mode, in the order in which they ran.
pub fn ompl_logs(runs: &[Run]) -> Vec<OmplLog> {
    let places = places(runs).into_iter();
    places.map(|at| log(runs, at)).collect()
}

fn log(runs: &[Run], at: [&str; 3]) -> OmplLog {
    let here: Vec<&Run> = runs.iter().filter(|run| run.place() == at).collect();
    let first = here.first().copied().cloned().unwrap_or_default();
    let (record, origin) = (first.record, first.origin);
    let words: Vec<&str> = at.into_iter().filter(|word| !word.is_empty()).collect();
    let property = |&(name, kind, _): &RunProperty| Property { name, kind };
    let planner = |name: &str| OmplPlanner {
        name: name.to_owned(),
        runs: here
            .iter()
            .filter(|run| run.record.planner == name)
            .map(|run| ompl_run(run))
            .collect(),
    };
    OmplLog {
        name: words.join("-"),
        version: origin.version,
        host: origin.machine.clone(),
        cpu: origin.machine,
        setup: format!(
            "{} of {}, map hash {}, vehicle hash {}",
            words.join(", "),
            record.source,
            origin.map_hash,
            origin.vehicle_hash
        ),
        properties: PROPERTIES.iter().map(property).collect(),
        planners: planners(runs)
            .into_iter()
            .map(planner)
            .filter(|p| !p.runs.is_empty())
            .collect(),
    }
}

fn ompl_run(run: &Run) -> OmplRun {
    let values = PROPERTIES.iter().map(|(_, _, value)| value(&run.record));
    let improvements = run.history.improvements.iter();
    OmplRun {
        values: values.collect(),
        progress: improvements.map(|i| [i.at_s, i.length_m]).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::Improvement;
    use serde_json::json;

    #[test]
    fn a_log_holds_the_runs_of_a_scenario() {
        let run = |planner: &str, length_m: f64| {
            let mut run = Run::default();
            run.record.fill(&json!({
                "scenario": "s", "planner": planner, "seed": 0, "status": "found", "valid": true,
                "length_m": length_m, "query_s": 0.5, "peak_rss_bytes": 3e7,
            })).unwrap();
            run.history.improvements = vec![Improvement {
                at_s: 0.25,
                steps: 7,
                length_m,
                ..Improvement::default()
            }];
            run
        };
        let logs = ompl_logs(&[run("a", 3.0), run("b", 4.0)]);
        assert_eq!(logs.len(), 1);
        let text = logs[0].to_text();
        assert!(
            text.contains("Experiment s\n") && text.contains("2 planners\n"),
            "{text}"
        );
        assert_eq!(logs[0].planners[1].runs[0].progress, [[0.25, 4.0]]);
        let values = &logs[0].planners[0].runs[0].values;
        assert_eq!(
            values[..5],
            [Some(1.0), Some(0.5), None, Some(30.0), Some(3.0)]
        );
    }
}
