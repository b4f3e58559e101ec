//! Flags of `plan`.

use super::motion::MotionArgs;
use crate::mode_args::ModeArgs;
use crate::scene::SceneArgs;
use crate::values::{self, Budget};
use clap::{Args, ValueHint};
use formicar::geometry::Pose2;
use formicar::path::Spacing;
use formicar::planner::PlannerName;
use formicar::scenario::{GoalTolerance, ViaPoint};
use std::path::PathBuf;

/// Flags of `plan`.
#[derive(Args, Debug)]
pub(crate) struct PlanArgs {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,

    /// Start pose in meters and radians (or 90deg).
    #[arg(long, value_name = "X,Y,H", value_parser = values::pose, allow_hyphen_values = true)]
    pub(crate) start: Option<Pose2>,

    /// Goal pose; repeat the flag for several, and the path ends at the nearest.
    #[arg(long, value_name = "X,Y,H", value_parser = values::pose, allow_hyphen_values = true)]
    pub(crate) goal: Vec<Pose2>,

    /// Point to pass on the way, with any heading or a given one; repeat for more, in order.
    #[arg(long, value_name = "X,Y[,H]", value_parser = values::via, allow_hyphen_values = true)]
    pub(crate) via: Vec<ViaPoint>,

    /// Tolerance at via points; 0.1,0.1 by default.
    #[arg(long, value_name = "M,RAD", requires = "via",
          value_parser = values::goal_tolerance, allow_hyphen_values = true)]
    pub(crate) via_tolerance: Option<GoalTolerance>,

    #[command(flatten)]
    pub(crate) modes: ModeArgs,

    /// From a start in contact with obstacles, drive out by the shortest way first, touching
    /// nothing else; the certified path begins where the vehicle is free.
    #[arg(long)]
    pub(crate) escape: bool,

    /// Limit how fast the curvature changes along the path, 1/m^2, instead of letting it jump from
    /// arc to arc; without a number, the vehicle's steering rate and speed give the limit.
    #[arg(long, value_name = "RATE", num_args = 0..=1, value_parser = values::number,
          allow_negative_numbers = true)]
    #[allow(
        clippy::option_option,
        reason = "the flag, and its number: clap's way to say it"
    )]
    pub(crate) continuous_curvature: Option<Option<f64>>,

    /// Tolerance at the goal; 0.01,0.01 by default.
    #[arg(long, value_name = "M,RAD", value_parser = values::goal_tolerance, allow_hyphen_values = true)]
    pub(crate) goal_tolerance: Option<GoalTolerance>,

    /// Map whose graded cells mark areas to avoid where possible, or `map` for the graded cells of
    /// the map itself. Used by formicar and hybrid-astar.
    #[arg(long, value_name = "F|map", value_hint = ValueHint::FilePath)]
    pub(crate) soft_costs: Option<String>,

    /// Weight of soft costs: a meter over the highest grade costs 1 + W; 3 by default.
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

    /// Threads that a colony may use; the result does not depend on it.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub(crate) threads: Option<u32>,

    /// Time limit, for instance 5s or 800ms; a bare number is milliseconds.
    #[arg(long, value_name = "TIME", value_parser = values::milliseconds, allow_hyphen_values = true)]
    pub(crate) deadline: Option<f64>,

    /// Limit of search steps, or `none`; by default 200000 for formicar and hybrid-astar, a few
    /// seconds, and none for others.
    #[arg(long, value_name = "STEPS|none", value_parser = values::budget, allow_hyphen_values = true)]
    pub(crate) budget: Option<Budget>,

    /// Write the answer (.json) or the poses of the path (.csv); may be repeated.
    #[arg(long, value_name = "F.json|F.csv", value_hint = ValueHint::FilePath, conflicts_with = "stdin")]
    pub(crate) out: Vec<PathBuf>,

    /// Most meters and radians (or 10deg) between two poses of the path; 0.1,0.2 by default. Both
    /// ends of every segment are always among them.
    #[arg(long, value_name = "M[,RAD]", value_parser = values::spacing, allow_hyphen_values = true)]
    pub(crate) spacing: Option<Spacing>,

    /// Write a picture.
    #[arg(long, value_name = "F.svg|F.png", value_hint = ValueHint::FilePath, conflicts_with = "stdin")]
    pub(crate) picture: Option<PathBuf>,

    /// Write how a colony found its path: pheromone, ants and convergence as a picture, or as a
    /// film (.gif).
    #[arg(long, value_name = "F.svg|F.png|F.gif", value_hint = ValueHint::FilePath, conflicts_with = "stdin")]
    pub(crate) ants: Option<PathBuf>,

    /// Record map, path, gears, and the vehicle on its drive as a bag of ROS 2, for `ros2 bag play`,
    /// Foxglove or Lichtblick.
    #[cfg(feature = "record")]
    #[arg(long, value_name = "F.mcap", value_hint = ValueHint::FilePath, conflicts_with = "stdin")]
    pub(crate) record: Option<PathBuf>,

    /// Print the answer as one JSON object.
    #[arg(long)]
    pub(crate) json: bool,

    /// Read one request per line (JSON, see `schema request`) and write one answer per line. The
    /// flags supply what a line leaves out.
    #[arg(long, conflicts_with = "json")]
    pub(crate) stdin: bool,

    // Last, since its heading is that of all flags after it.
    #[command(flatten)]
    pub(crate) motion: MotionArgs,
}
