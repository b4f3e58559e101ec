//! Flags of `map build`.
#![allow(clippy::doc_markdown, reason = "clap prints these words as they stand")]

use crate::lidar::LogArgs;
use crate::values;
use clap::{Args, ValueEnum, ValueHint};
use formicar::Pose2;
use std::path::PathBuf;

/// Flags of `map build`.
#[derive(Args, Debug)]
#[command(after_help = "\
Logs are bags of ROS 2 in MCAP (LaserScan, Odometry, tf), or files in the format of CARMEN (FLASER, \
ROBOTLASER1, RAWLASER1, ODOM), also packed as .gz. \
The poses are those of the laser; the first one is the origin of the map. Ctrl-C ends the search \
in order: with --session, the same command goes on where it ended. The session is also the most \
exact map for `locate`.")]
pub(crate) struct BuildArgs {
    /// Lidar logs, in the order of the drives. Each but the first begins where --start says or
    /// where its scans are found in the map so far.
    #[arg(required = true, value_name = "LOG", value_hint = ValueHint::FilePath)]
    pub(super) logs: Vec<PathBuf>,

    /// The map to write: .yaml or .pgm, with the other file beside it.
    #[arg(long, value_name = "MAP", value_hint = ValueHint::FilePath)]
    pub(super) out: PathBuf,

    /// Write the pose at every scan: .csv, or .tum in the format of the TUM benchmarks.
    #[arg(long, value_name = "F", value_hint = ValueHint::FilePath)]
    pub(super) trajectory: Option<PathBuf>,

    /// Keep all that is needed to go on with other logs, in this file; go on with it where it
    /// exists.
    #[arg(long, value_name = "F", value_hint = ValueHint::FilePath)]
    pub(super) session: Option<PathBuf>,

    #[command(flatten)]
    pub(super) how: LogArgs,

    /// Side of a cell, meters: 0.05 by default.
    #[arg(long, value_name = "M", value_parser = values::positive)]
    pub(super) resolution: Option<f64>,

    /// Leave every N-th scan out, and judge the map by it.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..))]
    pub(super) hold_out: Option<u32>,

    /// Write a page, a picture as SVG and PNG, and the report as JSON into this folder.
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub(super) report: Option<PathBuf>,

    /// Start of the first log that follows a session: a pose in its map, found by its scans
    /// otherwise.
    #[arg(long, value_name = "X,Y,H", value_parser = values::pose, allow_hyphen_values = true)]
    pub(super) start: Option<Pose2>,

    /// Longer ranges are not used, meters: 40 by default.
    #[arg(long, value_name = "M", value_parser = values::positive)]
    pub(super) max_range: Option<f64>,

    /// The map's update.
    #[arg(long, value_name = "NAME", default_value = "formicar")]
    pub(super) preset: Preset,

    /// Print the report as one JSON object.
    #[arg(long)]
    pub(super) json: bool,
}

/// Sets of parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Preset {
    /// Wedges between beams, weighted means.
    Formicar,
    /// Regression lines in dual cells with the priority of rings (Fossel, Tuyls & Sturm 2015).
    Fossel2015,
}
