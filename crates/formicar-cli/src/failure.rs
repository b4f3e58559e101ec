//! The endings of a command and their exit codes.

use std::io::{self, Write};

/// The ending of a command that was carried out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(
    not(feature = "lab"),
    allow(dead_code, reason = "some endings are those of measurements")
)]
pub(crate) enum Ending {
    /// Success: a feasible path, if one was asked for.
    Done,
    /// The caller's fault, already reported in the answer.
    Refused,
    /// No feasible path.
    NoPath,
    /// Results that are worse than the ones they are compared with.
    Worse,
    /// A fault of the program, described in the report.
    Broken,
}

/// The exit code of an ending.
impl From<Ending> for u8 {
    fn from(ending: Ending) -> Self {
        match ending {
            Ending::Done => 0,
            Ending::Broken => 1,
            Ending::Refused => 2,
            Ending::NoPath | Ending::Worse => 3,
        }
    }
}

/// The reason why a command could not be carried out.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The caller's fault: wrong usage or input.
    Input(anyhow::Error),
    /// The output could not be written.
    Output(io::Error),
}

impl Failure {
    /// Prints the message on stderr and returns the exit code. A closed pipe is no failure.
    pub(crate) fn explain(&self) -> u8 {
        let (text, code) = match self {
            Self::Input(error) => (format!("error: {error:#}"), 2),
            Self::Output(error) if error.kind() == io::ErrorKind::BrokenPipe => {
                return 0;
            }
            Self::Output(error) => (format!("error: the output cannot be written: {error}"), 1),
        };
        note(&text);
        code
    }
}

impl From<anyhow::Error> for Failure {
    fn from(error: anyhow::Error) -> Self {
        Self::Input(error)
    }
}

/// Bare IO errors come from stdout only; those of files carry the file's name as `anyhow` errors.
impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Self::Output(error)
    }
}

/// Prints a line on stderr.
pub(crate) fn note(text: &str) {
    // Without a stderr nobody can read it.
    let _ = writeln!(io::stderr().lock(), "{text}");
}
