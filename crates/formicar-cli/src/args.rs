//! Commands and flags.

use crate::commands::{
    BenchArgs, CompareArgs, ImportArgs, MapArgs, ReportArgs, ReproduceArgs, RivalPlanner,
    StressArgs, StudioArgs, TrackArgs, TuneArgs,
};
use crate::values;
use clap::{Args, Parser, Subcommand, ValueEnum, ValueHint};
use formicar::geometry::{Point2, Pose2};
use formicar::map::UnknownPolicy;
use formicar::planner::PlannerName;
use formicar::scenario::{GoalHeading, GoalTolerance, MotionMode, StartHeading, ViaPoint};
use std::path::PathBuf;

/// Path planning for car-like robots: drivable paths with a certificate, or the reason why not.
#[derive(Debug, Parser)]
#[command(name = "formicar", version, max_term_width = 100)]
#[command(after_help = "\
Exit codes: 0 feasible path, 1 internal failure, 2 wrong usage or input, 3 no feasible path.
Poses are those of the rear-axle center: x forward, y left, heading counter-clockwise.")]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Plan on the built-in maps: a table here, pictures and a page in a folder.
    Demo(DemoArgs),
    /// Plan a path that the vehicle can drive.
    Plan(Box<PlanArgs>),
    /// Judge a path, ours or foreign; exit code 3 where it cannot be driven.
    Check(CheckArgs),
    /// Drive a path in simulation; exit code 3 where the vehicle collides or does not arrive.
    Track(Box<TrackArgs>),
    /// Run planners on scenarios, or a whole campaign, one process per run: results and a summary.
    Bench(Box<BenchArgs>),
    /// Compare two stores of results, or two builds: a verdict per metric.
    Compare(CompareArgs),
    /// Judge files of other planners, and add them to a table of results.
    Import(Box<ImportArgs>),
    /// Turn stores of results into a page with tables, CSV and LaTeX.
    Report(ReportArgs),
    /// Repeat the experiments of a paper: tables beside its own.
    Reproduce(ReproduceArgs),
    /// Put a planner to the test on random scenarios; exit code 1 where anything is violated.
    Stress(StressArgs),
    /// Look for better parameters of a planner on scenarios; try them on others.
    Tune(Box<TuneArgs>),
    /// Serve a page on this machine: see the ants, touch the map, drive the path.
    Studio(StudioArgs),
    /// Describe, convert and generate maps; measure the way between two places.
    Map(MapArgs),
    /// List planners, built-in vehicles and maps, or the scenarios of a file.
    List(ListArgs),
    /// Print the JSON schema of a document.
    Schema(SchemaArgs),
    /// Print the completions of a shell.
    Completions {
        /// The shell.
        shell: clap_complete::Shell,
    },
    /// Print the manual page.
    Man,
    /// One run of `bench`; it starts this by itself.
    #[command(hide = true)]
    BenchRun {
        /// The run, as JSON.
        job: String,
    },
    /// Answer a question of the protocol of rivals from stdin.
    #[command(hide = true)]
    Rival {
        /// By which planner.
        planner: RivalPlanner,
    },
    /// Become a program that ends with the one that has started it.
    #[command(hide = true)]
    RivalRun {
        /// The program and its arguments.
        #[arg(required = true, trailing_var_arg = true, allow_hyphen_values = true)]
        words: Vec<String>,
    },
}

/// The ground: a map, and what closes parts of it; the vehicle on it.
#[derive(Args, Debug, Default)]
pub(crate) struct GroundArgs {
    /// Map file (ROS .yaml, Moving AI .map, .csv or .txt matrix) or name of a built-in map.
    #[arg(long, value_name = "F|NAME", value_hint = ValueHint::FilePath)]
    pub(crate) map: Option<String>,

    /// Scenario file: .json with map, start, goal and vehicle, or a TPCAP CaseN.csv.
    #[arg(long, value_name = "F", conflicts_with = "map", value_hint = ValueHint::FilePath)]
    pub(crate) scenario: Option<PathBuf>,

    /// Which scenario of a .json file; may be left out where there is one.
    #[arg(long, requires = "scenario", conflicts_with = "map")]
    pub(crate) id: Option<String>,

    /// Which request of a built-in map; its first by default.
    #[arg(long, value_name = "ID", requires = "map", conflicts_with = "scenario")]
    pub(crate) request: Option<String>,

    /// Side of a cell, for TPCAP cases (0.1 m by default) and for matrices (1 m by default).
    #[arg(long, value_name = "M", value_parser = values::positive, allow_hyphen_values = true)]
    pub(crate) resolution: Option<f64>,

    /// How unknown cells count.
    #[arg(long, value_name = "POLICY", default_value = "occupied",
          value_parser = values::word::<UnknownPolicy>(&["free", "occupied"]))]
    pub(crate) unknown: UnknownPolicy,

    /// Area closed for the vehicle: "x,y x,y x,y" or [[x, y], ...]; may be repeated.
    #[arg(long, value_name = "POLYGON", value_parser = parse_polygon, allow_hyphen_values = true)]
    pub(crate) keep_out: Vec<Polygon>,

    /// Built-in vehicle (see `list vehicles`) or a .toml or .json file; `warehouse_amr` by default.
    #[arg(long, value_name = "NAME|F")]
    pub(crate) vehicle: Option<String>,

    /// Safety margin that grows the vehicle on every side, metres.
    #[arg(long, value_name = "M", value_parser = values::not_negative, allow_hyphen_values = true)]
    pub(crate) margin: Option<f64>,
}

/// Corners of an area. (A type of its own: clap takes a bare `Vec` for a repeated flag.)
#[derive(Clone, Debug)]
pub(crate) struct Polygon(pub(crate) Vec<Point2>);

fn parse_polygon(text: &str) -> Result<Polygon, String> {
    values::polygon(text).map(Polygon)
}

/// Flags of `demo`.
#[derive(Args, Debug)]
pub(crate) struct DemoArgs {
    /// Folder of the page, made where it does not exist; files of an earlier demo are replaced.
    #[arg(long, value_name = "DIR", default_value = "./formicar-demo", value_hint = ValueHint::DirPath)]
    pub(crate) out: PathBuf,

    /// Only runs whose name holds this word; may be repeated.
    #[arg(long, value_name = "WORD", hide = true)]
    pub(crate) only: Vec<String>,
}

/// How a request may be driven; whatever is not given is that of the library.
#[derive(Args, Clone, Copy, Debug, Default)]
pub(crate) struct Modes {
    /// Which gears may be used; `reverse` allows both and penalizes reverse.
    #[arg(long, value_name = "MODE",
          value_parser = values::word::<MotionMode>(&["forward", "reverse"]))]
    pub(crate) motion: Option<MotionMode>,

    /// Whether the start heading is fixed.
    #[arg(long, value_name = "MODE",
          value_parser = values::word::<StartHeading>(&["exact", "any"]))]
    pub(crate) start_heading: Option<StartHeading>,

    /// Whether the goal heading is fixed; `bidirectional` allows the opposite one too.
    #[arg(long, value_name = "MODE",
          value_parser = values::word::<GoalHeading>(&["exact", "bidirectional", "any"]))]
    pub(crate) goal_heading: Option<GoalHeading>,
}

/// Flags of `plan`.
#[derive(Args, Debug)]
pub(crate) struct PlanArgs {
    #[command(flatten)]
    pub(crate) ground: GroundArgs,

    /// Start pose in metres and radians (or 90deg).
    #[arg(long, value_name = "X,Y,H", value_parser = values::pose, allow_hyphen_values = true)]
    pub(crate) start: Option<Pose2>,

    /// Goal pose; of several, the flag repeated, the path ends at whichever is nearest.
    #[arg(long, value_name = "X,Y,H", value_parser = values::pose, allow_hyphen_values = true)]
    pub(crate) goal: Vec<Pose2>,

    /// Place to pass on the way, with any heading or a given one; repeated for more, in order.
    #[arg(long, value_name = "X,Y[,H]", value_parser = values::via, allow_hyphen_values = true)]
    pub(crate) via: Vec<ViaPoint>,

    /// How far off the path may pass by via points; 0.1,0.1 by default.
    #[arg(long, value_name = "M,RAD", requires = "via",
          value_parser = values::goal_tolerance, allow_hyphen_values = true)]
    pub(crate) via_tolerance: Option<GoalTolerance>,

    #[command(flatten)]
    pub(crate) modes: Modes,

    /// Let the curvature change at most so fast along the way, 1/m^2, instead of jumping from arc to
    /// arc; without a number as fast as the vehicle's steering rate allows at its speed.
    #[arg(long, value_name = "RATE", num_args = 0..=1, value_parser = values::number,
          allow_negative_numbers = true)]
    #[allow(
        clippy::option_option,
        reason = "the flag, and its number: clap's way to say it"
    )]
    pub(crate) continuous_curvature: Option<Option<f64>>,

    /// How far from the goal the path may end; 0.01,0.01 by default.
    #[arg(long, value_name = "M,RAD", value_parser = values::goal_tolerance, allow_hyphen_values = true)]
    pub(crate) goal_tolerance: Option<GoalTolerance>,

    /// Map whose graded cells tell where the vehicle should rather not drive, or `map`: the map
    /// itself. A preference only; formicar and hybrid-astar heed it.
    #[arg(long, value_name = "F|map", value_hint = ValueHint::FilePath)]
    pub(crate) soft_costs: Option<String>,

    /// What soft costs weigh: ground of the highest grade costs 1 + W per metre; 3 by default.
    #[arg(long, value_name = "W", requires = "soft_costs",
          value_parser = values::not_negative, allow_hyphen_values = true)]
    pub(crate) soft_weight: Option<f64>,

    /// Planner (see `list planners`); `formicar` by default, `astar` for a point.
    #[arg(long, value_name = "NAME")]
    pub(crate) planner: Option<PlannerName>,

    /// Planner parameters as TOML (see `schema config`).
    #[arg(long, value_name = "F.toml", value_hint = ValueHint::FilePath)]
    pub(crate) config: Option<PathBuf>,

    /// One planner parameter, for instance `hybrid_astar.weight=1.2`; may be repeated.
    #[arg(long, value_name = "KEY=VALUE")]
    pub(crate) set: Vec<String>,

    /// Seed of the run: same seed, same path.
    #[arg(
        long,
        value_name = "N",
        default_value_t = 0,
        allow_hyphen_values = true
    )]
    pub(crate) seed: u64,

    /// Most threads to use; the result never depends on it. Colonies use them.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub(crate) threads: Option<u32>,

    /// Time after which to give up, milliseconds.
    #[arg(long, value_name = "MS", value_parser = values::positive, allow_hyphen_values = true)]
    pub(crate) deadline: Option<f64>,

    /// Search steps after which to give up.
    #[arg(long, value_name = "STEPS", allow_hyphen_values = true)]
    pub(crate) budget: Option<u64>,

    /// Write the answer (.json) or the poses of the path (.csv).
    #[arg(long, value_name = "F.json|F.csv", value_hint = ValueHint::FilePath, conflicts_with = "stdin")]
    pub(crate) out: Option<PathBuf>,

    /// Write a picture.
    #[arg(long, value_name = "F.svg|F.png", value_hint = ValueHint::FilePath, conflicts_with = "stdin")]
    pub(crate) picture: Option<PathBuf>,

    /// Write how a colony found its way: pheromone, ants and convergence as a picture, or as a film
    /// (.gif).
    #[arg(long, value_name = "F.svg|F.png|F.gif", value_hint = ValueHint::FilePath, conflicts_with = "stdin")]
    pub(crate) ants: Option<PathBuf>,

    /// Print the answer as one JSON object.
    #[arg(long)]
    pub(crate) json: bool,

    /// Read one request per line (JSON, see `schema request`), write one answer per line. What a
    /// line leaves out is taken from the flags.
    #[arg(long, conflicts_with = "json")]
    pub(crate) stdin: bool,
}

/// Flags of `check`.
#[derive(Args, Debug)]
pub(crate) struct CheckArgs {
    /// The path: an answer of `plan` (.json), or a CSV of x, y[, heading] in metres and radians;
    /// `-` reads it from stdin.
    #[arg(value_name = "PATH", value_hint = ValueHint::FilePath)]
    pub(crate) path: PathBuf,

    #[command(flatten)]
    pub(crate) ground: GroundArgs,

    /// Print the report as one JSON object.
    #[arg(long)]
    pub(crate) json: bool,
}

/// Flags of `list`.
#[derive(Args, Debug)]
pub(crate) struct ListArgs {
    /// What to list.
    pub(crate) what: Listing,
    /// Scenario file, for `scenarios`; the requests of the built-in maps without one.
    #[arg(value_hint = ValueHint::FilePath)]
    pub(crate) file: Option<PathBuf>,
}

/// What can be listed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Listing {
    /// Planners.
    Planners,
    /// Built-in vehicles.
    Vehicles,
    /// Built-in maps.
    Maps,
    /// Requests of the built-in maps, or the scenarios of a file.
    Scenarios,
}

/// Flags of `schema`.
#[derive(Args, Debug)]
pub(crate) struct SchemaArgs {
    /// Which document.
    #[arg(default_value = "config")]
    pub(crate) document: Document,
}

/// Documents with a schema.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Document {
    /// Planner parameters: `plan --config`, `plan --set`.
    Config,
    /// A vehicle file: `--vehicle`.
    Vehicle,
    /// A line of `plan --stdin`.
    Request,
    /// What `plan --json` prints.
    Answer,
    /// What `track --json` prints.
    Track,
}
