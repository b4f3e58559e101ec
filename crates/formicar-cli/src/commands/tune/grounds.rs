//! From the words on the command line to scenarios that can be asked.

use super::TuneArgs;
use crate::commands::bench::Files;
use anyhow::{Context, Result, bail};
use formicar::scenario::Request;
use formicar_lab::campaign::{TaskSource, tasks_of};
use formicar_lab::papers::Ground;
use formicar_lab::run::{Sources, Task};
use formicar_lab::tuning::Asked;

/// All scenarios that the words name; each name once.
pub(super) fn asked(args: &TuneArgs, words: &[String]) -> Result<Vec<Asked>> {
    let mut all: Vec<Asked> = Vec::new();
    for word in words {
        for task in tasks_of(&TaskSource::of(word), &[args.planner], &Files)? {
            let name = &task.scenario;
            if all.iter().any(|asked| asked.ground.map == *name) {
                bail!("two scenarios are named {name:?}; hint: each once");
            }
            all.push(prepared(args, &task)?);
        }
    }
    Ok(all)
}

fn prepared(args: &TuneArgs, task: &Task) -> Result<Asked> {
    let name = || task.scenario.clone();
    let scenario = Files.load(task, None).with_context(name)?;
    let [start, goal] = scenario.ends(task).with_context(name)?;
    let whole = Request::new(start, goal);
    let request = Request {
        gears: args.modes.motion.unwrap_or(whole.gears),
        start_heading: args.modes.start_heading.unwrap_or(whole.start_heading),
        goal_heading: args.modes.goal_heading.unwrap_or(whole.goal_heading),
        budget_steps: Some(args.budget),
        ..whole
    };
    Ok(Asked::new(Ground {
        map: name(),
        grid: scenario.map,
        vehicle: scenario.vehicle,
        request,
    }))
}
