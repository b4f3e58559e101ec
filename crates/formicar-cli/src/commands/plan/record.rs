//! `plan --record`: the plan as a bag of ROS 2.

use crate::output::Target;
use crate::scene::Scene;
use anyhow::{Context, Result};
use formicar::path::CurvePath;
use formicar_record::Recording;
use std::io::Cursor;
use std::path::Path;

/// The bag to write.
pub(super) type RecordTarget = Target<()>;

/// The speed of a drive where the vehicle has none, meters per second.
const DEFAULT_SPEED_MPS: f64 = 1.0;

/// The bag, if one is named.
pub(super) fn target(path: Option<&Path>) -> Result<Option<RecordTarget>> {
    Target::of(path, &[("mcap", ())])
}

/// Writes a path, its map and its vehicle.
pub(super) fn write(scene: &Scene, path: &CurvePath, target: &RecordTarget) -> Result<()> {
    let vehicle = &scene.vehicle.vehicle;
    let speed_mps = vehicle.parameters().speed_mps;
    let recording = Recording {
        map: &scene.map,
        vehicle,
        path,
        speed_mps: speed_mps.unwrap_or(DEFAULT_SPEED_MPS),
    };
    let bytes = recording.write(Cursor::new(Vec::new()));
    target.write(&bytes.context("--record")?.into_inner())
}
