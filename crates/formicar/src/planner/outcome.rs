//! The outcome of a query.

use super::{ConfigError, Escape, Explanation};
use crate::colony::ColonyRun;
use crate::evolution::EvolutionRun;
use crate::layers::Layers;
use crate::map::Cell;
use crate::metrics::PathMetrics;
use crate::numeric::Seed;
use crate::path::{CurvePath, GridPath};
use crate::progress::Status;
use crate::scenario::{ErrorCode, ScenarioError};
use crate::smoothing::CornerRecord;
use crate::validation::{Certificate, Report};
use thiserror::Error;

/// A certified path, or a named reason why there is none.
#[derive(Clone, Debug)]
pub enum Outcome {
    /// A path that the judge has certified.
    Found(Box<Plan>),
    /// No path.
    NotFound(Box<NotFound>),
}

impl Outcome {
    /// The plan, or the reason as an error: for callers that want `?`.
    ///
    /// # Errors
    /// [`PlanError::NotFound`] where there is no path.
    pub fn found(self) -> Result<Plan, PlanError> {
        match self {
            Self::Found(plan) => Ok(*plan),
            Self::NotFound(failure) => Err(PlanError::NotFound(failure)),
        }
    }

    /// The path that the judge has looked at, certified or refused, with its findings.
    pub fn judged(&self) -> Option<(&CurvePath, &Report)> {
        match self {
            Self::Found(plan) => Some((&plan.path, &plan.certificate)),
            Self::NotFound(failure) => {
                let refused = failure.refused.as_ref();
                refused.map(|(path, report)| (path, report))
            }
        }
    }

    /// Intermediate results before the path that is judged.
    pub fn stages(&self) -> &Stages {
        match self {
            Self::Found(plan) => &plan.stages,
            Self::NotFound(failure) => &failure.stages,
        }
    }

    /// Search steps done.
    pub fn n_steps(&self) -> u64 {
        match self {
            Self::Found(plan) => plan.n_steps,
            Self::NotFound(failure) => failure.n_steps,
        }
    }

    /// The ending of the query.
    pub fn status(&self) -> Status {
        match self {
            Self::Found(_) => Status::Found,
            Self::NotFound(failure) => failure.status,
        }
    }
}

/// A path with its certificate and everything that was computed on the way.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Plan {
    /// Name of the planner that found it.
    pub planner: String,
    /// The seed it was given.
    pub seed: Seed,
    /// The path, world coordinates.
    pub path: CurvePath,
    /// Intermediate results on the way to it.
    pub stages: Stages,
    /// The judge's word.
    pub certificate: Certificate,
    /// Exact metrics of the path.
    pub metrics: PathMetrics,
    /// Search steps done.
    pub n_steps: u64,
    /// The limit that ended the improvement of the path early: budget or deadline. Only a deadline
    /// can make two runs differ.
    pub cut_by: Option<Status>,
    /// The drive out of contact before the path, where the request asks for one and the vehicle
    /// stands in obstacles. The certificate holds from its end on.
    pub escape: Option<Escape>,
}

/// Intermediate results before the path that is judged, for pictures and studies; a planner
/// leaves out those that it does not compute.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Stages {
    /// Layers over the map.
    pub layers: Option<Layers>,
    /// The run of the colony.
    pub colony: Option<ColonyRun>,
    /// The run of a population.
    pub evolution: Option<EvolutionRun>,
    /// The chain of cells found.
    pub grid_path: Option<GridPath>,
    /// Those of its cells at which a polyline turns.
    pub nodes: Vec<Cell>,
    /// The rounding of each corner of the polyline.
    pub corners: Vec<CornerRecord>,
}

/// Why there is no path.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct NotFound {
    /// The named ending, never `found`.
    pub status: Status,
    /// The obstacle to a path, as a sentence.
    pub reason: String,
    /// The same in places and measures.
    pub explanation: Explanation,
    /// The path that the judge refused, with its findings.
    pub refused: Option<(CurvePath, Report)>,
    /// Intermediate results before it ended.
    pub stages: Stages,
    /// Search steps done.
    pub n_steps: u64,
}

impl NotFound {
    /// An ending with a reason; the rest is unknown.
    pub fn new(status: Status, reason: String, n_steps: u64) -> Self {
        Self {
            status,
            reason,
            explanation: Explanation::default(),
            refused: None,
            stages: Stages::default(),
            n_steps,
        }
    }
}

/// An error of the caller or, by [`Outcome::found`], that there is no path.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PlanError {
    /// A request that cannot be asked.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// A configuration outside its ranges.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// A planner that needs a steered vehicle, and a vehicle that is a point.
    #[error("{planner} plans for cars, the vehicle is a point; hint: use astar or dijkstra")]
    NeedsACar {
        /// The planner.
        planner: String,
    },
    /// New cells that do not fit the map.
    #[error(transparent)]
    Map(#[from] crate::map::MapError),
    /// A planner that cannot start from a previous path.
    #[error("{planner} does not replan; hint: use formicar, or plan anew")]
    CannotReplan {
        /// The planner.
        planner: String,
    },
    /// The vehicle does not suit the search.
    #[error(transparent)]
    Vehicle(#[from] crate::vehicle::VehicleError),
    /// A colony refused its input.
    #[error(transparent)]
    Colony(crate::colony::RunError),
    /// A grid search refused its input.
    #[error(transparent)]
    Search(crate::search::SearchError),
    /// A deadline without a clock to hold it against.
    #[error(
        "a deadline needs an observer with a clock; hint: implement Observer::elapsed, or use a step budget"
    )]
    DeadlineWithoutClock,
    /// No path, for callers that want one as an error.
    #[error("{}: {}", .0.status.name(), .0.reason)]
    NotFound(Box<NotFound>),
}

impl PlanError {
    /// Nav2's code for it.
    pub fn code(&self) -> ErrorCode {
        match self {
            Self::Scenario(error) => error.into(),
            Self::NotFound(failure) => failure.status.into(),
            Self::NeedsACar { .. } | Self::CannotReplan { .. } => ErrorCode::InvalidPlanner,
            _ => ErrorCode::Unknown,
        }
    }
}
