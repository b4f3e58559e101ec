//! Two builds on one campaign, run by run in turns, so that whatever slows the machine down slows
//! both.

use crate::commands::bench::{campaign, execute, store};
use crate::commands::machine;
use anyhow::{Context, Result, bail};
use formicar_lab::analysis::compare::Side;
use formicar_lab::campaign::{Campaign, PlannedRun, Record};
use std::path::Path;
use std::process::Command;

/// The runs of another build and those of this one.
pub(super) fn sides(path: &Path, other: &Path) -> Result<[Side; 2]> {
    let campaign = campaign::read(path)?.campaign()?;
    let of_other = version(other)?;
    let this = execute::this_program()?;
    let mut sides = [side("other build"), side("this build")];
    fill(&campaign, [other, &this], &mut sides)?;
    for record in &mut sides[0].records {
        record.origin.set("version", &of_other);
    }
    Ok(sides)
}

fn side(name: &str) -> Side {
    Side {
        name: name.to_owned(),
        records: Vec::new(),
    }
}

/// The first run of a pair is in turns the one's and the other's.
fn fill(campaign: &Campaign, programs: [&Path; 2], sides: &mut [Side; 2]) -> Result<()> {
    let machine = machine::name();
    let bar = execute::progress_bar(2 * campaign.runs.len());
    for (place, run) in campaign.runs.iter().enumerate() {
        for turn in 0..2 {
            let who = (place + turn) % 2;
            let record = record(programs[who], run, &machine)?;
            sides[who].records.push(record);
            bar.inc(1);
        }
    }
    bar.finish_and_clear();
    Ok(())
}

fn record(program: &Path, run: &PlannedRun, machine: &str) -> Result<Record> {
    let over = execute::one(program, &run.job)?;
    let record = store::record(run, over, machine);
    let reason = record.get("reason");
    if record.get("status") == "crashed" && reason.contains("the run:") {
        bail!(
            "{}: it does not understand a run as this build describes it ({reason}); hint: a build \
             that is not so old",
            program.display()
        );
    }
    Ok(record)
}

/// What a program says that it is.
fn version(program: &Path) -> Result<String> {
    let name = || program.display().to_string();
    let output = Command::new(program).arg("--version").output();
    let output = output.with_context(name)?;
    let text = String::from_utf8_lossy(&output.stdout);
    match text.trim().strip_prefix("formicar ") {
        Some(version) if output.status.success() => Ok(version.to_owned()),
        _ => bail!("{}: it is no formicar; hint: --with PROGRAM", name()),
    }
}
