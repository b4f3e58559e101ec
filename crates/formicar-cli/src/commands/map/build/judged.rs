//! The judgment of a map: reference poses of its logs, and scans that were held out.

use super::drives::{Drive, Drives};
use formicar::Pose2;
use formicar_mapping::evaluate::{
    HeldOut, JudgedMap, held_out, loop_pairs, neighbor_pairs, relation_errors, trajectory_error,
};
use formicar_mapping::{BuiltMap, MapReport, Mapper};

/// Pairs of scans this close, and this many scans apart, are loops.
const LOOP_REACH_M: f64 = 2.0;
const LOOP_GAP: usize = 20;

/// The report of a map, with all that its logs tell about its errors.
pub(super) fn report(
    mapper: &Mapper,
    built: &BuiltMap,
    drives: &Drives,
    poses: &[Pose2],
) -> MapReport {
    let mut report = MapReport::new(mapper, built);
    if let [Drive { log, .. }] = drives.logs.as_slice()
        && let Some(reference) = &log.reference
    {
        let mut errors = |name: &str, pairs: &[(usize, usize)]| {
            let found = relation_errors(poses, reference, pairs);
            report.errors.push((name.to_owned(), found));
        };
        errors("neighbors", &neighbor_pairs(reference.len()));
        errors("loops", &loop_pairs(reference, LOOP_REACH_M, LOOP_GAP));
        report.trajectory_error = Some(trajectory_error(poses, reference));
    }
    let mut sum: Option<HeldOut> = None;
    for drive in drives.logs.iter().filter(|drive| drive.hold_out.is_some()) {
        let own = drive.poses(&built.trajectory);
        let left_out = (0..own.len()).filter(|&i| !drive.keeps(i));
        let scans: Vec<(usize, Pose2)> = left_out.map(|i| (i, own[i])).collect();
        let map = JudgedMap {
            grid: &built.grid,
            field: &built.field,
            policy: mapper.policy(),
            config: mapper.config(),
        };
        let found = held_out(&map, &drive.log, &scans, |_, _| true);
        sum = Some(sum.map_or(found, |sum| sum.plus(&found)));
    }
    report.held_out = sum;
    report
}
