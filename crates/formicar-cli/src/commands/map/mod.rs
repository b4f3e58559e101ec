//! `map`: describe, convert and generate maps; measure the passage between two points.

mod args;
mod clearance;
mod convert;
mod files;
mod generate;
mod info;

pub(crate) use args::MapArgs;

use crate::failure::{Ending, Failure};
use args::MapCommand;
use std::io::Write;

/// Carries out `map`.
pub(crate) fn run(args: &MapArgs, out: &mut impl Write) -> Result<Ending, Failure> {
    match &args.command {
        MapCommand::Info(args) => info::run(args, out),
        MapCommand::Convert(args) => convert::run(args, out),
        MapCommand::Generate(args) => generate::run(args, out),
        MapCommand::Clearance(args) => clearance::run(args, out),
    }
}
