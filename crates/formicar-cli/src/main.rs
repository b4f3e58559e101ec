//! The command line of formicar: library calls from a terminal.
//!
//! Exit codes: 0 success, 1 an internal failure, 2 wrong usage or input, 3 no feasible path, or
//! results that are worse than required.

mod ants;
mod cli;
mod commands;
mod failure;
mod files;
#[cfg(feature = "mapping")]
mod lidar;
mod mode_args;
mod optional;
mod output;
mod path_file;
mod picture;
mod scene;
mod session;
mod settings;
mod summary;
mod values;

use std::io::{BufWriter, Write};
use std::process::ExitCode;

fn main() -> ExitCode {
    // The message of a panic is on stderr already.
    std::panic::catch_unwind(run).unwrap_or(ExitCode::from(1))
}

fn run() -> ExitCode {
    let cli = match cli::Cli::from_process() {
        Ok(cli) => cli,
        Err(message) => {
            // Help into a closed pipe is no failure.
            let _ = message.print();
            return ExitCode::from(u8::try_from(message.exit_code()).unwrap_or(2));
        }
    };
    let mut out = BufWriter::new(std::io::stdout().lock());
    let ending = cli.run(&mut out).and_then(|ending| {
        out.flush()?;
        Ok(ending)
    });
    ending.map_or_else(|failure| failure.explain(), ExitCode::from)
}
