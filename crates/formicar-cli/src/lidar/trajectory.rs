//! Trajectories as files.

use crate::output::Target;
use anyhow::Result;
use formicar::Pose2;
use formicar_mapping::LaserScan;
use formicar_mapping::localize::Located;
use formicar_mapping::trajectory::{located_to_csv, to_csv, to_tum};
use std::path::Path;

/// The format of a trajectory.
#[derive(Clone, Copy, Debug)]
enum Format {
    Csv,
    Tum,
}

/// The file of a trajectory.
#[derive(Clone, Debug)]
pub(crate) struct Trajectory(Target<Format>);

impl Trajectory {
    /// The file, if one is named; its extension is that of a known format.
    pub(crate) fn of(path: Option<&Path>) -> Result<Option<Self>> {
        let kinds = [
            ("csv", Format::Csv),
            ("tum", Format::Tum),
            ("txt", Format::Tum),
        ];
        Ok(Target::of(path, &kinds)?.map(Self))
    }

    /// Writes poses, a row for each scan.
    pub(crate) fn write(&self, scans: &[LaserScan], poses: &[Pose2]) -> Result<()> {
        let text = match self.0.kind {
            Format::Csv => to_csv(scans, poses),
            Format::Tum => to_tum(scans, poses),
        };
        self.0.write(text.as_bytes())
    }

    /// Writes poses with the way they were found, as far as the format has room.
    pub(crate) fn write_located(&self, scans: &[LaserScan], found: &[Located]) -> Result<()> {
        match self.0.kind {
            Format::Csv => self.0.write(located_to_csv(scans, found).as_bytes()),
            Format::Tum => {
                let poses: Vec<Pose2> = found.iter().map(|located| located.pose).collect();
                self.write(scans, &poses)
            }
        }
    }
}
