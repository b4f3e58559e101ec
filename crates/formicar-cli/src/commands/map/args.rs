//! Flags of `map`.
#![allow(clippy::doc_markdown, reason = "clap prints these words as they stand")]

use crate::values;
use clap::{Args, Subcommand, ValueEnum, ValueHint};
use formicar::geometry::Point2;
use formicar::map::UnknownPolicy;
use std::path::PathBuf;

/// Flags of `map`.
#[derive(Args, Debug)]
pub(crate) struct MapArgs {
    #[command(subcommand)]
    pub(super) command: MapCommand,
}

/// What to do with maps.
#[derive(Debug, Subcommand)]
pub(super) enum MapCommand {
    /// Size, frame, cells, components and the widest place of a map.
    Info(InfoArgs),
    /// Write a map in another format: .yaml, .pgm, .png, .map, .txt or .csv.
    Convert(ConvertArgs),
    /// Make a map from a seed.
    Generate(GenerateArgs),
    /// The widest body that passes from one place to another; exit code 3 where none does.
    Clearance(ClearanceArgs),
}

/// A map, and how to read it.
#[derive(Args, Debug)]
pub(super) struct MapSource {
    /// Map file (ROS .yaml, MovingAI .map, .csv or .txt matrix, image) or name of a built-in map.
    #[arg(value_name = "F|NAME", value_hint = ValueHint::FilePath)]
    pub(super) map: String,

    /// Side of a cell, metres, for formats that do not say.
    #[arg(long, value_name = "M", value_parser = values::positive, allow_hyphen_values = true)]
    pub(super) resolution: Option<f64>,
}

/// Flags of `map info`.
#[derive(Args, Debug)]
pub(super) struct InfoArgs {
    #[command(flatten)]
    pub(super) source: MapSource,

    /// How unknown cells count for components and clearance.
    #[arg(long, value_name = "POLICY", default_value = "occupied",
          value_parser = values::word::<UnknownPolicy>(&["free", "occupied"]))]
    pub(super) unknown: UnknownPolicy,

    /// Print one JSON object.
    #[arg(long)]
    pub(super) json: bool,
}

/// Flags of `map convert`.
#[derive(Args, Debug)]
pub(super) struct ConvertArgs {
    #[command(flatten)]
    pub(super) source: MapSource,

    /// The file to write; its extension names the format.
    #[arg(value_name = "OUT", value_hint = ValueHint::FilePath)]
    pub(super) out: PathBuf,

    /// Decide unknown cells; they stay unknown without it.
    #[arg(long, value_name = "POLICY",
          value_parser = values::word::<UnknownPolicy>(&["free", "occupied"]))]
    pub(super) unknown: Option<UnknownPolicy>,

    /// Write formats that keep neither resolution nor origin, and do without these.
    #[arg(long)]
    pub(super) drop_frame: bool,
}

/// What can be generated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Kind {
    /// Blocks of houses, streets with parked cars, alleys of 2 to 4 m, dead ends, yards.
    Neighborhood,
    /// Rectangles anywhere.
    Scatter,
}

/// Flags of `map generate`.
#[derive(Args, Debug)]
pub(super) struct GenerateArgs {
    /// What to generate.
    pub(super) kind: Kind,

    /// Same seed, same map.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(super) seed: u64,

    /// Columns: 800 of a neighborhood, 200 of a scatter by default.
    #[arg(long, value_name = "N")]
    pub(super) width_cells: Option<usize>,

    /// Rows: 500 of a neighborhood, 200 of a scatter by default.
    #[arg(long, value_name = "N")]
    pub(super) height_cells: Option<usize>,

    /// Side of a cell, metres: 0.2 of a neighborhood, 0.1 of a scatter by default.
    #[arg(long, value_name = "M", value_parser = values::positive, allow_hyphen_values = true)]
    pub(super) resolution: Option<f64>,

    /// One more parameter, for instance dead_end_share=0.5; may be repeated.
    #[arg(long, value_name = "KEY=VALUE")]
    pub(super) set: Vec<String>,

    /// The file to write; its extension names the format.
    #[arg(long, value_name = "F", value_hint = ValueHint::FilePath)]
    pub(super) out: PathBuf,

    /// Write formats that keep neither resolution nor origin, and do without these.
    #[arg(long)]
    pub(super) drop_frame: bool,
}

/// Flags of `map clearance`.
#[derive(Args, Debug)]
pub(super) struct ClearanceArgs {
    #[command(flatten)]
    pub(super) source: MapSource,

    /// Where the way begins, metres.
    #[arg(long, value_name = "X,Y", value_parser = values::point, allow_hyphen_values = true)]
    pub(super) start: Point2,

    /// Where it ends.
    #[arg(long, value_name = "X,Y", value_parser = values::point, allow_hyphen_values = true)]
    pub(super) goal: Point2,

    /// How unknown cells count.
    #[arg(long, value_name = "POLICY", default_value = "occupied",
          value_parser = values::word::<UnknownPolicy>(&["free", "occupied"]))]
    pub(super) unknown: UnknownPolicy,

    /// Print one JSON object.
    #[arg(long)]
    pub(super) json: bool,
}
