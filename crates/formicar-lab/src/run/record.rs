//! The record of a run: measurements, origin, history and path.

use super::columns::table_columns;
use super::job::{Job, RunKey};
use super::measure::Improvement;
use super::status::RunStatus;
use formicar::metrics::{CompatibleMetrics, PathMetrics};
use formicar::planner::PathDocument;
use formicar::progress::IterationRecord;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

table_columns! {
    /// The measurements of a run.
    ///
    /// Times are seconds, lengths meters. A value is missing where there is none: of a run without
    /// a path, of a platform that does not tell, of a file of others.
    RunRecord, COLUMNS:
    /// The scenario.
    scenario: String,
    /// The planner, or the variant of one.
    planner: String,
    /// The seed.
    seed: u64,
    /// The ending.
    status: RunStatus,
    /// True if the judge certifies the path.
    valid: Option<bool>,
    /// Preparing map and vehicle.
    map_setup_s: Option<f64>,
    /// From the beginning of the query to its first certified path.
    first_feasible_s: Option<f64>,
    /// The query.
    query_s: Option<f64>,
    /// Processor time of the run, without the query that only warms up.
    cpu_s: Option<f64>,
    /// Largest resident memory of the process.
    peak_rss_bytes: Option<u64>,
    /// Length of the path.
    length_m: Option<f64>,
    /// Least clearance along the path.
    min_clearance_m: Option<f64>,
    /// Changes of gear.
    n_cusps: Option<u64>,
    /// Length of the best path 0.1 s into the query.
    length_by_tenth_m: Option<f64> = "length_0.1s_m",
    /// Its least clearance, where it is the last path.
    min_clearance_by_tenth_m: Option<f64> = "min_clearance_0.1s_m",
    /// Its changes of gear, where it is the last path.
    n_cusps_by_tenth: Option<u64> = "n_cusps_0.1s",
    /// Length of the best path 1 s into the query.
    length_by_second_m: Option<f64> = "length_1s_m",
    /// Its least clearance, where it is the last path.
    min_clearance_by_second_m: Option<f64> = "min_clearance_1s_m",
    /// Its changes of gear, where it is the last path.
    n_cusps_by_second: Option<u64> = "n_cusps_1s",
    /// Time to the first path of a planner that has just been made.
    cold_first_s: Option<f64>,
    /// Processor time of preparing map and vehicle.
    map_setup_cpu_s: Option<f64>,
    /// Processor time from the beginning of the query to its first certified path.
    first_feasible_cpu_s: Option<f64>,
    /// The same of a planner that has just been made.
    cold_first_cpu_s: Option<f64>,
    /// Processor time of the query.
    query_cpu_s: Option<f64>,
    /// Length of the first certified path.
    first_length_m: Option<f64>,
    /// Search steps to the first certified path.
    first_steps: Option<u64>,
    /// Cost of driving the path by the usual weights.
    cost_m: Option<f64>,
    /// The lesser of the clearances at start and goal.
    ends_clearance_m: Option<f64>,
    /// Judging the path once more.
    judge_s: Option<f64>,
    /// Largest curvature.
    max_curvature_per_m: Option<f64>,
    /// Mean absolute curvature.
    mean_abs_curvature_per_m: Option<f64>,
    /// Absolute change of heading, summed.
    total_turning_rad: Option<f64>,
    /// Angle over length.
    aol_rad_per_m: Option<f64>,
    /// Largest change of curvature per meter.
    max_curvature_rate_per_m2: Option<f64>,
    /// Jumps of curvature.
    n_curvature_jumps: Option<u64>,
    /// Length driven in reverse.
    reverse_length_m: Option<f64>,
    /// Mean clearance along the path.
    mean_clearance_m: Option<f64>,
    /// Largest steering angle.
    max_steer_rad: Option<f64>,
    /// Share of the path steered by up to 5 degrees.
    steering_share_to_5_deg: Option<f64>,
    /// Share of the path steered by 5 to 10 degrees.
    steering_share_from_5_to_10_deg: Option<f64>,
    /// Share of the path steered by more than 10 degrees.
    steering_share_over_10_deg: Option<f64>,
    /// Distance of the end from the goal.
    goal_error_m: Option<f64>,
    /// Difference of the heading at the end to that of the goal.
    goal_error_rad: Option<f64>,
    /// Angle over length as Bench-MR computes it.
    benchmr_aol: Option<f64>,
    /// Largest curvature as Bench-MR computes it.
    benchmr_max_curvature: Option<f64>,
    /// Normalized curvature as Bench-MR computes it.
    benchmr_normalized_curvature: Option<f64>,
    /// Cusps as Bench-MR counts them.
    benchmr_cusps: Option<u64>,
    /// Smoothness as OMPL computes it.
    ompl_smoothness: Option<f64>,
    /// Smoothness as MATLAB computes it.
    matlab_smoothness: Option<f64>,
    /// Clearance as MATLAB computes it.
    matlab_clearance: Option<f64>,
    /// Search steps.
    steps: Option<u64>,
    /// Length between cell centers, a straight step counting 1.
    length_cells: Option<f64>,
    /// The published optimum of that length.
    optimal_length_cells: Option<f64>,
    /// From the beginning of the process to the end of the query.
    total_s: Option<f64>,
    /// Columns of the map.
    n_cols: Option<u64>,
    /// Rows of the map.
    n_rows: Option<u64>,
    /// The file or map that the scenario is of.
    source: String,
    /// The reason why there is no path, or why it does not count.
    reason: String,
}

table_columns! {
    /// The origin of a run; empty where that is not known.
    Origin, ORIGIN_COLUMNS:
    /// The vehicle: `own` for the scenario's.
    vehicle: String,
    /// The motion mode.
    motion: String,
    /// Search steps after which the run gives up.
    budget_steps: Option<u64>,
    /// Time after which the run gives up.
    deadline_ms: Option<f64>,
    /// True if the first query of the planner counts.
    cold: Option<bool>,
    /// Version of the program.
    version: String,
    /// Its build: `debug` or `release`.
    build: String,
    /// The machine.
    machine: String,
    /// Hash of the planner's parameters.
    config_hash: String,
    /// Hash of the map as the judge sees it.
    map_hash: String,
    /// Hash of the vehicle as the judge sees it.
    vehicle_hash: String,
    /// Key of the run in its campaign.
    run: String,
}

/// A run that is over.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// The measurements.
    #[serde(rename = "row")]
    pub record: RunRecord,
    /// Its origin, which the process of a run does not know.
    #[serde(skip)]
    pub origin: Origin,
    /// Its course.
    pub history: History,
    /// The path found: its segments, and a pose where it stands still.
    pub path: Option<PathDocument>,
}

/// The paths and iterations of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct History {
    /// Certified paths, the best last.
    pub improvements: Vec<Improvement>,
    /// Those of the first query of a planner that was asked twice.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub cold: Vec<Improvement>,
    /// The iterations of a colony, where one ran.
    pub iterations: Vec<Value>,
}

impl History {
    /// The improvements of a query, and the iterations of its colony.
    pub fn new(improvements: Vec<Improvement>, iterations: &[IterationRecord]) -> Self {
        Self {
            improvements,
            cold: Vec::new(),
            iterations: iterations
                .iter()
                .map(|iteration| json!(iteration))
                .collect(),
        }
    }
}

impl Run {
    /// Scenario, vehicle and motion mode; tables of others may know the first alone.
    pub fn place(&self) -> [&str; 3] {
        [
            &self.record.scenario,
            &self.origin.vehicle,
            &self.origin.motion,
        ]
    }
}

impl RunRecord {
    /// The record of a job of which nothing is known yet.
    pub fn of_job(job: &Job) -> Self {
        let (scenario, planner, seed) = job.key();
        Self {
            scenario,
            planner,
            seed,
            source: job.task.source.clone(),
            optimal_length_cells: job.task.optimal_length_cells(),
            ..Self::default()
        }
    }

    /// The record of a job that ended without an answer.
    pub fn crashed(job: &Job, reason: &str) -> Self {
        let mut record = Self::of_job(job);
        record.optimal_length_cells = None;
        record.fail(RunStatus::Crashed, reason);
        record
    }

    /// Notes how and why the run ended without a path.
    pub(crate) fn fail(&mut self, status: RunStatus, reason: &str) {
        self.status = status;
        self.reason = one_line(reason);
    }

    /// The key that tells the run apart in a table of one vehicle and one motion mode.
    pub fn key(&self) -> RunKey {
        (self.scenario.clone(), self.planner.clone(), self.seed)
    }

    /// True if a path was returned that carries a certificate.
    pub fn is_solved(&self) -> bool {
        self.status == RunStatus::Found && self.valid == Some(true)
    }

    /// Takes the metrics of a path.
    pub(crate) fn measure_path(&mut self, exact: &PathMetrics, compatible: &CompatibleMetrics) {
        for metrics in [json!(exact), json!(compatible)] {
            let filled = self.fill(&metrics);
            filled.expect("metrics are numbers, and named like their columns");
        }
        let share = &exact.steering_share;
        self.steering_share_to_5_deg = finite(share.to_5_deg);
        self.steering_share_from_5_to_10_deg = finite(share.from_5_to_10_deg);
        self.steering_share_over_10_deg = finite(share.over_10_deg);
    }

    /// Notes the best path known 0.1 s and 1 s into the query.
    ///
    /// Clearance and cusps are known of the last path alone: nothing but the length is kept of
    /// those that it replaced.
    pub(crate) fn note_known_paths(&mut self, improvements: &[Improvement]) {
        let known_by = |limit_s: f64| {
            let mut by_then = improvements.iter().rev();
            by_then.find(|path| path.at_s <= limit_s)
        };
        let is_last = |path: &&Improvement| Some(path.length_m) == self.length_m;
        if let Some(path) = known_by(0.1) {
            self.length_by_tenth_m = Some(path.length_m);
            if is_last(&path) {
                self.min_clearance_by_tenth_m = self.min_clearance_m;
                self.n_cusps_by_tenth = self.n_cusps;
            }
        }
        if let Some(path) = known_by(1.0) {
            self.length_by_second_m = Some(path.length_m);
            if is_last(&path) {
                self.min_clearance_by_second_m = self.min_clearance_m;
                self.n_cusps_by_second = self.n_cusps;
            }
        }
    }
}

/// A number that can be written to a table.
pub(crate) fn finite(number: f64) -> Option<f64> {
    Some(number).filter(|number| number.is_finite())
}

/// A count as a number to compute with.
pub(crate) fn number(count: Option<u64>) -> Option<f64> {
    count.map(|count| count as f64)
}

/// A text without line breaks: a row is a line, so that a torn one is known by its missing end.
pub(crate) fn one_line(text: &str) -> String {
    text.replace(['\n', '\r'], " ")
}
