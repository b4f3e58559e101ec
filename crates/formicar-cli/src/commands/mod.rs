//! One file per verb.

mod check;
mod demo;
mod list;
mod meta;
mod plan;
mod stdin;

use crate::args::Command;
use crate::failure::{Ending, Failure};
use std::io::Write;

/// Carries out a command; `out` is stdout.
pub(crate) fn run(command: &Command, out: &mut impl Write) -> Result<Ending, Failure> {
    match command {
        Command::Demo(args) => demo::run(args, out),
        Command::Plan(args) => plan::run(args, out),
        Command::Check(args) => check::run(args, out),
        Command::List(args) => list::run(args, out),
        Command::Schema(args) => meta::schema(args, out),
        Command::Completions { shell } => meta::completions(*shell, out),
        Command::Man => meta::man(out),
    }
}
