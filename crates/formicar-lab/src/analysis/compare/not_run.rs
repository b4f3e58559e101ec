//! Runs that did not take place: they say nothing of how well a planner does.

use crate::campaign::Record;

/// The statuses of such runs: a program of others that is not installed, and requests that a
/// planner does not plan for.
const NOT_RUN: [&str; 3] = ["unavailable", "refused", "invalid_request"];

/// The status of a run that did not take place; none of one that did.
pub(crate) fn not_run(record: &Record) -> Option<&'static str> {
    let status = record.get("status");
    NOT_RUN.into_iter().find(|name| *name == status)
}

/// How many runs did not take place and why, in words; none where all did.
pub(crate) fn told_not_run(runs: &[&Record]) -> Option<String> {
    let told = NOT_RUN.into_iter().filter_map(|status| {
        let mut reasons = Vec::new();
        let of_status = runs.iter().filter(|run| not_run(run) == Some(status));
        let n = of_status.map(|run| reasons.push(run.get("reason"))).count();
        reasons.dedup();
        let words = status.replace('_', " ");
        match reasons[..] {
            [] => None,
            [""] => Some(format!("{n} ({words})")),
            [reason] => Some(format!("{n} ({words}: {reason})")),
            [reason, ..] => Some(format!("{n} ({words}, the first: {reason})")),
        }
    });
    let told: Vec<String> = told.collect();
    (!told.is_empty()).then(|| told.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn runs_that_did_not_take_place_are_told_with_their_reason() {
        let run = |status: &str, reason: &str| {
            let mut record = Record::default();
            record
                .row
                .fill(&json!({"status": status, "reason": reason}));
            record
        };
        let runs = [
            run("unavailable", "not installed"),
            run("no_path", "too narrow"),
            run("unavailable", "not installed"),
            run("invalid_request", "a point"),
            run("invalid_request", "a goal in an obstacle"),
        ];
        let runs: Vec<&Record> = runs.iter().collect();
        assert_eq!(
            told_not_run(&runs).unwrap(),
            "2 (unavailable: not installed), 2 (invalid request, the first: a point)"
        );
        assert_eq!(told_not_run(&runs[1..2]), None);
    }
}
