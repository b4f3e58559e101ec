//! The answer document: one definition of what every front end prints about a query.

use super::path_document::PathDocument;
use super::{Explanation, Outcome, PlanError, PlannerConfig, RequestDocument, Stages};
use crate::collision::ObstacleMap;
use crate::metrics::PathMetrics;
use crate::numeric::Seed;
use crate::progress::{IterationRecord, Status, Stop};
use crate::scenario::{ErrorCode, Request};
use crate::validation::Report;
use crate::vehicle::{Motion, Vehicle, VehicleParameters};
use schemars::JsonSchema;
use serde::Serialize;

/// Name and version of the answer document.
pub const ANSWER_SCHEMA: &str = "formicar/answer/1";

/// The status of a request that could not be asked; the others are those of a run.
const INVALID_REQUEST: &str = "invalid_request";

/// What came of one request.
///
/// Two runs of one request with one seed differ in `timing` alone.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Answer {
    /// Name and version of this document: `formicar/answer/1`.
    pub schema: &'static str,
    /// The request's `id`, where it had one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub id: Option<serde_json::Value>,
    /// `found`, `no_path`, `infeasible`, `budget_exhausted`, `timed_out`, `cancelled`, or
    /// `invalid_request`.
    pub status: &'static str,
    /// Nav2's name of the outcome.
    pub code: &'static str,
    /// Nav2's number of the outcome.
    pub code_number: u16,
    /// Why there is no path; null where there is one.
    pub reason: Option<String>,
    /// The same in places and measures; null where there is a path, or nothing is known.
    pub explanation: Option<Explanation>,
    /// `budget_exhausted` or `timed_out` where that ended the improvement of the path found;
    /// missing where it ceased to gain.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cut_by: Option<&'static str>,
    /// The planner asked.
    pub planner: &'static str,
    /// The seed it was given.
    pub seed: u64,
    /// The judge's findings on the path found or, where the status is `infeasible`, refused.
    pub certificate: Option<Report>,
    /// Exact metrics of the path found.
    pub metrics: Option<PathMetrics>,
    /// What the colony did; missing where no colony ran.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub colony: Option<ColonyRecord>,
    /// How long it took, seconds.
    pub timing: Timing,
    /// The path, only if it is certified.
    pub path: Option<PathDocument>,
    /// What it takes to repeat the run.
    pub provenance: Provenance,
}

/// What a colony did.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
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
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, JsonSchema)]
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

/// What it takes to repeat a run.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Provenance {
    /// Version of formicar.
    pub version: &'static str,
    /// Where the map came from, and how it was read.
    pub map: MapRecord,
    /// The vehicle.
    pub vehicle: VehicleRecord,
    /// The request with all its defaults; null where it could not be read.
    pub request: Option<RequestDocument>,
    /// Every parameter of the planner.
    pub config: PlannerConfig,
}

/// Where a map came from, and how it was read.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct MapRecord {
    /// File or built-in name.
    pub name: String,
    /// Columns.
    pub n_cols: usize,
    /// Rows.
    pub n_rows: usize,
    /// Side of a cell, metres.
    pub resolution_m: f64,
    /// World pose of the lower left corner, `[x m, y m, yaw rad]`.
    pub origin: [f64; 3],
    /// How unknown cells were read: `free` or `occupied`.
    pub unknown: String,
    /// Areas closed for the vehicle, as corners `[x m, y m]`.
    pub keep_out: Vec<Vec<[f64; 2]>>,
    /// Where the vehicle should rather not drive; missing where it is all the same.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub soft_costs: Option<SoftCostsRecord>,
}

/// Where soft costs came from.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct SoftCostsRecord {
    /// File, or `map`: the graded cells of the map itself.
    pub name: String,
    /// What they weigh.
    pub weight: f64,
}

/// A vehicle by name and measures.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct VehicleRecord {
    /// Preset or file.
    pub name: String,
    /// `car`, or `point`: holonomic, without measures.
    pub motion: &'static str,
    /// The measures; of a point, none.
    pub parameters: VehicleParameters,
}

/// The standing facts that all answers of one planner share.
#[derive(Clone, Debug)]
pub struct AnswerContext<'a> {
    /// The prepared map.
    pub obstacles: &'a ObstacleMap,
    /// The map's story; size, resolution and origin are filled in from `obstacles`.
    pub map: MapRecord,
    /// The vehicle.
    pub vehicle: &'a Vehicle,
    /// The vehicle's preset or file name.
    pub vehicle_name: &'a str,
    /// The planner's parameters.
    pub config: &'a PlannerConfig,
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
        let document = request.map(RequestDocument::from);
        match result {
            Ok(Outcome::Found(plan)) => Answer {
                certificate: Some((*plan.certificate).clone()),
                metrics: Some(plan.metrics.clone()),
                cut_by: plan.cut_by.map(Status::name),
                colony: ColonyRecord::new(&plan.stages),
                path: Some(PathDocument::new(&plan.path, self.obstacles, self.vehicle)),
                ..self.blank("found", ErrorCode::None, document, (seed, timing))
            },
            Ok(Outcome::NotFound(failure)) => Answer {
                reason: Some(failure.reason.clone()),
                explanation: Some(failure.explanation.clone()),
                certificate: failure.refused.as_ref().map(|(_, report)| report.clone()),
                colony: ColonyRecord::new(&failure.stages),
                ..self.blank(
                    failure.status.name(),
                    failure.status.into(),
                    document,
                    (seed, timing),
                )
            },
            Err(error) => Answer {
                reason: Some(error.to_string()),
                explanation: error.explanation(),
                ..self.blank(INVALID_REQUEST, error.code(), document, (seed, timing))
            },
        }
    }

    /// The answer to a request that cannot be read.
    pub fn unreadable(&self, reason: String, seed: Seed) -> Answer {
        Answer {
            reason: Some(reason),
            ..self.blank(
                INVALID_REQUEST,
                ErrorCode::Unknown,
                None,
                (seed, Timing::default()),
            )
        }
    }

    fn blank(
        &self,
        status: &'static str,
        code: ErrorCode,
        request: Option<RequestDocument>,
        (seed, timing): (Seed, Timing),
    ) -> Answer {
        Answer {
            schema: ANSWER_SCHEMA,
            id: None,
            status,
            code: code.name(),
            code_number: code.number(),
            reason: None,
            explanation: None,
            cut_by: None,
            planner: self.config.planner.name(),
            seed: seed.0,
            certificate: None,
            metrics: None,
            colony: None,
            timing,
            path: None,
            provenance: self.provenance(request),
        }
    }

    fn provenance(&self, request: Option<RequestDocument>) -> Provenance {
        let frame = self.obstacles.frame();
        let origin = frame.origin();
        Provenance {
            version: env!("CARGO_PKG_VERSION"),
            map: MapRecord {
                n_cols: frame.n_cols(),
                n_rows: frame.n_rows(),
                resolution_m: frame.resolution_m(),
                origin: [origin.x, origin.y, origin.heading],
                ..self.map.clone()
            },
            vehicle: VehicleRecord {
                name: self.vehicle_name.to_owned(),
                motion: match self.vehicle.motion() {
                    Motion::Car => "car",
                    Motion::Point => "point",
                },
                parameters: self.vehicle.parameters().clone(),
            },
            request,
            config: self.config.clone(),
        }
    }
}
