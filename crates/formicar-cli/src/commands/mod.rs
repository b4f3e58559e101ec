//! One file per verb.

mod bench;
mod check;
mod compare;
mod demo;
mod import;
mod list;
mod machine;
mod map;
mod meta;
mod plan;
mod report;
mod reproduce;
mod results;
mod rival;
mod stdin;
mod stress;
mod studio;
mod subject;
mod track;
mod tune;

pub(crate) use bench::BenchArgs;
pub(crate) use compare::CompareArgs;
pub(crate) use import::ImportArgs;
pub(crate) use map::MapArgs;
pub(crate) use report::ReportArgs;
pub(crate) use reproduce::ReproduceArgs;
pub(crate) use rival::RivalPlanner;
pub(crate) use stress::StressArgs;
pub(crate) use studio::StudioArgs;
pub(crate) use track::TrackArgs;
pub(crate) use tune::TuneArgs;

use crate::args::Command;
use crate::failure::{Ending, Failure};
use std::io::Write;

/// Carries out a command; `out` is stdout.
pub(crate) fn run(command: &Command, out: &mut impl Write) -> Result<Ending, Failure> {
    match command {
        Command::Demo(args) => demo::run(args, out),
        Command::Plan(args) => plan::run(args, out),
        Command::Check(args) => check::run(args, out),
        Command::Track(args) => track::run(args, out),
        Command::Bench(args) => bench::run(args, out),
        Command::BenchRun { job } => bench::run_one(job, out),
        Command::Rival { planner } => rival::run(*planner, out),
        Command::RivalRun { words } => rival::replace(words),
        Command::Compare(args) => compare::run(args, out),
        Command::Import(args) => import::run(args, out),
        Command::Report(args) => report::run(args, out),
        Command::Reproduce(args) => reproduce::run(args, out),
        Command::Stress(args) => stress::run(args, out),
        Command::Studio(args) => studio::run(args),
        Command::Tune(args) => tune::run(args, out),
        Command::Map(args) => map::run(args, out),
        Command::List(args) => list::run(args, out),
        Command::Schema(args) => meta::schema(args, out),
        Command::Completions { shell } => meta::completions(*shell, out),
        Command::Man => meta::man(out),
    }
}
