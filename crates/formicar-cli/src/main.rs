//! The command line of formicar: library calls from a terminal.
//!
//! Exit codes: 0 a feasible path (or a command without one that succeeded), 1 an internal
//! failure, 2 wrong usage or input, 3 finished without a feasible path, or with results that are
//! worse than asked for.

mod ants;
mod args;
mod clock;
mod commands;
mod failure;
mod files;
mod ground;
mod output;
mod picture;
mod settings;
mod soft_costs;
mod summary;
mod values;

use clap::Parser;
use std::io::{BufWriter, Write};
use std::process::ExitCode;

fn main() -> ExitCode {
    // A panic is a fault of ours: its message stands on stderr already.
    std::panic::catch_unwind(run).unwrap_or(ExitCode::from(1))
}

fn run() -> ExitCode {
    let cli = match args::Cli::try_parse() {
        Ok(cli) => cli,
        Err(message) => {
            // Help into a closed pipe is no failure.
            let _ = message.print();
            return ExitCode::from(u8::try_from(message.exit_code()).unwrap_or(2));
        }
    };
    let mut out = BufWriter::new(std::io::stdout().lock());
    let ending = commands::run(&cli.command, &mut out).and_then(|ending| {
        out.flush()?;
        Ok(ending)
    });
    ending.map_or_else(|failure| failure.explain(), ExitCode::from)
}
