//! What commands on lidar logs share: reading logs and maps, trajectories, progress, Ctrl-C.

mod map;
mod progress;
mod trajectory;

pub(crate) use map::MapToSearch;
pub(crate) use progress::{Interrupt, ScanBar};
pub(crate) use trajectory::Trajectory;

use crate::failure::note;
use crate::files;
use anyhow::{Context, Result, bail};
use formicar_mapping::Log;
use formicar_mapping::log::carmen::parse_carmen;
use std::path::Path;

/// Reads a log by its name and contents; its warnings go to stderr.
pub(crate) fn read_log(path: &Path) -> Result<Log> {
    let extension = path.extension().and_then(|e| e.to_str());
    let extension = extension.unwrap_or_default().to_ascii_lowercase();
    if ["mcap", "db3", "bag"].contains(&extension.as_str()) {
        bail!(
            "{}: bags of ROS are not read; hint: write each scan as a line of CARMEN: FLASER N \
             range1 ... rangeN x y heading odom_x odom_y odom_heading time host time, with ranges \
             over 180 degrees",
            path.display()
        );
    }
    let bytes = files::read_bytes(path)?;
    let log = parse_carmen(&bytes).with_context(|| path.display().to_string())?;
    for warning in &log.warnings {
        note(&format!("note: {}: {warning}", path.display()));
    }
    Ok(log)
}
