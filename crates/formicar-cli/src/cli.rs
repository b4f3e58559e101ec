//! The command line: its commands, and the one that runs.

#[cfg(feature = "drive")]
use crate::commands::drive;
#[cfg(feature = "mapping")]
use crate::commands::locate;
#[cfg(feature = "studio")]
use crate::commands::studio;
#[cfg(feature = "lab")]
use crate::commands::{bench, compare, demo, import, report, reproduce, rival, stress, tune};
use crate::commands::{check, list, map, meta, plan, track};
use crate::failure::{Ending, Failure};
use crate::optional;
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use std::ffi::OsString;
use std::io::Write;

const EXIT_CODES: &str = "\
Exit codes: 0 feasible path, 1 internal failure, 2 wrong usage or input, 3 no feasible path.
Poses are those of the rear-axle center: x forward, y left, heading counter-clockwise.";

/// Path planning for car-like robots: drivable, certified paths, or the reason why there is none.
#[derive(Debug, Parser)]
#[command(name = "formicar", version, max_term_width = 100)]
pub(crate) struct Cli {
    #[command(subcommand)]
    command: Command,
}

impl Cli {
    /// Parses the words of a command, the first being the name of the program.
    ///
    /// # Errors
    /// Wrong usage, or a request for help or the version: the message to print.
    pub(crate) fn from_words(
        words: impl IntoIterator<Item = OsString>,
    ) -> Result<Self, clap::Error> {
        let mut definition = Self::definition();
        let matches = definition.try_get_matches_from_mut(words);
        let parsed = matches.and_then(|matches| Self::from_arg_matches(&matches));
        parsed.map_err(|error| optional::explain(error.format(&mut definition)))
    }

    /// The commands and flags, with the help that stands below them.
    fn definition() -> clap::Command {
        Self::command().after_help(format!("{EXIT_CODES}{}", optional::note()))
    }

    /// Carries out the command; `out` is stdout.
    pub(crate) fn run(&self, out: &mut impl Write) -> Result<Ending, Failure> {
        match &self.command {
            #[cfg(feature = "lab")]
            Command::Demo(args) => demo::run(args, out),
            Command::Plan(args) => plan::run(args, out),
            Command::Check(args) => check::run(args, out),
            Command::Track(args) => track::run(args, out),
            #[cfg(feature = "drive")]
            Command::Drive(args) => drive::run(args, out),
            #[cfg(feature = "lab")]
            Command::Bench(args) => bench::run(args, out),
            #[cfg(feature = "lab")]
            Command::BenchRun { job } => bench::run_one(job, out),
            #[cfg(feature = "lab")]
            Command::Rival { planner } => rival::run(*planner, out),
            #[cfg(feature = "lab")]
            Command::RivalRun { words } => rival::replace(words),
            #[cfg(feature = "lab")]
            Command::Compare(args) => compare::run(args, out),
            #[cfg(feature = "lab")]
            Command::Import(args) => import::run(args, out),
            #[cfg(feature = "lab")]
            Command::Report(args) => report::run(args, out),
            #[cfg(feature = "lab")]
            Command::Reproduce(args) => reproduce::run(args, out),
            #[cfg(feature = "lab")]
            Command::Stress(args) => stress::run(args, out),
            #[cfg(feature = "studio")]
            Command::Studio(args) => studio::run(args),
            #[cfg(feature = "lab")]
            Command::Tune(args) => tune::run(args, out),
            Command::Map(args) => map::run(args, out),
            #[cfg(feature = "mapping")]
            Command::Locate(args) => locate::run(args, out),
            Command::List(args) => list::run(args, out),
            Command::Schema(args) => meta::schema(args, out),
            Command::Completions { shell } => meta::completions(*shell, Self::definition(), out),
            Command::Man => meta::man(Self::definition(), out),
        }
    }
}

/// The commands.
#[derive(Debug, Subcommand)]
enum Command {
    /// Plan on the built-in maps: a table here, pictures and a page in a folder.
    #[cfg(feature = "lab")]
    Demo(demo::DemoArgs),
    /// Plan a path that the vehicle can drive.
    Plan(Box<plan::PlanArgs>),
    /// Judge a path of any origin; exit code 3 if the vehicle cannot drive it.
    Check(check::CheckArgs),
    /// Drive a path in simulation; exit code 3 if the vehicle collides or does not arrive.
    Track(Box<track::TrackArgs>),
    /// Drive a robot through a simulated world, which it senses; exit code 3 if it collides or does
    /// not arrive.
    #[cfg(feature = "drive")]
    Drive(Box<drive::DriveArgs>),
    /// Run planners on scenarios, or a whole campaign, one process per run: results and a summary.
    #[cfg(feature = "lab")]
    Bench(Box<bench::BenchArgs>),
    /// Compare two stores of results, or two builds: a verdict per metric.
    #[cfg(feature = "lab")]
    Compare(compare::CompareArgs),
    /// Judge files of other planners, and add them to a table of results.
    #[cfg(feature = "lab")]
    Import(Box<import::ImportArgs>),
    /// Turn stores of results into a page with tables, CSV and LaTeX.
    #[cfg(feature = "lab")]
    Report(report::ReportArgs),
    /// Repeat the experiments of a paper: tables beside its own.
    #[cfg(feature = "lab")]
    Reproduce(reproduce::ReproduceArgs),
    /// Test a planner on random scenarios; exit code 1 if anything is violated.
    #[cfg(feature = "lab")]
    Stress(stress::StressArgs),
    /// Search for better parameters of a planner on some scenarios, and test them on others.
    #[cfg(feature = "lab")]
    Tune(Box<tune::TuneArgs>),
    /// Serve a page on this machine: watch the ants, edit the map, drive the path.
    #[cfg(feature = "studio")]
    Studio(studio::StudioArgs),
    /// Build maps from lidar logs; describe, convert and generate maps; measure passages.
    Map(Box<map::MapArgs>),
    /// Find a robot in a map, scan after scan; exit code 3 if it is lost most of the time.
    #[cfg(feature = "mapping")]
    Locate(locate::LocateArgs),
    /// List planners, built-in vehicles and maps, or the scenarios of a file.
    List(list::ListArgs),
    /// Print the JSON schema of a document.
    Schema(meta::SchemaArgs),
    /// Print the completions of a shell.
    Completions {
        /// The shell.
        shell: clap_complete::Shell,
    },
    /// Print the manual page.
    Man,
    /// One run of `bench`, which starts this itself.
    #[cfg(feature = "lab")]
    #[command(hide = true)]
    BenchRun {
        /// The run, as JSON.
        job: String,
    },
    /// Answer a question of the rival protocol from stdin.
    #[cfg(feature = "lab")]
    #[command(hide = true)]
    Rival {
        /// The planner.
        planner: rival::RivalPlanner,
    },
    /// Become a program that ends with the one that has started it.
    #[cfg(feature = "lab")]
    #[command(hide = true)]
    RivalRun {
        /// The program and its arguments.
        #[arg(required = true, trailing_var_arg = true, allow_hyphen_values = true)]
        words: Vec<String>,
    },
}
