//! Configurations, vehicles, campaigns and lidar logs as this command reads them, for other front
//! ends.

#[cfg(feature = "lab")]
use crate::commands::{bench, machine};
#[cfg(feature = "mapping")]
use crate::lidar;
use crate::{motion_files, scene, settings};
use anyhow::Result;
#[cfg(feature = "mapping")]
use formicar::Pose2;
use formicar::planner::PlannerConfig;
use formicar::scenario::Predictions;
use formicar::vehicle::{Motion, Vehicle};
#[cfg(feature = "lab")]
use formicar_lab::{campaign::Campaign, run::Sources};
#[cfg(feature = "mapping")]
use formicar_mapping::Log;
use std::path::Path;
use toml::Table;

/// The parameters of a planner from a table as in a configuration file. Without a planner's name it
/// is that of the default planner or, for a point, of A*.
///
/// # Errors
/// A key that no planner has, a value of another type, or one out of its range.
pub fn planner_config(table: Table, motion: Motion) -> Result<PlannerConfig> {
    settings::of_table(table, motion)
}

/// The table of a configuration file, whose keys are all known.
///
/// # Errors
/// A file that cannot be read, is no TOML, or has a key that no planner has.
pub fn planner_table(path: &Path) -> Result<Table> {
    settings::read(path)
}

/// Every key that a configuration may have, dotted.
pub fn planner_keys() -> Vec<String> {
    settings::known_keys()
}

/// A built-in vehicle, or one from a `.toml` or `.json` file.
///
/// # Errors
/// A name that no vehicle has, a file that cannot be read, or measures that cannot be.
pub fn vehicle(name: &str) -> Result<Vehicle> {
    Ok(scene::vehicle(name)?.vehicle)
}

/// What a log takes out of a bag, where the bag leaves a choice or a gap: `--scan-topic`,
/// `--odom-topic`, `--laser-pose` and `--no-odometry`.
#[cfg(feature = "mapping")]
#[derive(Clone, Debug, Default)]
pub struct BagChoice {
    /// The topic of the scans.
    pub scan_topic: Option<String>,
    /// The topic of the odometry.
    pub odom_topic: Option<String>,
    /// The laser's pose on the robot.
    pub laser_pose: Option<Pose2>,
    /// Whether the odometry is left out, and with it the laser's place on the robot.
    pub no_odometry: bool,
}

/// A lidar log: a bag of ROS 2, or a file in the format of CARMEN.
///
/// # Errors
/// What is wrong with the file, or a choice for a log that has none.
#[cfg(feature = "mapping")]
pub fn lidar_log(path: &Path, choice: BagChoice) -> Result<Log> {
    let args = lidar::LogArgs {
        scan_topic: choice.scan_topic,
        odom_topic: choice.odom_topic,
        laser_pose: choice.laser_pose,
        no_odometry: choice.no_odometry,
    };
    lidar::log(path, &args)
}

/// The runs of a campaign file; names of files in it are relative to its folder.
///
/// # Errors
/// What is wrong with the file, with line and column, or with a file that it names.
#[cfg(feature = "lab")]
pub fn campaign(path: &Path) -> Result<Campaign> {
    bench::read_campaign(path)
}

/// Reads the built-in maps and files that the runs of a campaign name.
#[cfg(feature = "lab")]
pub fn sources() -> impl Sources {
    bench::Files
}

/// This machine in a line, which tells machines apart as far as times go.
#[cfg(feature = "lab")]
pub fn machine() -> String {
    machine::name()
}

/// Moving obstacles with their predictions, as `plan --moving` reads them.
///
/// # Errors
/// A file that cannot be read, another schema, or predictions that make no sense.
pub fn moving(path: &Path) -> Result<Predictions> {
    motion_files::moving(path, None)
}
