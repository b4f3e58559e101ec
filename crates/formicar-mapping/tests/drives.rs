//! Drives that the suites share, cut short.

use formicar::{Pose2, Seed};
use formicar_mapping::simulate::{Drive, DriveRule, Office, ReverseSign};
use formicar_mapping::{BuiltMap, Go, Log, Mapper, MappingConfig};

/// The first scans of a drive.
pub(crate) fn drive(n_scans: usize, reverse: ReverseSign) -> Log {
    let office = Office::new(Seed(3));
    let rule = DriveRule {
        n_laps: 1,
        n_visits: 6,
        reverse,
        ..DriveRule::default()
    };
    let log = Drive::new(&office, &rule).log;
    first(&log, n_scans)
}

/// The first scans of a log.
pub(crate) fn first(log: &Log, n: usize) -> Log {
    let cut = |poses: &Option<Vec<Pose2>>| poses.as_ref().map(|poses| poses[..n].to_vec());
    Log {
        scans: log.scans[..n].to_vec(),
        odometry: cut(&log.odometry),
        reference: cut(&log.reference),
        warnings: Vec::new(),
    }
}

/// A mapper with the scans of a log, and its map.
pub(crate) fn mapped(log: &Log, config: MappingConfig) -> (Mapper, BuiltMap) {
    let mut mapper = Mapper::new(config).unwrap();
    mapper.resolve_ranges(log);
    mapper.add_log(log, |_| true, |_| Go::On).unwrap();
    let built = mapper.finish(|_| Go::On).unwrap();
    (mapper, built)
}
