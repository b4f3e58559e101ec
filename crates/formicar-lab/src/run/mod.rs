//! Runs of planners: what a run is told, how it is carried out and measured, and what is kept of
//! it.
//!
//! A [`Job`] says which planner is asked what. [`carry_out`] does it in this process, a
//! [`Program`] in one of its own. What comes out is a [`Run`].

mod barn;
mod columns;
mod evaluate;
mod in_process;
mod job;
mod measure;
mod ours;
pub mod pool;
mod process;
mod record;
mod scenario;
mod status;
mod table;
mod theirs;
pub mod usage;

pub use barn::{BARN_RESOLUTION_M, BARN_VEHICLE, BarnWorlds};
pub use evaluate::Evaluation;
pub use in_process::InProcess;
pub use job::{
    Contender, Job, Limits, OWN_VEHICLE, Place, RivalCommand, RunKey, Task, VehicleChoice,
};
pub use measure::{Improvement, Measured, TimedIteration, measure};
pub use ours::Begun;
pub use process::Program;
pub use record::{COLUMNS, History, ORIGIN_COLUMNS, Origin, Run, RunRecord};
pub use scenario::{BuiltinSources, LoadedScenario, Sources};
pub use status::RunStatus;
pub use table::{read_csv, to_csv};

pub(crate) use record::number;
pub(crate) use table::{read_torn_csv, record_line, records_csv};
pub(crate) use theirs::ask;

use anyhow::{Result, bail};

/// Carries out a job in this process.
///
/// # Errors
/// A scenario, a vehicle or parameters that cannot be read; a planner that cannot be asked is a
/// result.
pub fn carry_out(job: &Job, sources: &dyn Sources, begun: Begun) -> Result<Run> {
    if job.contender.is_in_process {
        bail!("the planner {:?} was not handed over", job.contender.name);
    }
    match &job.contender.rival {
        Some(command) => theirs::run(job, command, sources),
        None => ours::run(job, sources, begun),
    }
}
