//! The ending of a run.

use super::columns::Field;
use crate::words::named;
use formicar::progress::Status;
use serde::{Deserialize, Serialize};

named! {
    /// The ending of a run: by a planner of ours, by a program of others, or without an answer.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
    #[serde(rename_all = "snake_case")]
    #[non_exhaustive]
    pub enum RunStatus {
        /// A path was returned.
        Found = "found",
        /// The search space holds no path.
        NoPath = "no_path",
        /// The judge refused the path that the search found.
        Infeasible = "infeasible",
        /// The budget of steps ran out.
        BudgetExhausted = "budget_exhausted",
        /// The deadline passed.
        TimedOut = "timed_out",
        /// The caller cancelled.
        Cancelled = "cancelled",
        /// The planner cannot be asked this.
        InvalidRequest = "invalid_request",
        /// A program of others returned no path.
        NotFound = "not_found",
        /// A program of others does not plan for such a request.
        Refused = "refused",
        /// A program of others is not installed.
        Unavailable = "unavailable",
        /// The process ended without an answer.
        #[default]
        Crashed = "crashed",
    }
}

impl RunStatus {
    /// True if a planner searched at all: it was there, and took the request.
    pub fn did_run(self) -> bool {
        !matches!(
            self,
            Self::Unavailable | Self::Refused | Self::InvalidRequest
        )
    }
}

impl From<Status> for RunStatus {
    fn from(status: Status) -> Self {
        let is_it = |known: &Self| known.name() == status.name();
        Self::ALL.into_iter().find(is_it).unwrap_or_default()
    }
}

impl Field for RunStatus {
    const EXPECTED: &str = "found, no_path, infeasible, budget_exhausted, timed_out, cancelled, \
                            invalid_request, not_found, refused, unavailable, crashed";

    fn read(text: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|status| status.name() == text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_ending_of_a_planner_is_a_status() {
        for status in [
            Status::Found,
            Status::NoPath,
            Status::Infeasible,
            Status::BudgetExhausted,
            Status::TimedOut,
            Status::Cancelled,
        ] {
            assert_eq!(RunStatus::from(status).name(), status.name());
        }
        let names: Vec<&str> = RunStatus::ALL.map(RunStatus::name).into();
        assert_eq!(names.join(", "), RunStatus::EXPECTED);
    }
}
