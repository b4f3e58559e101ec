//! A planner of your own in a campaign, beside built-in ones.
//!
//! `cargo run --release -p formicar-lab --example own_planner`
#![allow(clippy::print_stdout, reason = "an example talks to its reader")]

use formicar::geometry::reeds_shepp;
use formicar::planner::{Found, Halt, PathSearch, PlannerName, Task};
use formicar::progress::{Limits, Status};
use formicar_lab::analysis::report;
use formicar_lab::campaign::{self, CampaignSpec, Execution, MeasuredBy, TaskSource, tasks_of};
use formicar_lab::report::markdown;
use formicar_lab::run::{BuiltinSources, Contender, InProcess, Limits as RunLimits, Run};
use std::sync::Arc;

/// Drives the shortest curve to the goal and sees no obstacles; the judge does.
#[derive(Debug)]
struct ShortestCurve;

impl PathSearch for ShortestCurve {
    fn name(&self) -> &'static str {
        "shortest-curve"
    }

    fn find(&self, task: &mut Task<'_>, limits: &mut Limits<'_>) -> Result<Found, Halt> {
        limits.step()?;
        let ends = [task.request().start, task.request().goal];
        let [start, goal] = ends.map(|pose| task.to_grid(pose));
        let curve = reeds_shepp::shortest(start, goal, task.vehicle().min_turning_radius_m());
        let curve = curve.ok_or(Status::NoPath)?;
        Ok(task.driven(start, curve.arcs()))
    }
}

/// Both planners on two requests with two seeds.
pub(crate) fn runs() -> anyhow::Result<Vec<Run>> {
    let source = TaskSource::of("narrow-junction");
    let spec = CampaignSpec {
        tasks: tasks_of(&source, &[PlannerName::HybridAstar], &BuiltinSources)?,
        vehicles: vec![None],
        limits: vec![RunLimits::default()],
        contenders: vec![
            Contender::built_in(PlannerName::HybridAstar),
            Contender::in_process("shortest-curve"),
        ],
        seeds: vec![0, 1],
        ..CampaignSpec::default()
    };
    let in_process = InProcess::new(&BuiltinSources).with_search(Arc::new(ShortestCurve));
    let execution = Execution {
        carry_out: &|job| in_process.run(job),
        n_at_once: 2,
        measured_by: MeasuredBy::this_build("this machine"),
    };
    campaign::run(&spec.campaign(&BuiltinSources)?, &execution)
}

fn main() -> anyhow::Result<()> {
    println!("{}", markdown(&report("own planner", &runs()?)?));
    Ok(())
}
