//! Flags of `compare`.

use clap::{Args, ValueHint};
use std::path::PathBuf;

/// Flags of `compare`.
#[allow(clippy::struct_excessive_bools, reason = "each is a flag of its own")]
#[derive(Args, Debug)]
#[command(after_help = "\
Verdicts are on B: better, worse, no difference shown, or not comparable. Times and memory compare \
only where both sides name the same machine and the same kind of build; sides \
measured at different times still differ by how busy the machine was, so that the speed of builds \
is compared by --with.")]
pub(crate) struct CompareArgs {
    /// A store or a results.csv of `bench`, the one to be compared with; with --with a campaign file.
    #[arg(value_name = "A|CAMPAIGN.toml", value_hint = ValueHint::FilePath)]
    pub(crate) a: PathBuf,

    /// Another store or results.csv of the same scenarios.
    #[arg(value_name = "B", value_hint = ValueHint::FilePath,
          required_unless_present = "with", conflicts_with = "with")]
    pub(crate) b: Option<PathBuf>,

    /// Another build of formicar: every run of the campaign is done by both, one after the other,
    /// and the other build is A.
    #[arg(long, value_name = "PROGRAM", value_hint = ValueHint::ExecutablePath)]
    pub(crate) with: Option<PathBuf>,

    /// Leave times and memory out: compare only what is the same in every run of a build.
    #[arg(long)]
    pub(crate) results_only: bool,

    /// Exit code 3 where a metric is worse.
    #[arg(long)]
    pub(crate) fail_on_worse: bool,

    /// Exit code 3 where B does not solve a run that A solves.
    #[arg(long)]
    pub(crate) fail_on_lost: bool,

    /// Print the comparison as one JSON object.
    #[arg(long)]
    pub(crate) json: bool,

    /// Folder for the comparison as page, Markdown and LaTeX, and with --with for both tables.
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub(crate) out: Option<PathBuf>,
}
