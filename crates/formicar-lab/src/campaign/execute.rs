//! Carrying out a campaign.

use super::plan::{Campaign, PlannedRun};
use super::sink::Sink;
use crate::run::{Job, Origin, Program, Run, RunStatus, pool};
use anyhow::{Result, bail};

/// The program and the machine that measure runs.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MeasuredBy {
    /// Version of the program.
    pub version: String,
    /// Its build: `debug` or `release`.
    pub build: String,
    /// The machine in a line.
    pub machine: String,
}

impl MeasuredBy {
    /// This build, on a machine.
    pub fn this_build(machine: &str) -> Self {
        let build = if cfg!(debug_assertions) {
            "debug"
        } else {
            "release"
        };
        Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            build: build.to_owned(),
            machine: machine.to_owned(),
        }
    }

    /// The origin of a run that it has measured.
    pub fn origin(&self, run: &PlannedRun) -> Origin {
        let limits = &run.job.limits;
        Origin {
            vehicle: run.job.vehicle_name().to_owned(),
            motion: run.job.motion_name().to_owned(),
            budget_steps: limits.budget_steps,
            deadline_ms: limits.deadline_ms,
            cold: Some(limits.is_cold),
            version: self.version.clone(),
            build: self.build.clone(),
            machine: self.machine.clone(),
            config_hash: run.config_hash.clone(),
            map_hash: run.map_hash.clone(),
            vehicle_hash: run.vehicle_hash.clone(),
            run: run.key.clone(),
        }
    }
}

/// The way in which runs are carried out.
pub struct Execution<'a> {
    /// Carries out one run.
    pub carry_out: &'a (dyn Fn(&Job) -> Result<Run> + Sync),
    /// Runs at once. Results do not depend on it; times do.
    pub n_at_once: u32,
    /// The program and the machine.
    pub measured_by: MeasuredBy,
}

/// Carries out all runs of a campaign in memory.
///
/// # Errors
/// The first run that cannot be carried out.
pub fn run(campaign: &Campaign, execution: &Execution) -> Result<Vec<Run>> {
    let mut runs = vec![None; campaign.runs.len()];
    run_into(campaign, &mut runs, execution, &mut || ())?;
    Ok(runs.into_iter().flatten().collect())
}

/// Carries out the runs of a campaign that a sink has not taken yet, and returns their number;
/// `on_done` hears of each.
///
/// # Errors
/// The first run that cannot be carried out, and a sink that fails.
pub fn run_into(
    campaign: &Campaign,
    sink: &mut dyn Sink,
    execution: &Execution,
    on_done: &mut dyn FnMut(),
) -> Result<usize> {
    let missing = sink.missing()?;
    let carry_out = |i: usize| (execution.carry_out)(&campaign.runs[missing[i]].job);
    pool::each(
        execution.n_at_once as usize,
        missing.len(),
        carry_out,
        |i, run| {
            let index = missing[i];
            let origin = execution.measured_by.origin(&campaign.runs[index]);
            sink.add(index, &Run { origin, ..run? })?;
            on_done();
            anyhow::Ok(())
        },
    )?;
    Ok(missing.len())
}

/// Runs a campaign with two builds in turns, so that whatever slows the machine down slows both.
/// The first run of a pair is in turns the one's and the other's.
///
/// # Errors
/// A program that is no formicar, or that does not understand the runs.
pub fn run_in_turns(
    campaign: &Campaign,
    programs: [&Program; 2],
    machine: &str,
    on_done: &mut dyn FnMut(),
) -> Result<[Vec<Run>; 2]> {
    let measured_by = programs.map(|program| -> Result<MeasuredBy> {
        Ok(MeasuredBy {
            version: program.version()?,
            ..MeasuredBy::this_build(machine)
        })
    });
    let [first, second] = measured_by;
    let measured_by = [first?, second?];
    let mut sides = [Vec::new(), Vec::new()];
    for (place, planned) in campaign.runs.iter().enumerate() {
        for turn in 0..2 {
            let who = (place + turn) % 2;
            let run = programs[who].run(&planned.job)?;
            let record = &run.record;
            if record.status == RunStatus::Crashed && record.reason.contains("the run:") {
                bail!(
                    "{}: it does not understand a run as this build describes it ({}); hint: a \
                     build that is not so old",
                    programs[who].path().display(),
                    record.reason
                );
            }
            let origin = measured_by[who].origin(planned);
            sides[who].push(Run { origin, ..run });
            on_done();
        }
    }
    Ok(sides)
}
