//! The place in a map where a log begins.

use super::{LocalizationMap, Localizer};
use crate::config::MappingConfig;
use crate::error::MappingError;
use crate::log::Log;
use crate::scan::RangePolicy;
use crate::sdf::{SdfMap, Sweep};
use formicar::Pose2;

/// Scans that a search in the whole map joins.
const N_START_SCANS: usize = 4;

/// The pose of a log's first scan in a map, by a search of its first scans in the whole map.
///
/// # Errors
/// Scans that are found nowhere, or a map without a surface.
pub fn first_pose(
    field: &SdfMap,
    log: &Log,
    config: &MappingConfig,
    ranges: &RangePolicy,
) -> Result<Pose2, MappingError> {
    let localizer = Localizer::new(LocalizationMap::new(field), config, None)?;
    let mut reckoned = Pose2::default();
    let mut scans = Vec::new();
    for (i, scan) in log.scans.iter().take(N_START_SCANS).enumerate() {
        reckoned = reckoned.compose(log.motion(i).unwrap_or_default());
        scans.push((Sweep::new(scan, ranges).0, reckoned));
    }
    if log.odometry.is_none() {
        // Without motion between them, scans cannot be joined.
        scans.truncate(1);
    }
    let found = localizer.global(&scans);
    let (Some((newest, _)), [(_, first), ..]) = (found, scans.as_slice()) else {
        return Err(MappingError::NotInMap {
            n_scans: N_START_SCANS,
        });
    };
    // The search gives the pose of the newest scan.
    let last = scans.last().map_or(*first, |(_, pose)| *pose);
    Ok(newest.compose(last.relative(*first)).wrapped())
}
