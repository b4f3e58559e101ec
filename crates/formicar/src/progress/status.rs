//! The named endings of a query.

use crate::scenario::ErrorCode;

/// The ending of a query.
///
/// ```
/// use formicar::Status;
/// use formicar::scenario::ErrorCode;
///
/// assert_eq!(Status::BudgetExhausted.name(), "budget_exhausted");
/// assert_eq!(ErrorCode::from(Status::TimedOut), ErrorCode::Timeout);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Status {
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
}

impl Status {
    /// The word used in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Found => "found",
            Self::NoPath => "no_path",
            Self::Infeasible => "infeasible",
            Self::BudgetExhausted => "budget_exhausted",
            Self::TimedOut => "timed_out",
            Self::Cancelled => "cancelled",
        }
    }
}

impl From<Status> for ErrorCode {
    /// Nav2's code for an ending.
    fn from(status: Status) -> Self {
        match status {
            Status::Found => Self::None,
            Status::NoPath | Status::Infeasible | Status::BudgetExhausted => Self::NoValidPath,
            Status::TimedOut => Self::Timeout,
            Status::Cancelled => Self::Unknown,
        }
    }
}
