//! Runs that did not take place, which say nothing about a planner.

use crate::run::{Run, RunStatus};

/// The statuses of such runs: a program of others that is not installed, and requests that a
/// planner does not plan for.
const NOT_RUN: [RunStatus; 3] = [
    RunStatus::Unavailable,
    RunStatus::Refused,
    RunStatus::InvalidRequest,
];

/// The status of a run that did not take place; none of one that did.
pub(crate) fn not_run(run: &Run) -> Option<RunStatus> {
    Some(run.record.status).filter(|status| NOT_RUN.contains(status))
}

/// The number of runs that did not take place and the reasons, in words; none where all did.
pub(crate) fn describe_not_run(runs: &[&Run]) -> Option<String> {
    let parts = NOT_RUN.into_iter().filter_map(|status| {
        let mut reasons = Vec::new();
        let of_status = runs.iter().filter(|run| run.record.status == status);
        let n = of_status
            .map(|run| reasons.push(run.record.reason.as_str()))
            .count();
        reasons.dedup();
        let words = status.name().replace('_', " ");
        match reasons[..] {
            [] => None,
            [""] => Some(format!("{n} ({words})")),
            [reason] => Some(format!("{n} ({words}: {reason})")),
            [reason, ..] => Some(format!("{n} ({words}, the first: {reason})")),
        }
    });
    let parts: Vec<String> = parts.collect();
    (!parts.is_empty()).then(|| parts.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::RunRecord;

    #[test]
    fn runs_that_did_not_take_place_are_told_with_their_reason() {
        let run = |status: RunStatus, reason: &str| Run {
            record: RunRecord {
                status,
                reason: reason.to_owned(),
                ..RunRecord::default()
            },
            ..Run::default()
        };
        let runs = [
            run(RunStatus::Unavailable, "not installed"),
            run(RunStatus::NoPath, "too narrow"),
            run(RunStatus::Unavailable, "not installed"),
            run(RunStatus::InvalidRequest, "a point"),
            run(RunStatus::InvalidRequest, "a goal in an obstacle"),
        ];
        let runs: Vec<&Run> = runs.iter().collect();
        assert_eq!(
            describe_not_run(&runs).unwrap(),
            "2 (unavailable: not installed), 2 (invalid request, the first: a point)"
        );
        assert_eq!(describe_not_run(&runs[1..2]), None);
    }
}
