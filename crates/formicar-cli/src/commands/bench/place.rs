//! What a run stands on, and what it asks.

use crate::scene::Scene;
use crate::scene::SceneArgs;
use anyhow::{Context, Result};
use formicar::geometry::Pose2;
use formicar::map::Cell;
use formicar::planner::RequestDocument;
use formicar_lab::campaign::{Job, Place, Task};

/// What `plan` would be told of the ground of a scenario.
pub(in crate::commands) fn ground_args(task: &Task, vehicle: Option<&str>) -> SceneArgs {
    let blank = SceneArgs {
        vehicle: vehicle.map(str::to_owned),
        ..SceneArgs::default()
    };
    match &task.place {
        Place::File {
            path,
            id,
            resolution_m,
        } => SceneArgs {
            scenario: Some(path.clone()),
            id: id.clone(),
            resolution: *resolution_m,
            ..blank
        },
        Place::Builtin { map, request } => SceneArgs {
            map: Some(map.clone()),
            request: Some(request.clone()),
            ..blank
        },
        Place::Cells { map, .. } => SceneArgs {
            map: Some(map.display().to_string()),
            vehicle: Some(vehicle.unwrap_or("point").to_owned()),
            ..blank
        },
    }
}

/// Start and goal of a scenario, on its ground.
pub(super) fn ends(task: &Task, ground: &Scene) -> Result<[Pose2; 2]> {
    let center =
        |[col, row]: [u32; 2]| Pose2::at(ground.map.frame().center(Cell::new(col, row)), 0.0);
    match task.place {
        Place::Cells { start, goal, .. } => Ok([center(start), center(goal)]),
        _ => ground.ends.context("the scenario has no start and goal"),
    }
}

/// The request of a run, on its ground.
pub(super) fn request(job: &Job, ground: &Scene) -> Result<RequestDocument> {
    let [start, goal] = ends(&job.task, ground)?;
    let list = |pose: Pose2| Some([pose.x, pose.y, pose.heading]);
    Ok(RequestDocument {
        start: list(start),
        goal: list(goal),
        motion: job.limits.motion,
        deadline_ms: job.limits.deadline_ms,
        budget_steps: job.limits.budget_steps,
        ..RequestDocument::default()
    })
}
