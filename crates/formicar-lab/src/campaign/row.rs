//! A row of results: what was measured of one run.

use super::job::{Job, RowKey};
use serde_json::{Map, Value};

/// The columns, in their order.
pub const COLUMNS: [&str; 54] = [
    "scenario",
    "planner",
    "seed",
    "status",
    "valid",
    "map_setup_s",
    "first_feasible_s",
    "query_s",
    "cpu_s",
    "peak_rss_bytes",
    "length_m",
    "min_clearance_m",
    "n_cusps",
    "length_0.1s_m",
    "min_clearance_0.1s_m",
    "n_cusps_0.1s",
    "length_1s_m",
    "min_clearance_1s_m",
    "n_cusps_1s",
    "cold_first_s",
    "first_length_m",
    "first_steps",
    "cost_m",
    "ends_clearance_m",
    "judge_s",
    "max_curvature_per_m",
    "mean_abs_curvature_per_m",
    "total_turning_rad",
    "aol_rad_per_m",
    "max_curvature_rate_per_m2",
    "n_curvature_jumps",
    "reverse_length_m",
    "mean_clearance_m",
    "max_steer_rad",
    "steering_share_to_5_deg",
    "steering_share_from_5_to_10_deg",
    "steering_share_over_10_deg",
    "goal_error_m",
    "goal_error_rad",
    "benchmr_aol",
    "benchmr_max_curvature",
    "benchmr_normalized_curvature",
    "benchmr_cusps",
    "ompl_smoothness",
    "matlab_smoothness",
    "matlab_clearance",
    "steps",
    "length_cells",
    "optimal_length_cells",
    "total_s",
    "n_cols",
    "n_rows",
    "source",
    "reason",
];

/// Times into the query, seconds, with the columns of the path known by then: length, clearance,
/// cusps.
pub const KNOWN_BY: [(f64, [&str; 3]); 2] = [
    (
        0.1,
        ["length_0.1s_m", "min_clearance_0.1s_m", "n_cusps_0.1s"],
    ),
    (1.0, ["length_1s_m", "min_clearance_1s_m", "n_cusps_1s"]),
];

/// The values of a run, one per column; empty where there is none.
#[derive(Clone, Debug, PartialEq)]
pub struct Row(Vec<String>);

impl Default for Row {
    fn default() -> Self {
        Self(vec![String::new(); COLUMNS.len()])
    }
}

impl Row {
    /// A row with nothing but what tells it apart.
    pub fn begin(job: &Job) -> Self {
        let mut row = Self::default();
        let (scenario, planner, seed) = job.row_key();
        row.set("scenario", &scenario.into());
        row.set("planner", &planner.into());
        row.set("seed", &seed.into());
        row.set("source", &job.task.source.clone().into());
        row
    }

    /// A row as it stands in a file; none where it is not one.
    pub fn from_fields(fields: Vec<String>) -> Option<Self> {
        let row = Self(fields);
        let is_row = row.0.len() == COLUMNS.len() && row.get("seed").parse::<u64>().is_ok();
        is_row.then_some(row)
    }

    /// What a process has printed; none where it is not the row of this job.
    pub fn from_values(values: &Map<String, Value>, job: &Job) -> Option<Self> {
        let mut row = Self::begin(job);
        for (column, value) in values {
            row.set(column, value);
        }
        (row.key() == job.row_key() && !row.get("status").is_empty()).then_some(row)
    }

    /// The values that there are, by column.
    pub fn values(&self) -> Map<String, Value> {
        let filled = COLUMNS.iter().zip(&self.0).filter(|(_, v)| !v.is_empty());
        let values = filled.map(|(c, v)| ((*c).into(), v.clone().into()));
        values.collect()
    }

    /// The values in the order of the columns.
    pub fn fields(&self) -> &[String] {
        &self.0
    }

    /// What tells the row apart.
    pub fn key(&self) -> RowKey {
        let seed = self.get("seed").parse().unwrap_or_default();
        (
            self.get("scenario").into(),
            self.get("planner").into(),
            seed,
        )
    }

    /// The value in a column as text; empty where there is none.
    pub fn get(&self, column: &str) -> &str {
        let index = COLUMNS.iter().position(|c| *c == column);
        index.map_or("", |i| self.0[i].as_str())
    }

    /// Whether a path was returned that carries a certificate.
    pub fn is_solved(&self) -> bool {
        self.get("status") == "found" && self.get("valid") == "true"
    }

    /// The number in a column.
    pub fn number(&self, column: &str) -> Option<f64> {
        self.get(column).parse().ok()
    }

    /// Takes a value for a column; others are none of the table's.
    pub fn set(&mut self, column: &str, value: &Value) {
        let Some(index) = COLUMNS.iter().position(|c| *c == column) else {
            return;
        };
        self.0[index] = match value {
            Value::Null => String::new(),
            // A row is a line, so that a torn one is told by its missing end.
            Value::String(text) => text.replace(['\n', '\r'], " "),
            other => other.to_string(),
        };
    }

    /// Takes the values of an object; those of an object in it as `outer_inner`.
    pub fn fill(&mut self, values: &Value) {
        let Value::Object(values) = values else {
            return;
        };
        for (column, value) in values {
            match value {
                Value::Object(inner) => {
                    for (name, value) in inner {
                        self.set(&format!("{column}_{name}"), value);
                    }
                }
                _ => self.set(column, value),
            }
        }
    }
}
