//! The answer document: one definition of what every front end prints about a query.

use super::path_document::PathDocument;
use super::{Explanation, MotionRecord, RequestDocument};
use crate::collision::ObstacleMap;
use crate::map::GridFrame;
use crate::metrics::PathMetrics;
use crate::numeric::{Seed, counted};
use crate::path::Spacing;
use crate::planner::{NotFound, Outcome, Plan, PlanError, Planner, PlannerConfig, Stages};
use crate::progress::{IterationRecord, Status, Stop};
use crate::scenario::{ErrorCode, Request};
use crate::validation::Report;
use crate::vehicle::{Motion, Vehicle, VehicleParameters};

/// Name and version of the answer document.
pub const ANSWER_SCHEMA: &str = "formicar/answer/1";

/// The answer to one request.
///
/// Two runs of one request with one seed differ in `timing` alone.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct Answer {
    /// Name and version of this document: `formicar/answer/1`.
    pub schema: String,
    /// The request's `id`, where it had one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub id: Option<serde_json::Value>,
    /// `found`, `no_path`, `infeasible`, `budget_exhausted`, `timed_out`, `cancelled`, or
    /// `invalid_request`.
    pub status: AnswerStatus,
    /// Nav2's name of the outcome.
    pub code: ErrorCode,
    /// Nav2's number of the outcome.
    pub code_number: u16,
    /// Why there is no path; null where there is one.
    pub reason: Option<String>,
    /// The same in places and measures; null where there is a path, or nothing is known.
    pub explanation: Option<Explanation>,
    /// `budget_exhausted` or `timed_out` where that ended the improvement of the path found;
    /// missing where it ceased to gain.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cut_by: Option<Status>,
    /// Remarks on the path found that its driver should know, in words; none of most.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
    /// The planner asked.
    pub planner: String,
    /// The seed it was given.
    pub seed: u64,
    /// The judge's findings on the path found or, where the status is `infeasible`, refused.
    pub certificate: Option<Report>,
    /// Exact metrics of the path found.
    pub metrics: Option<PathMetrics>,
    /// The run of the colony; missing where no colony ran.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub colony: Option<ColonyRecord>,
    /// Times, seconds.
    pub timing: Timing,
    /// The drive out of contact before the path, which no certificate covers; missing where there
    /// is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub escape: Option<EscapeRecord>,
    /// The path, only if it is certified.
    pub path: Option<PathDocument>,
    /// The drive along the path in time; missing where none was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub motion: Option<MotionRecord>,
    /// All that a repetition of the run needs.
    pub provenance: Provenance,
}

/// The ending of a request.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum AnswerStatus {
    /// A certified path.
    Found,
    /// The search space holds no path.
    NoPath,
    /// The search found a path that the judge refused.
    Infeasible,
    /// The step budget ran out first.
    BudgetExhausted,
    /// The deadline passed first.
    TimedOut,
    /// The caller cancelled.
    Cancelled,
    /// A request that could not be asked.
    InvalidRequest,
}

impl AnswerStatus {
    /// The word used in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Found => Status::Found.name(),
            Self::NoPath => Status::NoPath.name(),
            Self::Infeasible => Status::Infeasible.name(),
            Self::BudgetExhausted => Status::BudgetExhausted.name(),
            Self::TimedOut => Status::TimedOut.name(),
            Self::Cancelled => Status::Cancelled.name(),
            Self::InvalidRequest => "invalid_request",
        }
    }
}

impl From<Status> for AnswerStatus {
    fn from(status: Status) -> Self {
        match status {
            Status::Found => Self::Found,
            Status::NoPath => Self::NoPath,
            Status::Infeasible => Self::Infeasible,
            Status::BudgetExhausted => Self::BudgetExhausted,
            Status::TimedOut => Self::TimedOut,
            Status::Cancelled => Self::Cancelled,
        }
    }
}

/// A drive out of contact with obstacles.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct EscapeRecord {
    /// Cells that the body touches at the start; on the drive it touches no others.
    pub n_cells: usize,
    /// The drive.
    pub path: PathDocument,
}

/// The run of a colony.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ColonyRecord {
    /// Why it stopped.
    pub stop: Stop,
    /// Iterations until its best path was found; null if no ant arrived.
    pub converged_after: Option<u32>,
    /// Cells of its best path.
    pub n_cells: usize,
    /// Nodes of the polyline that is left of them.
    pub n_nodes: usize,
    /// All iterations.
    pub iterations: Vec<IterationRecord>,
}

impl ColonyRecord {
    /// The record of a run; none where no colony ran.
    pub fn new(stages: &Stages) -> Option<Self> {
        let run = stages.colony.as_ref()?;
        Some(Self {
            stop: run.stop,
            converged_after: run.history.converged_after(),
            n_cells: run.best.as_ref().map_or(0, |path| path.cells.len()),
            n_nodes: stages.nodes.len(),
            iterations: run.history.iterations.clone(),
        })
    }
}

/// Times in seconds; the caller measures them.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Timing {
    /// Preparing the map, once per map and vehicle.
    pub map_setup_s: f64,
    /// From the beginning of the query to its first certified path.
    pub first_feasible_s: Option<f64>,
    /// The query.
    pub query_s: f64,
    /// Everything, from reading the map to the end of the query.
    pub total_s: f64,
}

/// All that a repetition of a run needs.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct Provenance {
    /// Version of formicar.
    pub version: String,
    /// Source and reading of the map.
    pub map: MapRecord,
    /// The vehicle.
    pub vehicle: VehicleRecord,
    /// The request with all its defaults; null where it could not be read.
    pub request: Option<RequestDocument>,
    /// Every parameter of a built-in planner; null of another.
    pub config: Option<ConfigRecord>,
}

/// The parameters of the planner that answered.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(untagged)]
pub enum ConfigRecord {
    /// Those of this version.
    Known(Box<PlannerConfig>),
    /// Those of another version, as they are written.
    Other(serde_json::Value),
}

impl ConfigRecord {
    /// Those of this version; none of another one.
    pub fn known(&self) -> Option<&PlannerConfig> {
        match self {
            Self::Known(config) => Some(config),
            Self::Other(_) => None,
        }
    }
}

/// Source and reading of a map.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MapRecord {
    /// File or built-in name.
    pub name: String,
    /// Columns.
    pub n_cols: usize,
    /// Rows.
    pub n_rows: usize,
    /// Side of a cell, meters.
    pub resolution_m: f64,
    /// World pose of the lower left corner, `[x m, y m, yaw rad]`.
    pub origin: [f64; 3],
    /// Reading of unknown cells: `free` or `occupied`.
    pub unknown: String,
    /// Areas closed for the vehicle, as corners `[x m, y m]`.
    pub keep_out: Vec<Vec<[f64; 2]>>,
    /// Maps whose occupied cells close ground for the vehicle.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub keep_out_maps: Vec<KeepOutMapRecord>,
    /// Doubts about the file, in words; none of most.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
    /// Preference for some ground over other; missing without one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub soft_costs: Option<SoftCostsRecord>,
}

impl MapRecord {
    /// What findings on this map take as given, in words: doubts about its file, and the ground
    /// that other maps close.
    pub fn assumptions(&self) -> Vec<String> {
        let closed = self.keep_out_maps.iter().map(KeepOutMapRecord::in_words);
        self.warnings.iter().cloned().chain(closed).collect()
    }

    /// The same source with size and place of a frame.
    #[must_use]
    pub fn on(&self, frame: &GridFrame) -> Self {
        let origin = frame.origin();
        Self {
            n_cols: frame.n_cols(),
            n_rows: frame.n_rows(),
            resolution_m: frame.resolution_m(),
            origin: [origin.x, origin.y, origin.heading],
            ..self.clone()
        }
    }
}

/// A map that closes ground.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct KeepOutMapRecord {
    /// File.
    pub name: String,
    /// Cells of the planner's map on which its occupied cells lie.
    pub n_cells: usize,
}

impl KeepOutMapRecord {
    /// The same as a clause.
    pub fn in_words(&self) -> String {
        let cells = counted(self.n_cells, "cell");
        format!("the keep-out map {} closes {cells}", self.name)
    }
}

/// Source of soft costs.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SoftCostsRecord {
    /// File, or `map`: the graded cells of the map itself.
    pub name: String,
    /// Their weight.
    pub weight: f64,
}

/// A vehicle by name and measures.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct VehicleRecord {
    /// Preset or file.
    pub name: String,
    /// `car`, or `point`: holonomic, without measures.
    pub motion: Motion,
    /// The measures; of a point, none.
    pub parameters: VehicleParameters,
}

/// The standing facts that all answers of one planner share.
#[derive(Clone, Debug)]
pub struct AnswerContext<'a> {
    /// The planner, with its map, vehicle and parameters.
    pub planner: &'a Planner,
    /// The map's origin; size, resolution and pose are filled in from the planner.
    pub map: MapRecord,
    /// The vehicle's preset or file name.
    pub vehicle_name: &'a str,
    /// How close the poses of a path lie.
    pub spacing: Spacing,
}

impl AnswerContext<'_> {
    /// The answer to a request that was planned or refused; `None` where it is incomplete.
    pub fn answer(
        &self,
        request: Option<&Request>,
        seed: Seed,
        result: &Result<Outcome, PlanError>,
        timing: Timing,
    ) -> Answer {
        let blank = Answer {
            timing,
            ..self.blank(request.map(RequestDocument::from), seed)
        };
        match result {
            Ok(Outcome::Found(plan)) => self.found(plan, blank),
            Ok(Outcome::NotFound(failure)) => not_found(failure, blank),
            Err(error) => Answer {
                reason: Some(error.to_string()),
                explanation: error.explanation(),
                code: error.code(),
                code_number: error.code().number(),
                ..blank
            },
        }
    }

    /// The answer to a request that cannot be read.
    pub fn unreadable(&self, reason: String, seed: Seed) -> Answer {
        Answer {
            reason: Some(reason),
            ..self.blank(None, seed)
        }
    }

    fn found(&self, plan: &Plan, blank: Answer) -> Answer {
        let (obstacles, vehicle) = (self.planner.obstacles(), self.planner.vehicle());
        Answer {
            status: AnswerStatus::Found,
            code: ErrorCode::None,
            code_number: ErrorCode::None.number(),
            certificate: Some(
                (*plan.certificate)
                    .clone()
                    .assuming(&self.map.assumptions()),
            ),
            metrics: Some(plan.metrics.clone()),
            cut_by: plan.cut_by,
            notes: notes(plan, vehicle),
            colony: ColonyRecord::new(&plan.stages),
            escape: plan.escape.as_ref().map(|escape| EscapeRecord {
                n_cells: escape.n_cells,
                path: PathDocument::new(&escape.path, obstacles, vehicle, self.spacing),
            }),
            path: Some(PathDocument::new(
                &plan.path,
                obstacles,
                vehicle,
                self.spacing,
            )),
            ..blank
        }
    }

    /// The answer to a request that cannot be asked, for no reason yet.
    fn blank(&self, request: Option<RequestDocument>, seed: Seed) -> Answer {
        Answer {
            schema: ANSWER_SCHEMA.to_owned(),
            id: None,
            status: AnswerStatus::InvalidRequest,
            code: ErrorCode::Unknown,
            code_number: ErrorCode::Unknown.number(),
            reason: None,
            explanation: None,
            cut_by: None,
            notes: Vec::new(),
            planner: self.planner.name().to_owned(),
            seed: seed.0,
            certificate: None,
            metrics: None,
            colony: None,
            timing: Timing::default(),
            escape: None,
            path: None,
            motion: None,
            provenance: self.provenance(request),
        }
    }

    fn provenance(&self, request: Option<RequestDocument>) -> Provenance {
        let vehicle = self.planner.vehicle();
        Provenance {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            map: self.map.on(self.planner.obstacles().frame()),
            vehicle: VehicleRecord {
                name: self.vehicle_name.to_owned(),
                motion: vehicle.motion(),
                parameters: vehicle.parameters().clone(),
            },
            request,
            config: self
                .planner
                .config()
                .map(|config| ConfigRecord::Known(Box::new(config.clone()))),
        }
    }
}

impl Answer {
    /// The same answer with other remarks.
    #[must_use]
    pub fn with_notes(self, notes: Vec<String>) -> Self {
        Self { notes, ..self }
    }

    /// The same answer with a drive along its path, whose poses get the times of the drive.
    #[must_use]
    pub fn with_motion(
        self,
        record: MotionRecord,
        obstacles: &ObstacleMap,
        vehicle: &Vehicle,
    ) -> Self {
        let path = self.path.map(|path| {
            let timed = path.curve_path().and_then(|curve| record.timed(&curve));
            timed.map_or(path.clone(), |timed| path.timed(&timed, obstacles, vehicle))
        });
        Self {
            path,
            motion: Some(record),
            ..self
        }
    }
}

fn notes(plan: &Plan, vehicle: &Vehicle) -> Vec<String> {
    let n_jumps = plan.metrics.n_curvature_jumps;
    let stands = n_jumps > 0 && vehicle.parameters().max_steer_rate_rad_per_s.is_some();
    let places = counted(n_jumps, "place");
    let standing = stands.then(|| {
        format!(
            "the curvature jumps at {places}, where the vehicle has to stop to turn its wheels; hint: ask for continuous curvature (--continuous-curvature)"
        )
    });
    let escape = plan.escape.as_ref().map(|escape| {
        let (length_m, n_cells) = (escape.path.length_m(), counted(escape.n_cells, "cell"));
        let there = plan.path.start().wrapped();
        format!(
            "the vehicle stands in {n_cells} and first drives {length_m:.3} m out of contact, uncertified; the path begins at ({:.3}, {:.3}, {:.4})",
            there.x, there.y, there.heading
        )
    });
    escape.into_iter().chain(standing).collect()
}

fn not_found(failure: &NotFound, blank: Answer) -> Answer {
    let code = ErrorCode::from(failure.status);
    Answer {
        status: failure.status.into(),
        code,
        code_number: code.number(),
        reason: Some(failure.reason.clone()),
        explanation: Some(failure.explanation.clone()),
        certificate: failure.refused.as_ref().map(|(_, report)| report.clone()),
        colony: ColonyRecord::new(&failure.stages),
        ..blank
    }
}
