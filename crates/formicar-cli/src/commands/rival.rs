//! Rivals that this program is itself, and what starts the others.

use crate::failure::{Ending, Failure};
use crate::files;
use crate::output::print_json;
use anyhow::{Context, anyhow};
use clap::ValueEnum;
use formicar_lab::rival::{Question, pathfinding_answer};
use formicar_lab::run::usage::end_with_parent;
use std::io::Write;
use std::path::Path;

/// Rivals that are crates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum RivalPlanner {
    /// A* of the crate `pathfinding`, over cells, for points.
    Pathfinding,
}

/// Answers the question on stdin.
pub(crate) fn run(planner: RivalPlanner, out: &mut impl Write) -> Result<Ending, Failure> {
    let text = files::read_document(Path::new("-"))?;
    let question: Question = serde_json::from_str(&text).context("the question")?;
    let answer = match planner {
        RivalPlanner::Pathfinding => pathfinding_answer(&question)?,
    };
    print_json(out, &answer)?;
    Ok(Ending::Done)
}

/// Becomes another program, which ends when the one that has started this one ends.
pub(crate) fn replace(words: &[String]) -> Result<Ending, Failure> {
    end_with_parent();
    let (program, arguments) = words.split_first().context("a program")?;
    let error = become_one(std::process::Command::new(program).args(arguments));
    Err(Failure::Input(anyhow!(
        "{program}: it cannot be started: {error}"
    )))
}

/// Returns where that fails, and nowhere else.
#[cfg(unix)]
fn become_one(command: &mut std::process::Command) -> std::io::Error {
    std::os::unix::process::CommandExt::exec(command)
}

/// Where no program becomes another one this program is not started.
#[cfg(not(unix))]
fn become_one(_: &mut std::process::Command) -> std::io::Error {
    std::io::ErrorKind::Unsupported.into()
}
