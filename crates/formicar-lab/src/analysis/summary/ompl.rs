//! Runs of stores as logs of OMPL, which Planner Arena opens.

use super::report::{place, places};
use crate::analysis::compare::planners;
use crate::campaign::Record;
use crate::report::{OmplLog, OmplPlanner, OmplRun, Property, PropertyKind};

/// A property of a run: OMPL's own name where it has one, its type, our column.
const PROPERTIES: [(&str, PropertyKind, &str); 9] = [
    ("solved", PropertyKind::Boolean, "valid"),
    ("time", PropertyKind::Real, "query_s"),
    (
        "time to first solution",
        PropertyKind::Real,
        "first_feasible_s",
    ),
    ("memory", PropertyKind::Real, "peak_rss_bytes"),
    ("solution length", PropertyKind::Real, "length_m"),
    ("solution clearance", PropertyKind::Real, "min_clearance_m"),
    ("solution cost", PropertyKind::Real, "cost_m"),
    ("cusps", PropertyKind::Integer, "n_cusps"),
    ("steps", PropertyKind::Integer, "steps"),
];

/// OMPL counts memory in MB.
const BYTES_PER_MB: f64 = 1e6;

/// A log per scenario, vehicle and motion mode, in the order in which they ran.
pub fn ompl_logs(records: &[Record]) -> Vec<OmplLog> {
    let places = places(records).into_iter();
    places.map(|at| log(records, at)).collect()
}

fn log(records: &[Record], at: [&str; 3]) -> OmplLog {
    let here: Vec<&Record> = records.iter().filter(|r| place(r) == at).collect();
    let known = |column: &str| here.first().map_or("", |r| r.get(column)).to_owned();
    let words: Vec<&str> = at.into_iter().filter(|word| !word.is_empty()).collect();
    let property = |&(name, kind, _): &(&str, PropertyKind, &str)| Property::new(name, kind);
    let planner = |name: &str| OmplPlanner {
        name: name.to_owned(),
        settings: Vec::new(),
        runs: here
            .iter()
            .filter(|r| r.get("planner") == name)
            .map(|r| run(r))
            .collect(),
    };
    OmplLog {
        name: words.join("-"),
        version: known("version"),
        host: known("machine"),
        cpu: known("machine"),
        setup: format!(
            "{} of {}, map hash {}, vehicle hash {}",
            words.join(", "),
            known("source"),
            known("map_hash"),
            known("vehicle_hash")
        ),
        properties: PROPERTIES.iter().map(property).collect(),
        planners: planners(records)
            .into_iter()
            .map(planner)
            .filter(|p| !p.runs.is_empty())
            .collect(),
        ..OmplLog::default()
    }
}

fn run(record: &Record) -> OmplRun {
    let value = |&(name, kind, column): &(&str, PropertyKind, &str)| match (name, kind) {
        (_, PropertyKind::Boolean) => Some(f64::from(u8::from(record.row.is_solved()))),
        ("memory", _) => Some(record.row.number(column)? / BYTES_PER_MB),
        _ => record.row.number(column),
    };
    OmplRun {
        values: PROPERTIES.iter().map(value).collect(),
        progress: record
            .history
            .improvements
            .iter()
            .map(|i| [i.at_s, i.length_m])
            .collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::campaign::Improvement;
    use serde_json::json;

    #[test]
    fn a_log_holds_the_runs_of_a_scenario() {
        let record = |planner: &str, length_m: f64| {
            let mut record = Record::default();
            record.row.fill(&json!({
                "scenario": "s", "planner": planner, "seed": 0, "status": "found", "valid": true,
                "length_m": length_m, "query_s": 0.5, "peak_rss_bytes": 3e7,
            }));
            record.history.improvements = vec![Improvement {
                at_s: 0.25,
                steps: 7,
                length_m,
            }];
            record
        };
        let logs = ompl_logs(&[record("a", 3.0), record("b", 4.0)]);
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
