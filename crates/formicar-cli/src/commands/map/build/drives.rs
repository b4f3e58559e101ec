//! The drives of several logs, one after the other into one map.

use super::BuildArgs;
use crate::lidar::{Interrupt, ScanBar};
use anyhow::Result;
use formicar::Pose2;
use formicar_mapping::localize::first_pose;
use formicar_mapping::{BuiltMap, Go, Log, Mapper};

/// The logs of a command, and the scans of theirs that the map was built from.
pub(super) struct Drives {
    /// All scans, log after log.
    pub(super) scans: Vec<formicar_mapping::LaserScan>,
    /// Each log, with the place of its first scan among the mapper's, and the scans left out.
    pub(super) logs: Vec<Drive>,
}

/// A log in a map.
pub(super) struct Drive {
    pub(super) log: Log,
    /// The mapper's number of its first scan.
    pub(super) first: usize,
    /// Every so many-th scan is held out.
    pub(super) hold_out: Option<usize>,
}

impl Drive {
    /// True where a scan takes part in the map.
    pub(super) fn keeps(&self, scan: usize) -> bool {
        keeps(self.hold_out, scan)
    }
}

fn keeps(hold_out: Option<usize>, scan: usize) -> bool {
    hold_out.is_none_or(|n| scan % n != n - 1)
}

impl Drives {
    /// Adds the logs to a mapper.
    pub(super) fn add(
        mapper: &mut Mapper,
        logs: Vec<Log>,
        args: &BuildArgs,
        interrupt: &Interrupt,
    ) -> Result<Self> {
        let hold_out = args.hold_out.map(|n| n as usize);
        let mut start = args.start;
        let mut drives = Vec::new();
        for log in logs {
            let goes_on = mapper
                .log_progress()
                .is_some_and(|known| known.fingerprint == log.fingerprint());
            mapper.resolve_ranges(&log);
            if !goes_on && !mapper.places().is_empty() {
                begin(mapper, &log, start.take())?;
            }
            let n_done = mapper
                .log_progress()
                .filter(|_| goes_on)
                .map_or(0, |known| known.n_done);
            let n_kept = (0..n_done).filter(|&i| keeps(hold_out, i)).count();
            let first = mapper.places().len() - n_kept.min(mapper.places().len());
            let bar = ScanBar::new(interrupt);
            let go = mapper.add_log(&log, |i| keeps(hold_out, i), |step| bar.show(step))?;
            drives.push(Drive {
                log,
                first,
                hold_out,
            });
            if go == Go::Stop {
                break;
            }
        }
        let scans = drives
            .iter()
            .flat_map(|drive| drive.log.scans.iter().cloned());
        Ok(Self {
            scans: scans.collect(),
            logs: drives,
        })
    }

    /// The pose at every scan of all logs. Those that were held out lie on the odometry from the
    /// scan before, or halfway between their neighbors.
    pub(super) fn trajectory(&self, built: &BuiltMap) -> Vec<Pose2> {
        self.logs
            .iter()
            .flat_map(|drive| drive.poses(&built.trajectory))
            .collect()
    }
}

impl Drive {
    /// The pose at every scan of this log, given those of the mapper's scans.
    pub(super) fn poses(&self, mapped: &[Pose2]) -> Vec<Pose2> {
        let mut next = self.first;
        let mut poses: Vec<Pose2> = Vec::with_capacity(self.log.scans.len());
        for i in 0..self.log.scans.len() {
            if self.keeps(i) {
                poses.push(mapped.get(next).copied().unwrap_or_default());
                next += 1;
                continue;
            }
            let before = poses.last().copied().unwrap_or_default();
            poses.push(match self.log.motion(i) {
                Some(motion) => before.compose(motion).wrapped(),
                None => mapped
                    .get(next)
                    .map_or(before, |&after| halfway(before, after)),
            });
        }
        poses
    }
}

fn halfway(a: Pose2, b: Pose2) -> Pose2 {
    let step = a.relative(b).wrapped();
    a.compose(Pose2::new(0.5 * step.x, 0.5 * step.y, 0.5 * step.heading))
        .wrapped()
}

/// Begins another drive in the map so far.
fn begin(mapper: &mut Mapper, log: &Log, start: Option<Pose2>) -> Result<()> {
    let built = mapper.finish(|_| Go::On)?;
    let start = match start {
        Some(start) => start,
        None => first_pose(&built.field, log, mapper.config(), mapper.policy())?,
    };
    mapper.start_drive(start, &built);
    Ok(())
}
