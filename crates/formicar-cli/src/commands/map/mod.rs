//! `map`: describe, convert and generate maps; measure the way between two places.

mod args;
mod clearance;
mod convert;
mod generate;
mod info;

pub(crate) use args::MapArgs;

use crate::args::GroundArgs;
use crate::failure::{Ending, Failure};
use crate::ground;
use anyhow::{Result, bail};
use args::{MapCommand, MapSource};
use formicar::map::OccupancyGrid;
use formicar::map::format::write_map;
use std::io::Write;
use std::path::Path;

/// Carries out `map`.
pub(crate) fn run(args: &MapArgs, out: &mut impl Write) -> Result<Ending, Failure> {
    match &args.command {
        MapCommand::Info(args) => info::run(args, out),
        MapCommand::Convert(args) => convert::run(args, out),
        MapCommand::Generate(args) => generate::run(args, out),
        MapCommand::Clearance(args) => clearance::run(args, out),
    }
}

/// A map file or a built-in map, as it is.
fn read(source: &MapSource) -> Result<OccupancyGrid> {
    let args = GroundArgs {
        map: Some(source.map.clone()),
        resolution: source.resolution,
        ..GroundArgs::default()
    };
    Ok(ground::find(&args)?.map)
}

/// Whether a format without a frame may be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Frame {
    Keep,
    Drop,
}

/// Writes a map where nothing of it, and no other file, gets lost.
fn write(path: &Path, grid: &OccupancyGrid, frame: Frame) -> Result<()> {
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
