//! Any map file to an occupancy grid.

use super::files::{MAX_MAP_BYTES, read_bytes, text};
use super::ros_grid::read_ros_map;
use super::{
    FormatError, FormatProblem, GreyImage, MapFile, RosMapDescription, TpcapCase, parse_matrix,
    parse_movingai_map, tpcap,
};
use crate::map::OccupancyGrid;
use std::path::Path;

/// Resolution of a TPCAP case where none is given, meters per cell.
const DEFAULT_TPCAP_RESOLUTION_M: f64 = 0.1;

/// Settings that a map file may leave open.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ReadOptions {
    /// Side of a cell in meters, for formats that do not say: `MovingAI` maps and matrices (1 m
    /// unless given), TPCAP cases (0.1 m unless given), and images without a description (which
    /// need it). A ROS map says its own; another one here is an error.
    pub resolution_m: Option<f64>,
    /// A grey value, of 0 to 255, that stands for unknown cells of images whatever the thresholds
    /// say; only images have grey values.
    pub unknown_grey: Option<u8>,
}

/// Reads a map.
///
/// `.yaml` and `.yml` are ROS maps; `.pgm`, `.png` and `.bmp` bare images, read with the map saver's
/// thresholds; `.map` is `MovingAI`; `.txt` and `.csv` are 0/1 matrices, TPCAP cases, or
/// `MovingAI` maps by what they hold. Other names are read if the first bytes are those of a PGM,
/// a PNG, a BMP or a `MovingAI` map.
///
/// Warnings about the file are left out; [`MapFile::read`] has them.
///
/// # Errors
/// A file that cannot be read or is wrong, or an unknown kind of file.
pub fn read_map(path: &Path, options: &ReadOptions) -> Result<OccupancyGrid, FormatError> {
    Ok(MapFile::read(path, options)?.grid)
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
    Ok(MapFile::from_bytes(path, bytes, options)?.grid)
}

impl MapFile {
    /// Reads a map as [`read_map`] does, with warnings.
    ///
    /// # Errors
    /// As [`read_map`].
    pub fn read(path: &Path, options: &ReadOptions) -> Result<Self, FormatError> {
        let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
        if matches!(extension.to_str(), Some("yaml" | "yml")) {
            let map = read_ros_map(path, options.unknown_grey)?;
            return check_resolution(map, options).map_err(|e| e.in_file(path));
        }
        let bytes = read_bytes(path, MAX_MAP_BYTES)?;
        Self::from_bytes(path, &bytes, options)
    }

    /// Reads the bytes of a map file as [`map_from_bytes`] does, with warnings.
    ///
    /// # Errors
    /// As [`map_from_bytes`].
    pub fn from_bytes(
        path: &Path,
        bytes: &[u8],
        options: &ReadOptions,
    ) -> Result<Self, FormatError> {
        let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
        let map = match extension.to_str() {
            Some("pgm" | "png" | "bmp") => image(bytes, options),
            Some("map" | "txt" | "csv") => text(bytes, "a map as text").and_then(|text| {
                let movingai = extension == "map" || text.starts_with("type ");
                without_greys(text_map(text, movingai, options)?, options)
            }),
            _ => by_content(bytes, &extension.to_string_lossy(), options),
        };
        map.map_err(|e| e.in_file(path))
    }
}

/// The map of a file without grey values, where none was asked for.
fn without_greys(grid: OccupancyGrid, options: &ReadOptions) -> Result<MapFile, FormatError> {
    if let Some(grey) = options.unknown_grey {
        let expected = "left out for this file, which holds no grey values";
        return Err(FormatProblem::bad_value("the grey of unknown cells", grey, expected).into());
    }
    Ok(MapFile {
        grid,
        warnings: Vec::new(),
    })
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

fn image(bytes: &[u8], options: &ReadOptions) -> Result<MapFile, FormatError> {
    let resolution_m = options.resolution_m.ok_or(FormatProblem::Missing {
        thing: "the resolution",
        hint: "an image alone does not say it: give it in meters per cell, or read the map's YAML",
    })?;
    let description = RosMapDescription::of_bare_image(resolution_m);
    description.to_map_file(&GreyImage::from_bytes(bytes)?, options.unknown_grey)
}

fn by_content(
    bytes: &[u8],
    extension: &str,
    options: &ReadOptions,
) -> Result<MapFile, FormatError> {
    match bytes {
        [b'P', b'2' | b'5', ..] | [0x89, b'P', b'N', b'G', ..] | [b'B', b'M', ..] => {
            image(bytes, options)
        }
        [b't', b'y', b'p', b'e', b' ', ..] => {
            let grid = text_map(text(bytes, "a MovingAI map")?, true, options)?;
            without_greys(grid, options)
        }
        _ => Err(FormatProblem::UnknownExtension {
            extension: extension.to_owned(),
            known: "yaml, yml, pgm, png, bmp, map, txt, csv",
        }
        .into()),
    }
}

fn check_resolution(map: MapFile, options: &ReadOptions) -> Result<MapFile, FormatError> {
    let own = map.grid.frame().resolution_m();
    match options.resolution_m {
        Some(given) if given != own => {
            let expected = format!("{own}, as the map says; hint: leave it out");
            Err(FormatProblem::bad_value("the resolution asked for", given, expected).into())
        }
        _ => Ok(map),
    }
}
