//! Flags that choose the map and the vehicle.

use crate::values;
use clap::{Args, ValueHint};
use formicar::geometry::Point2;
use formicar::map::UnknownPolicy;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// Flags for the map, the areas closed on it, and the vehicle.
#[derive(Args, Debug, Default)]
pub(crate) struct SceneArgs {
    /// Map file (ROS .yaml, Moving AI .map, .csv or .txt matrix), name of a built-in map, or a bag
    /// of ROS 2: F.mcap[:TOPIC][@TIME].
    #[arg(long, value_name = "F|NAME", value_hint = ValueHint::FilePath)]
    pub(crate) map: Option<String>,

    /// Scenario file: .json with map, start, goal and vehicle, or a TPCAP CaseN.csv.
    #[arg(long, value_name = "F", conflicts_with = "map", value_hint = ValueHint::FilePath)]
    pub(crate) scenario: Option<PathBuf>,

    /// Scenario of a .json file; not needed for a file with a single scenario.
    #[arg(long, requires = "scenario", conflicts_with = "map")]
    pub(crate) id: Option<String>,

    /// Request of a built-in map; the first by default.
    #[arg(long, value_name = "ID", requires = "map", conflicts_with = "scenario")]
    pub(crate) request: Option<String>,

    /// Cell size in meters, for TPCAP cases (0.1 by default) and matrices (1 by default).
    #[arg(long, value_name = "M", value_parser = values::positive, allow_hyphen_values = true)]
    pub(crate) resolution: Option<f64>,

    /// Treat unknown cells as free or as occupied.
    #[arg(long, value_name = "POLICY", default_value = "occupied",
          value_parser = values::word::<UnknownPolicy>(&["free", "occupied"]))]
    pub(crate) unknown: UnknownPolicy,

    /// Take a grey value (0 to 255) of the map's image as unknown, whatever its thresholds say;
    /// map savers write 205.
    #[arg(long, value_name = "GREY")]
    pub(crate) unknown_grey: Option<u8>,

    /// Keep-out area: "x,y x,y x,y", [[x, y], ...], or a map file whose occupied cells close
    /// ground, with its own origin and resolution; may be repeated.
    #[arg(long, value_name = "POLYGON|F", value_parser = parse_keep_out, allow_hyphen_values = true,
          value_hint = ValueHint::FilePath)]
    pub(crate) keep_out: Vec<KeepOut>,

    /// Built-in vehicle (see `list vehicles`) or a .toml or .json file; `warehouse_amr` by default.
    #[arg(long, value_name = "NAME|F")]
    pub(crate) vehicle: Option<String>,

    /// Safety margin around the vehicle, meters.
    #[arg(long, value_name = "M", value_parser = values::not_negative, allow_hyphen_values = true)]
    pub(crate) margin: Option<f64>,
}

/// Closed ground.
#[derive(Clone, Debug)]
pub(crate) enum KeepOut {
    /// The corners of an area.
    Area(Vec<Point2>),
    /// The occupied cells of a map.
    Map(PathBuf),
}

/// A file has letters beside those of numbers in its name, or an extension.
fn parse_keep_out(text: &str) -> Result<KeepOut, String> {
    let path = Path::new(text);
    if path.is_file() || path.extension().is_some_and(is_a_word) {
        return Ok(KeepOut::Map(path.to_owned()));
    }
    let area = values::polygon(text).map_err(|problem| {
        format!("{problem}; or name a map file, for instance keepout_mask.yaml")
    });
    area.map(KeepOut::Area)
}

/// Letters and digits, the first a letter: no decimals of a number.
fn is_a_word(extension: &OsStr) -> bool {
    let text = extension.to_string_lossy();
    text.starts_with(|c: char| c.is_ascii_alphabetic())
        && text.chars().all(|c| c.is_ascii_alphanumeric())
}
