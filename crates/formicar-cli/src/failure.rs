//! How a command ends, and the exit code of each ending.

use std::io::{self, Write};
use std::process::ExitCode;

/// How a command that could be carried out ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ending {
    /// A feasible path, or whatever was asked for.
    Done,
    /// The caller's fault, already told in the answer.
    Refused,
    /// No feasible path.
    NoPath,
    /// Results that are worse than those they are held against.
    Worse,
    /// Something that must not be: a fault of ours, told in the report.
    Broken,
}

impl From<Ending> for ExitCode {
    fn from(ending: Ending) -> Self {
        Self::from(match ending {
            Ending::Done => 0,
            Ending::Broken => 1,
            Ending::Refused => 2,
            Ending::NoPath | Ending::Worse => 3,
        })
    }
}

/// Why a command could not be carried out.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The caller's fault: what is wrong with usage or input.
    Input(anyhow::Error),
    /// The output could not be written.
    Output(io::Error),
}

impl Failure {
    /// Says on stderr what is wrong, and gives the exit code; a reader of stdout that has left
    /// early is no failure.
    pub(crate) fn explain(&self) -> ExitCode {
        let (text, code) = match self {
            Self::Input(error) => (format!("error: {error:#}"), 2),
            Self::Output(error) if error.kind() == io::ErrorKind::BrokenPipe => {
                return ExitCode::SUCCESS;
            }
            Self::Output(error) => (format!("error: the output cannot be written: {error}"), 1),
        };
        note(&text);
        ExitCode::from(code)
    }
}

impl From<anyhow::Error> for Failure {
    fn from(error: anyhow::Error) -> Self {
        Self::Input(error)
    }
}

/// Only writing to stdout hands over bare IO errors; files come with their names as `anyhow`.
impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Self::Output(error)
    }
}

/// A line on stderr.
pub(crate) fn note(text: &str) {
    // Without a stderr there is nobody to tell.
    let _ = writeln!(io::stderr().lock(), "{text}");
}
