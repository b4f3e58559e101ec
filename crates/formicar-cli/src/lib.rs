//! The command line of formicar: library calls from a terminal.
//!
//! [`run`] is the whole command. Front ends of other languages call what else is here, so that a
//! configuration, a vehicle or a campaign is read, and refused, in the same words everywhere.
//!
//! Exit codes: 0 success, 1 an internal failure, 2 wrong usage or input, 3 no feasible path, or
//! results that are worse than required.

mod ants;
mod bag;
mod cli;
mod commands;
mod failure;
mod files;
#[cfg(feature = "mapping")]
mod lidar;
mod mode_args;
mod motion_files;
mod optional;
mod output;
mod path_file;
mod picture;
pub mod reading;
mod scene;
mod session;
mod settings;
mod summary;
mod values;

use std::ffi::OsString;
use std::io::{BufWriter, Write};

/// Carries out a command, the first word being the name of the program, and returns its exit code.
pub fn run(words: impl IntoIterator<Item = OsString>) -> u8 {
    let cli = match cli::Cli::from_words(words) {
        Ok(cli) => cli,
        Err(message) => {
            // Help into a closed pipe is no failure.
            let _ = message.print();
            return u8::try_from(message.exit_code()).unwrap_or(2);
        }
    };
    let mut out = BufWriter::new(std::io::stdout().lock());
    let ending = cli.run(&mut out).and_then(|ending| {
        out.flush()?;
        Ok(ending)
    });
    ending.map_or_else(|failure| failure.explain(), u8::from)
}
