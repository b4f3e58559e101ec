//! `map`: build maps from lidar logs; describe, convert and generate maps; measure the passage
//! between two points.

mod args;
#[cfg(feature = "mapping")]
mod build;
mod clearance;
mod convert;
#[cfg(feature = "mapping")]
mod evaluate;
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
        #[cfg(feature = "mapping")]
        MapCommand::Build(args) => build::run(args, out),
        #[cfg(feature = "mapping")]
        MapCommand::Evaluate(args) => evaluate::run(args, out),
        MapCommand::Info(args) => info::run(args, out),
        MapCommand::Convert(args) => convert::run(args, out),
        MapCommand::Generate(args) => generate::run(args, out),
        MapCommand::Clearance(args) => clearance::run(args, out),
    }
}
