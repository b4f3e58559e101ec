//! What is kept of a run: its row, where it comes from, its history and its path.

use super::job::Job;
use super::plan::PlannedRun;
use super::row::Row;
use formicar::planner::PathDocument;
use formicar::progress::IterationRecord;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

/// The columns that tell where a row comes from, behind those of the row.
pub const ORIGIN_COLUMNS: [&str; 12] = [
    "vehicle",
    "motion",
    "budget_steps",
    "deadline_ms",
    "cold",
    "version",
    "build",
    "machine",
    "config_hash",
    "map_hash",
    "vehicle_hash",
    "run",
];

/// Where a row comes from, a value for each of [`ORIGIN_COLUMNS`]; empty where it is not known.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Origin([String; ORIGIN_COLUMNS.len()]);

/// A run that is over.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Record {
    /// What was measured.
    pub row: Row,
    /// Where it comes from.
    pub origin: Origin,
    /// How it went.
    pub history: History,
    /// The path found: its segments, and a pose where it stands still.
    pub path: Option<PathDocument>,
}

/// How a run went, as its observer heard of it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct History {
    /// Every certified path that was better than all before.
    pub improvements: Vec<Improvement>,
    /// The iterations of a colony, where one ran.
    pub iterations: Vec<Value>,
}

/// A certified path that was better than all before.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Improvement {
    /// When, from the beginning of the query, seconds.
    pub at_s: f64,
    /// Search steps by then.
    pub steps: u64,
    /// Its length.
    pub length_m: f64,
}

/// What the process of a run prints.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Told {
    /// Values by column.
    pub row: Map<String, Value>,
    /// How it went.
    pub history: History,
    /// The path found.
    pub path: Option<PathDocument>,
}

impl History {
    /// Of improvements, and of the iterations of a colony.
    pub fn new(improvements: Vec<Improvement>, iterations: &[IterationRecord]) -> Self {
        let iterations = iterations.iter().map(|iteration| json!(iteration));
        Self {
            improvements,
            iterations: iterations.collect(),
        }
    }
}

impl Told {
    /// What a process has printed, with the row that it makes; none where it is not that of a job.
    pub fn read(text: &str, job: &Job) -> Option<(Row, Self)> {
        let told: Self = serde_json::from_str(text).ok()?;
        Some((Row::from_values(&told.row, job)?, told))
    }
}

impl Origin {
    /// Of a planned run, measured by a program on a machine.
    pub fn new(run: &PlannedRun, [version, build, machine]: [&str; 3]) -> Self {
        let limits = &run.job.limits;
        let number = |n: Option<String>| n.unwrap_or_default();
        Self([
            run.job.vehicle_name().to_owned(),
            run.job.motion_name().to_owned(),
            number(limits.budget_steps.map(|n| n.to_string())),
            number(limits.deadline_ms.map(|ms| json!(ms).to_string())),
            limits.is_cold.to_string(),
            version.to_owned(),
            build.to_owned(),
            machine.to_owned(),
            run.config_hash.clone(),
            run.map_hash.clone(),
            run.vehicle_hash.clone(),
            run.key.clone(),
        ])
    }

    /// The value in a column; empty where there is none.
    pub fn get(&self, column: &str) -> &str {
        let index = ORIGIN_COLUMNS.iter().position(|c| *c == column);
        index.map_or("", |i| self.0[i].as_str())
    }

    /// Takes a value for a column; others are none of it.
    pub fn set(&mut self, column: &str, value: &str) {
        if let Some(i) = ORIGIN_COLUMNS.iter().position(|c| *c == column) {
            value.clone_into(&mut self.0[i]);
        }
    }

    /// The values in the order of the columns.
    pub fn fields(&self) -> &[String] {
        &self.0
    }
}

impl Record {
    /// The value in a column of row or origin; empty where there is none.
    pub fn get(&self, column: &str) -> &str {
        if ORIGIN_COLUMNS.contains(&column) {
            self.origin.get(column)
        } else {
            self.row.get(column)
        }
    }
}
