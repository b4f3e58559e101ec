//! Any map file to an occupancy grid.

use super::files::{MAX_MAP_BYTES, read_bytes};
use super::{FormatError, FormatProblem, GreyImage, RosMapDescription};
use crate::map::OccupancyGrid;
use std::path::Path;

/// What a map file may leave open.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ReadOptions {
    /// Side of a cell in metres, for formats that do not say: `MovingAI` maps and matrices (1 m
    /// unless given), TPCAP cases (0.1 m unless given), and images without a description (which
    /// need it).
    pub resolution_m: Option<f64>,
}

/// Reads a map.
///
/// `.yaml` and `.yml` are ROS maps, `.pgm` and `.png` bare images.
///
/// # Errors
/// A file that cannot be read or is wrong, or an unknown kind of file.
pub fn read_map(path: &Path, options: &ReadOptions) -> Result<OccupancyGrid, FormatError> {
    let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
    match extension.to_str() {
        Some("yaml" | "yml") => OccupancyGrid::read_ros_yaml(path),
        Some("pgm" | "png") => read_image(path, options),
        _ => Err(FormatError::from(FormatProblem::UnknownExtension {
            extension: extension.to_string_lossy().into_owned(),
            known: "yaml, yml, pgm, png",
        })
        .in_file(path)),
    }
}

fn read_image(path: &Path, options: &ReadOptions) -> Result<OccupancyGrid, FormatError> {
    let bytes = read_bytes(path, MAX_MAP_BYTES)?;
    let resolution_m = options.resolution_m.ok_or(FormatProblem::Missing {
        thing: "the resolution",
        hint: "an image alone does not say it: give it in metres per cell, or read the map's YAML",
    });
    resolution_m
        .map_err(FormatError::from)
        .and_then(|r| RosMapDescription::of_bare_image(r).to_grid(&GreyImage::from_bytes(&bytes)?))
        .map_err(|e| e.in_file(path))
}
