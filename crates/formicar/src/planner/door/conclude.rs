//! From what a search found to a certified path with metrics, or to an explained failure.

use super::explain::explain;
use crate::metrics::{ClearanceSummary, PathMetrics};
use crate::path::CurvePath;
use crate::planner::{Ended, Found, Halt, NotFound, Outcome, Plan, PlanError, Task};
use crate::progress::{Limits, Status};
use crate::validation::{Certificate, Report, judge_while};

/// Lets the judge decide, and says why where there is no path.
pub(super) fn conclude(
    task: &Task,
    found: Result<Found, Halt>,
    limits: &mut Limits,
) -> Result<Outcome, PlanError> {
    let n_steps = limits.n_steps();
    let found = match found {
        Ok(found) => found,
        Err(halt) => {
            let failure = explained(task, halt.ended()?, limits);
            if failure.status != Status::Cancelled && limits.is_cancelled() {
                return Ok(cancelled(task, limits));
            }
            return Ok(Outcome::NotFound(Box::new(failure)));
        }
    };
    let Found {
        path,
        stages,
        cut_by,
    } = found;
    let car = (task.obstacles().as_ref(), task.vehicle());
    let goes_on = &mut || !limits.is_cancelled();
    let Some(report) = judge_while(car, task.request(), &path, goes_on) else {
        return Ok(cancelled(task, limits));
    };
    Ok(match report.certify() {
        Ok(certificate) => {
            limits.tell_improved(&path);
            let metrics = measured(task, &path, &certificate, limits);
            if limits.is_cancelled() {
                return Ok(cancelled(task, limits));
            }
            Outcome::Found(Box::new(Plan {
                planner: task.planner().to_owned(),
                seed: task.seed(),
                metrics,
                path,
                stages,
                certificate,
                n_steps,
                cut_by,
                escape: None,
            }))
        }
        Err(report) => {
            let reason = refusal(task, &report);
            Outcome::NotFound(Box::new(NotFound {
                stages,
                refused: Some((path, *report)),
                ..NotFound::new(Status::Infeasible, reason, n_steps)
            }))
        }
    })
}

/// The ending of a query that is cancelled while its result is judged or explained.
fn cancelled(task: &Task, limits: &mut Limits) -> Outcome {
    let failure = explained(task, Status::Cancelled.into(), limits);
    Outcome::NotFound(Box::new(failure))
}

/// The metrics of a certified path; of no use once the query is cancelled.
fn measured(
    task: &Task,
    path: &CurvePath,
    certificate: &Certificate,
    limits: &mut Limits,
) -> PathMetrics {
    let (obstacles, vehicle) = (task.obstacles(), task.vehicle());
    let (least_m, goes_on) = (certificate.min_clearance_m, &mut || !limits.is_cancelled());
    let clearance = ClearanceSummary::new_while((obstacles, vehicle), path, least_m, goes_on);
    let reached = task.request().reached_goal(vehicle.motion(), path.end());
    PathMetrics::new(path, vehicle, reached.goal, clearance).with_travel_time(path, vehicle)
}

/// The reason where the judge has refused a path.
fn refusal(task: &Task, report: &Report) -> String {
    let n = report.violations.len();
    let first = report
        .violations
        .first()
        .map_or(String::new(), |v| format!(": {}", v.message));
    format!(
        "the judge refused the path that {} found, {n} violation{}{first}",
        task.planner(),
        if n == 1 { "" } else { "s, first" }
    )
}

/// A search that ended without a path.
fn explained(task: &Task, ended: Ended, limits: &mut Limits) -> NotFound {
    let (reason, explanation) = match (ended.reason, ended.explanation) {
        (Some(reason), Some(explanation)) => (reason, *explanation),
        (reason, explanation) => {
            let (sentence, measured) = explain(task, ended.status, limits);
            let explanation = explanation.map_or(measured, |known| *known);
            (reason.unwrap_or(sentence), explanation)
        }
    };
    NotFound {
        explanation,
        stages: *ended.stages,
        ..NotFound::new(ended.status, reason, limits.n_steps())
    }
}
