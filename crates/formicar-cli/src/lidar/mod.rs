//! What commands on lidar logs share: reading logs and maps, trajectories, progress, Ctrl-C.

mod log_args;
mod map;
mod progress;
mod trajectory;

pub(crate) use log_args::LogArgs;
pub(crate) use map::MapToSearch;
pub(crate) use progress::{Interrupt, ScanBar};
pub(crate) use trajectory::Trajectory;

use crate::bag;
use crate::failure::note;
use crate::files;
use anyhow::{Context, Result, bail};
use formicar_mapping::Log;
use formicar_mapping::log::carmen::parse_carmen;
use std::path::Path;

/// Reads a log by its name and contents; its warnings go to stderr.
pub(crate) fn read_log(path: &Path, args: &LogArgs) -> Result<Log> {
    let log = log(path, args)?;
    for warning in &log.warnings {
        note(&format!("note: {}: {warning}", path.display()));
    }
    Ok(log)
}

/// A log by its name and contents: a bag of ROS 2, or a file in the format of CARMEN.
pub(crate) fn log(path: &Path, args: &LogArgs) -> Result<Log> {
    if bag::is_bag(path) {
        #[cfg(feature = "record")]
        return bag::read_log(path, &args.options());
        #[cfg(not(feature = "record"))]
        return bag::refuse(path);
    }
    if let Some(flag) = args.first_flag() {
        bail!(
            "{flag}: {} is no bag, and a log of CARMEN has no topics; hint: leave the flag out",
            path.display()
        );
    }
    let bytes = files::read_bytes(path)?;
    let log = parse_carmen(&bytes).with_context(|| path.display().to_string())?;
    Ok(if args.no_odometry {
        log.without_odometry()
    } else {
        log
    })
}
