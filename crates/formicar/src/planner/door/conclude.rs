//! From what a search found to a certified path with metrics, or to an explained failure.

use super::explain::explain;
use crate::metrics::{ClearanceSummary, PathMetrics};
use crate::path::CurvePath;
use crate::planner::{Ended, Found, Halt, NotFound, Outcome, Plan, PlanError, Task};
use crate::progress::{Limits, Status};
use crate::validation::{Certificate, Report, judge};

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
            let failure = explained(task, halt.ended()?, n_steps);
            return Ok(Outcome::NotFound(Box::new(failure)));
        }
    };
    let Found {
        path,
        stages,
        cut_by,
    } = found;
    let report = judge(task.obstacles(), task.vehicle(), task.request(), &path);
    Ok(match report.certify() {
        Ok(certificate) => {
            limits.tell_improved(&path);
            Outcome::Found(Box::new(Plan {
                planner: task.planner().to_owned(),
                seed: task.seed(),
                metrics: measured(task, &path, &certificate),
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

fn measured(task: &Task, path: &CurvePath, certificate: &Certificate) -> PathMetrics {
    let (obstacles, vehicle) = (task.obstacles(), task.vehicle());
    let clearance = ClearanceSummary::new(obstacles, vehicle, path, certificate.min_clearance_m);
    let reached = task.request().reached_goal(vehicle.motion(), path.end());
    PathMetrics::new(path, vehicle, reached.goal, clearance)
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
fn explained(task: &Task, ended: Ended, n_steps: u64) -> NotFound {
    let (reason, explanation) = match (ended.reason, ended.explanation) {
        (Some(reason), Some(explanation)) => (reason, *explanation),
        (reason, explanation) => {
            let (sentence, measured) = explain(task, ended.status, n_steps);
            let explanation = explanation.map_or(measured, |known| *known);
            (reason.unwrap_or(sentence), explanation)
        }
    };
    NotFound {
        explanation,
        stages: *ended.stages,
        ..NotFound::new(ended.status, reason, n_steps)
    }
}
