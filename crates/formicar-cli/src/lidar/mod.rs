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
    match extension.unwrap_or_default().to_ascii_lowercase().as_str() {
        "db3" => bail!(
            "{}: rosbag2 in SQLite is not read; hint: ros2 bag convert -i {} -o out.yaml, with \
             storage_id: mcap in out.yaml",
            path.display(),
            path.display()
        ),
        "bag" => bail!(
            "{}: ROS 1 bags are not read; hint: pip install rosbags, then rosbags-convert --src {} \
             --dst converted --dst-storage mcap",
            path.display(),
            path.display()
        ),
        _ => {}
    }
    let bytes = files::read_bytes(path)?;
    let log = parse_carmen(&bytes).with_context(|| path.display().to_string())?;
    for warning in &log.warnings {
        note(&format!("note: {}: {warning}", path.display()));
    }
    Ok(log)
}
