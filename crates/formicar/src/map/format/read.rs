//! Any map file to an occupancy grid.

use super::files::{MAX_MAP_BYTES, read_bytes, text};
use super::{
    FormatError, FormatProblem, GreyImage, RosMapDescription, TpcapCase, parse_matrix,
    parse_movingai_map, tpcap,
};
use crate::map::OccupancyGrid;
use std::path::Path;

/// Resolution of a TPCAP case where none is given, metres per cell.
const DEFAULT_TPCAP_RESOLUTION_M: f64 = 0.1;

/// Settings that a map file may leave open.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ReadOptions {
    /// Side of a cell in metres, for formats that do not say: `MovingAI` maps and matrices (1 m
    /// unless given), TPCAP cases (0.1 m unless given), and images without a description (which
    /// need it). A ROS map says its own; another one here is an error.
    pub resolution_m: Option<f64>,
}

/// Reads a map.
///
/// `.yaml` and `.yml` are ROS maps; `.pgm` and `.png` bare images, read with the map saver's
/// thresholds; `.map` is `MovingAI`; `.txt` and `.csv` are 0/1 matrices, TPCAP cases, or
/// `MovingAI` maps by what they hold. Other names are read if the first bytes are those of a PGM,
/// a PNG or a `MovingAI` map.
///
/// # Errors
/// A file that cannot be read or is wrong, or an unknown kind of file.
pub fn read_map(path: &Path, options: &ReadOptions) -> Result<OccupancyGrid, FormatError> {
    let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
    if matches!(extension.to_str(), Some("yaml" | "yml")) {
        let grid = OccupancyGrid::read_ros_yaml(path)?;
        return check_resolution(grid, options).map_err(|e| e.in_file(path));
    }
    let bytes = read_bytes(path, MAX_MAP_BYTES)?;
    map_from_bytes(path, &bytes, options)
}

/// Reads the bytes of a map file that stands alone: any that [`read_map`] knows but a ROS map,
/// whose YAML names an image.
///
/// # Errors
/// As [`read_map`]; of a ROS map, that its kind of file is unknown.
pub fn map_from_bytes(
    path: &Path,
    bytes: &[u8],
    options: &ReadOptions,
) -> Result<OccupancyGrid, FormatError> {
    let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
    let grid = match extension.to_str() {
        Some("pgm" | "png") => image(bytes, options),
        Some("map" | "txt" | "csv") => text(bytes, "a map as text").and_then(|text| {
            let movingai = extension == "map" || text.starts_with("type ");
            text_map(text, movingai, options)
        }),
        _ => by_content(bytes, &extension.to_string_lossy(), options),
    };
    grid.map_err(|e| e.in_file(path))
}

fn text_map(
    text: &str,
    movingai: bool,
    options: &ReadOptions,
) -> Result<OccupancyGrid, FormatError> {
    let resolution_m = options.resolution_m.unwrap_or(1.0);
    if movingai {
        return parse_movingai_map(text, resolution_m);
    }
    if tpcap::is_tpcap(text) {
        let resolution_m = options.resolution_m.unwrap_or(DEFAULT_TPCAP_RESOLUTION_M);
        return TpcapCase::parse(text)?.rasterize(resolution_m);
    }
    parse_matrix(text, resolution_m)
}

fn image(bytes: &[u8], options: &ReadOptions) -> Result<OccupancyGrid, FormatError> {
    let resolution_m = options.resolution_m.ok_or(FormatProblem::Missing {
        thing: "the resolution",
        hint: "an image alone does not say it: give it in metres per cell, or read the map's YAML",
    })?;
    RosMapDescription::of_bare_image(resolution_m).to_grid(&GreyImage::from_bytes(bytes)?)
}

fn by_content(
    bytes: &[u8],
    extension: &str,
    options: &ReadOptions,
) -> Result<OccupancyGrid, FormatError> {
    match bytes {
        [b'P', b'2' | b'5', ..] | [0x89, b'P', b'N', b'G', ..] => image(bytes, options),
        [b't', b'y', b'p', b'e', b' ', ..] => {
            text_map(text(bytes, "a MovingAI map")?, true, options)
        }
        _ => Err(FormatProblem::UnknownExtension {
            extension: extension.to_owned(),
            known: "yaml, yml, pgm, png, map, txt, csv",
        }
        .into()),
    }
}

fn check_resolution(
    grid: OccupancyGrid,
    options: &ReadOptions,
) -> Result<OccupancyGrid, FormatError> {
    let own = grid.frame().resolution_m();
    match options.resolution_m {
        Some(given) if given != own => {
            let expected = format!("{own}, as the map says; hint: leave it out");
            Err(FormatProblem::bad_value("the resolution asked for", given, expected).into())
        }
        _ => Ok(grid),
    }
}
