//! The result of a search: a path that is yet to be judged, or the reason why there is none.

use super::{Explanation, PlanError, Stages};
use crate::colony::RunError;
use crate::path::CurvePath;
use crate::progress::{Limits, Status};
use crate::search::SearchError;
use crate::vehicle::VehicleError;

/// A path as a search found it, before it is judged.
#[derive(Clone, Debug)]
pub struct Found {
    /// The path, world coordinates.
    pub path: CurvePath,
    /// Intermediate results on the way to it.
    pub stages: Stages,
    /// The limit that ended its improvement early.
    pub cut_by: Option<Status>,
}

impl Found {
    /// A path with what was computed on the way to it.
    pub fn new(path: CurvePath, stages: Stages) -> Self {
        Self {
            path,
            stages,
            cut_by: None,
        }
    }
}

/// Why a search hands back no path.
#[derive(Debug)]
pub enum Halt {
    /// It ended by itself, by a limit or by a cancel: [`Outcome::NotFound`](super::Outcome).
    Ended(Ended),
    /// It cannot be asked this: an error of the caller.
    Refused(PlanError),
}

/// A search that ended without a path.
#[derive(Clone, Debug)]
pub struct Ended {
    /// The named ending, never `found`.
    pub status: Status,
    /// The reason, where the status does not say it all.
    pub reason: Option<String>,
    /// The same in places and measures, where they are known already.
    pub explanation: Option<Box<Explanation>>,
    /// Intermediate results before it ended.
    pub stages: Box<Stages>,
}

impl Ended {
    /// An ending whose status says it all.
    pub fn new(status: Status, stages: Stages) -> Self {
        Self {
            status,
            reason: None,
            explanation: None,
            stages: Box::new(stages),
        }
    }

    /// An ending for a reason.
    pub fn because(status: Status, reason: String, stages: Stages) -> Self {
        Self {
            reason: Some(reason),
            ..Self::new(status, stages)
        }
    }

    /// True where another attempt may do better: the search has ended by itself, and there are
    /// steps left.
    pub(super) fn leaves_hope(&self, limits: &Limits) -> bool {
        match self.status {
            Status::NoPath | Status::Infeasible => true,
            Status::BudgetExhausted => limits.has_steps_left(),
            Status::Found | Status::TimedOut | Status::Cancelled => false,
        }
    }
}

impl Halt {
    /// The ending of a search.
    ///
    /// # Errors
    /// That the search refused what it was asked.
    pub fn ended(self) -> Result<Ended, PlanError> {
        match self {
            Self::Ended(ended) => Ok(ended),
            Self::Refused(error) => Err(error),
        }
    }
}

impl From<Status> for Ended {
    fn from(status: Status) -> Self {
        Self::new(status, Stages::default())
    }
}

impl From<Status> for Halt {
    fn from(status: Status) -> Self {
        Self::Ended(status.into())
    }
}

impl From<Ended> for Halt {
    fn from(ended: Ended) -> Self {
        Self::Ended(ended)
    }
}

impl From<PlanError> for Halt {
    fn from(error: PlanError) -> Self {
        Self::Refused(error)
    }
}

impl From<VehicleError> for Halt {
    fn from(error: VehicleError) -> Self {
        Self::Refused(error.into())
    }
}

impl From<SearchError> for Halt {
    fn from(error: SearchError) -> Self {
        match error {
            SearchError::Ended { status } => status.into(),
            error => Self::Refused(PlanError::Search(error)),
        }
    }
}

impl From<RunError> for Halt {
    fn from(error: RunError) -> Self {
        match error {
            RunError::Search(SearchError::Ended { status }) => status.into(),
            error => Self::Refused(PlanError::Colony(error)),
        }
    }
}
