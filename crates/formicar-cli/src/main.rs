//! The program `formicar`.

use std::process::ExitCode;

fn main() -> ExitCode {
    // The message of a panic is on stderr already.
    let code = std::panic::catch_unwind(|| formicar_cli::run(std::env::args_os()));
    ExitCode::from(code.unwrap_or(1))
}
