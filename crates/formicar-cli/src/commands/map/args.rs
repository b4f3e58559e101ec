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

/// The commands of `map`.
#[derive(Debug, Subcommand)]
pub(super) enum MapCommand {
    /// Build a map from lidar logs: signed distances, closed loops, and a report.
    #[cfg(feature = "mapping")]
    Build(super::build::BuildArgs),
    /// Judge a map by a lidar log: beams against cells, poses against reference or relations.
    #[cfg(feature = "mapping")]
    Evaluate(super::evaluate::EvaluateArgs),
    /// Print size, frame, cells, components and the point with the most clearance.
    Info(InfoArgs),
    /// Write a map in another format: .yaml, .pgm, .png, .map, .txt or .csv.
    Convert(ConvertArgs),
    /// Generate a map from a seed.
    Generate(GenerateArgs),
    /// Measure the widest body that passes between two points; exit code 3 if none does.
    Clearance(ClearanceArgs),
}

/// A map and its cell size.
#[derive(Args, Debug)]
pub(super) struct MapSource {
    /// Map file (ROS .yaml, MovingAI .map, .csv or .txt matrix, image), name of a built-in map, or a
    /// bag of ROS 2: F.mcap[:TOPIC][@TIME].
    #[arg(value_name = "F|NAME", value_hint = ValueHint::FilePath)]
    pub(super) map: String,

    /// Cell size in meters, for formats that do not hold it.
    #[arg(long, value_name = "M", value_parser = values::positive, allow_hyphen_values = true)]
    pub(super) resolution: Option<f64>,

    /// Take a grey value (0 to 255) of the map's image as unknown, whatever its thresholds say;
    /// map savers write 205.
    #[arg(long, value_name = "GREY")]
    pub(super) unknown_grey: Option<u8>,
}

/// Flags of `map info`.
#[derive(Args, Debug)]
pub(super) struct InfoArgs {
    #[command(flatten)]
    pub(super) source: MapSource,

    /// Treat unknown cells as free or as occupied, for components and clearance.
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

    /// Make unknown cells free or occupied; without it they stay unknown.
    #[arg(long, value_name = "POLICY",
          value_parser = values::word::<UnknownPolicy>(&["free", "occupied"]))]
    pub(super) unknown: Option<UnknownPolicy>,

    /// Allow formats that keep neither resolution nor origin.
    #[arg(long)]
    pub(super) drop_frame: bool,
}

/// The kinds of generated maps.
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
    /// The kind of map.
    pub(super) kind: Kind,

    /// Same seed, same map.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(super) seed: u64,

    /// Columns: 800 for a neighborhood, 200 for a scatter by default.
    #[arg(long, value_name = "N")]
    pub(super) width_cells: Option<usize>,

    /// Rows: 500 for a neighborhood, 200 for a scatter by default.
    #[arg(long, value_name = "N")]
    pub(super) height_cells: Option<usize>,

    /// Cell size, meters: 0.2 for a neighborhood, 0.1 for a scatter by default.
    #[arg(long, value_name = "M", value_parser = values::positive, allow_hyphen_values = true)]
    pub(super) resolution: Option<f64>,

    /// One more parameter, for instance dead_end_share=0.5; may be repeated.
    #[arg(long, value_name = "KEY=VALUE")]
    pub(super) set: Vec<String>,

    /// The file to write; its extension names the format.
    #[arg(long, value_name = "F", value_hint = ValueHint::FilePath)]
    pub(super) out: PathBuf,

    /// Allow formats that keep neither resolution nor origin.
    #[arg(long)]
    pub(super) drop_frame: bool,
}

/// Flags of `map clearance`.
#[derive(Args, Debug)]
pub(super) struct ClearanceArgs {
    #[command(flatten)]
    pub(super) source: MapSource,

    /// Start of the passage, meters.
    #[arg(long, value_name = "X,Y", value_parser = values::point, allow_hyphen_values = true)]
    pub(super) start: Point2,

    /// End of the passage.
    #[arg(long, value_name = "X,Y", value_parser = values::point, allow_hyphen_values = true)]
    pub(super) goal: Point2,

    /// Treat unknown cells as free or as occupied.
    #[arg(long, value_name = "POLICY", default_value = "occupied",
          value_parser = values::word::<UnknownPolicy>(&["free", "occupied"]))]
    pub(super) unknown: UnknownPolicy,

    /// Print one JSON object.
    #[arg(long)]
    pub(super) json: bool,
}
