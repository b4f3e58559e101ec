//! The plans of a slot: its prepared planner and its last plan.

use crate::maps::list;
use crate::plan_observer::cells;
use crate::planner_cache::PlannerCache;
use crate::protocol::{StagesRecord, Tightest};
use crate::scene::Scene;
use formicar::map::BitGrid;
use formicar::path::CurvePath;
use formicar::planner::{Answer, Outcome, Planner, PlannerConfig, Stages};
use formicar::progress::IterationRecord;

/// A slot of a session.
#[derive(Default)]
pub(crate) struct SlotState {
    pub(crate) planner: Option<Planner>,
    pub(crate) last: Option<FinishedPlan>,
}

/// A plan that has ended.
pub(crate) struct FinishedPlan {
    pub(crate) plan: u64,
    pub(crate) answer: Answer,
    /// None for a request that was refused.
    pub(crate) outcome: Option<Outcome>,
}

impl SlotState {
    /// The path of a plan.
    pub(crate) fn path(&self, plan: u64) -> Result<CurvePath, String> {
        let done = self.last.as_ref().filter(|done| done.plan == plan);
        let path = done.and_then(FinishedPlan::path).cloned();
        path.ok_or_else(|| {
            format!("previous: plan {plan} is not the last plan of its slot, or has no path")
        })
    }

    /// The planner of this slot; a change of parameters makes a new one.
    pub(crate) fn prepare(
        &mut self,
        scene: &Scene,
        config: PlannerConfig,
        cache: &PlannerCache,
    ) -> Result<&mut Planner, String> {
        let fits = |planner: &Planner| planner.config() == Some(&config);
        let kept = self.planner.take().filter(fits);
        let planner = kept.map_or_else(|| cache.planner(scene, config), Ok);
        Ok(self
            .planner
            .insert(planner.map_err(|error| error.to_string())?))
    }
}

impl FinishedPlan {
    /// The path, if there is one.
    pub(crate) fn path(&self) -> Option<&CurvePath> {
        match self.outcome.as_ref()? {
            Outcome::Found(plan) => Some(&plan.path),
            Outcome::NotFound(_) => None,
        }
    }

    /// The iterations of its ants or its population.
    pub(crate) fn history(&self) -> &[IterationRecord] {
        self.outcome
            .as_ref()
            .map_or(&[], |outcome| history(outcome.stages()))
    }

    /// The intermediate results, as messages have them.
    pub(crate) fn stages_record(&self) -> StagesRecord {
        let stages = self.outcome.as_ref().map(Outcome::stages);
        stages.map_or_else(StagesRecord::default, stages_record)
    }

    /// The pose with the least clearance, and the nearest point of an obstacle.
    pub(crate) fn tightest(&self, scene: &Scene) -> Option<Tightest> {
        let (_, report) = self.outcome.as_ref()?.judged()?;
        let contact = scene.obstacles.contact(&scene.vehicle, report.tightest);
        Some(Tightest {
            x: contact.x,
            y: contact.y,
            clearance_m: report.min_clearance_m,
            pose: list(report.tightest),
        })
    }
}

fn history(stages: &Stages) -> &[IterationRecord] {
    let colony = stages.colony.as_ref().map(|run| &run.history);
    let history = colony.or(stages.evolution.as_ref().map(|run| &run.history));
    history.map_or(&[], |history| &history.iterations)
}

fn stages_record(stages: &Stages) -> StagesRecord {
    let set = |set: &BitGrid| set.iter().flat_map(|cell| [cell.col, cell.row]).collect();
    let layers = stages.layers.as_ref();
    StagesRecord {
        expanded: layers.map(|layers| set(&layers.expanded)),
        closed: layers.map(|layers| set(&layers.closed)),
        grid_path: stages.grid_path.as_ref().map(|path| cells(&path.cells)),
        nodes: (!stages.nodes.is_empty()).then(|| cells(&stages.nodes)),
    }
}
