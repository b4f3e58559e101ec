//! Runs as logs of OMPL.

use crate::papers::trial::Run;
use crate::papers::trials::Measure;
use crate::report::{OmplLog, OmplPlanner, OmplRun, Property, PropertyKind};

/// A property of a run and its value; OMPL's own names where it has one.
const PROPERTIES: [(&str, PropertyKind, Measure); 8] = [
    ("solved", PropertyKind::Boolean, |trial| {
        Some(f64::from(u8::from(trial.certified)))
    }),
    ("time", PropertyKind::Real, |trial| {
        Some(1e-3 * trial.query_ms)
    }),
    ("solution length", PropertyKind::Real, |trial| {
        trial.length_m
    }),
    ("solution clearance", PropertyKind::Real, |trial| {
        trial.min_clearance_m
    }),
    ("search time", PropertyKind::Real, |trial| {
        Some(1e-3 * trial.search_ms)
    }),
    ("grid length", PropertyKind::Real, |trial| {
        trial.length_cells
    }),
    ("iterations", PropertyKind::Integer, |trial| {
        Some(trial.n_iterations as f64)
    }),
    ("turns", PropertyKind::Integer, |trial| {
        Some(trial.n_turns? as f64)
    }),
];

/// A log per map, maps and variants in the order in which they ran.
pub(crate) fn ompl_logs(runs: &[Run]) -> Vec<OmplLog> {
    let of_map = runs.chunk_by(|a, b| a.trial.map == b.trial.map);
    let log = |runs: &[Run]| OmplLog {
        name: runs[0].trial.map.clone(),
        setup: format!("Built-in map {} with its first request", runs[0].trial.map),
        properties: PROPERTIES
            .iter()
            .map(|&(name, kind, _)| Property { name, kind })
            .collect(),
        planners: runs
            .chunk_by(|a, b| a.trial.variant == b.trial.variant)
            .map(planner)
            .collect(),
        ..OmplLog::default()
    };
    of_map.map(log).collect()
}

fn planner(runs: &[Run]) -> OmplPlanner {
    let run = |run: &Run| {
        let progress = run.moments.iter();
        let progress = progress.filter_map(|moment| {
            let length = moment.best_so_far_length?;
            Some([1e-3 * moment.ms, length])
        });
        OmplRun {
            values: PROPERTIES.iter().map(|(.., of)| of(&run.trial)).collect(),
            progress: progress.collect(),
        }
    };
    OmplPlanner {
        name: runs[0].trial.variant.clone(),
        runs: runs.iter().map(run).collect(),
    }
}
