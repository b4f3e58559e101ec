//! One run: what a parent tells the process that does it.

use super::BenchArgs;
use super::suite::{Place, Task};
use super::variant::Variant;
use crate::args::GroundArgs;
use crate::ground::Ground;
use anyhow::{Context, Result};
use formicar::geometry::Pose2;
use formicar::map::Cell;
use formicar::planner::{PlannerName, RequestDocument};
use formicar::scenario::MotionMode;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Scenario, planner and seed: what tells runs apart.
pub(super) type Key = (String, String, u64);

/// One run.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Job {
    pub(super) task: Task,
    pub(super) planner: PlannerName,
    /// What it goes by: the planner, or a variant of it.
    pub(super) name: String,
    pub(super) seed: u64,
    motion: Option<MotionMode>,
    budget_steps: Option<u64>,
    deadline_ms: Option<f64>,
    pub(super) set: Vec<String>,
    /// Whether the first asking counts.
    pub(super) is_cold: bool,
    /// Where the answer is kept.
    pub(super) answer: Option<PathBuf>,
}

impl Job {
    pub(super) fn new(args: &BenchArgs, task: Task, variant: &Variant, seed: u64) -> Self {
        let file = format!("{}.{}.{seed}.json", task.scenario, variant.name);
        let answer = args.paths.then(|| args.out.join("paths").join(file));
        Self {
            task,
            planner: variant.planner,
            name: variant.name.clone(),
            seed,
            motion: args.motion,
            budget_steps: args.budget,
            deadline_ms: args.deadline,
            set: variant.set.clone(),
            is_cold: args.cold,
            answer,
        }
    }

    pub(super) fn key(&self) -> Key {
        (self.task.scenario.clone(), self.name.clone(), self.seed)
    }

    /// What `plan` would be told of the ground.
    pub(super) fn ground(&self) -> GroundArgs {
        let blank = GroundArgs::default();
        match &self.task.place {
            Place::File { path, id } => GroundArgs {
                scenario: Some(path.clone()),
                id: id.clone(),
                ..blank
            },
            Place::Builtin { map, request } => GroundArgs {
                map: Some(map.clone()),
                request: Some(request.clone()),
                ..blank
            },
            Place::Cells { map, .. } => GroundArgs {
                map: Some(map.display().to_string()),
                vehicle: Some("point".to_owned()),
                ..blank
            },
        }
    }

    /// The request, on its ground.
    pub(super) fn request(&self, ground: &Ground) -> Result<RequestDocument> {
        let center =
            |[col, row]: [u32; 2]| Pose2::at(ground.map.frame().center(Cell::new(col, row)), 0.0);
        let [start, goal] = match self.task.place {
            Place::Cells { start, goal, .. } => [center(start), center(goal)],
            _ => ground.ends.context("the scenario has no start and goal")?,
        };
        let list = |pose: Pose2| Some([pose.x, pose.y, pose.heading]);
        Ok(RequestDocument {
            start: list(start),
            goal: list(goal),
            motion: self.motion,
            deadline_ms: self.deadline_ms,
            budget_steps: self.budget_steps,
            ..RequestDocument::default()
        })
    }
}
