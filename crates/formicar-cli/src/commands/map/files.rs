//! The map files that the commands of `map` read and write.

use super::args::MapSource;
use crate::scene::{self, Loaded, SceneArgs};
use anyhow::{Result, bail};
use formicar::map::OccupancyGrid;
use formicar::map::format::write_map;
use std::path::Path;

/// A map file or a built-in map, unchanged; its warnings go to stderr.
pub(super) fn read(source: &MapSource) -> Result<OccupancyGrid> {
    let loaded = load(source)?;
    loaded.note_warnings();
    Ok(loaded.map)
}

/// A map file or a built-in map, unchanged, with its warnings.
pub(super) fn load(source: &MapSource) -> Result<Loaded> {
    let args = SceneArgs {
        map: Some(source.map.clone()),
        resolution: source.resolution,
        unknown_grey: source.unknown_grey,
        ..SceneArgs::default()
    };
    scene::find(&args)
}

/// Permission to write a format without a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Frame {
    Keep,
    Drop,
}

/// Writes a map, unless part of it or another file would be lost.
pub(super) fn write(path: &Path, grid: &OccupancyGrid, frame: Frame) -> Result<()> {
    let extension = path.extension().and_then(|e| e.to_str());
    let extension = extension.unwrap_or_default().to_ascii_lowercase();
    if frame == Frame::Keep && ["map", "txt", "csv"].contains(&extension.as_str()) {
        let (resolution_m, origin) = (grid.frame().resolution_m(), grid.frame().origin());
        if resolution_m != 1.0 || [origin.x, origin.y, origin.heading] != [0.0; 3] {
            bail!(
                "{}: .{extension} keeps neither resolution ({resolution_m} m) nor origin ({}, {}, \
                 {}); hint: .yaml keeps both, --drop-frame does without",
                path.display(),
                origin.x,
                origin.y,
                origin.heading
            );
        }
    }
    let beside = match extension.as_str() {
        "yaml" | "yml" => Some(path.with_extension("pgm")),
        "pgm" | "png" => Some(path.with_extension("yaml")),
        _ => None,
    };
    if let Some(beside) = beside.filter(|beside| beside.exists() && !path.exists()) {
        bail!(
            "{} would be replaced, since a ROS map is an image and its description; hint: another \
             name than {}",
            beside.display(),
            path.display()
        );
    }
    Ok(write_map(path, grid)?)
}
