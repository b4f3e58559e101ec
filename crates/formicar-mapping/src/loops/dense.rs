//! The second stage: single scans against submaps near the consistent estimate.

use super::record::{LoopRecord, Stage, Verdict};
use super::scene::LoopScene;
use crate::matching::{Window, align, search};
use crate::matrix::Sym3;

/// A scan and a submap whose nodes are farther apart than this see different things, meters.
const NEAR_M: f64 = 3.0;
/// Headings are tried in steps of this, radians.
const TURN_STEP_RAD: f64 = 0.02;

/// Loops of single scans, those with too low a score included.
pub(crate) fn densify(scene: &LoopScene<'_>) -> Vec<LoopRecord> {
    let rule = &scene.config.loops;
    let window = Window {
        reach_m: rule.dense_reach_m,
        turn_rad: rule.dense_turn_rad,
        turn_step_rad: TURN_STEP_RAD,
    };
    let mut records = Vec::new();
    for node in (0..scene.nodes.len()).step_by(rule.dense_stride.max(1)) {
        let pose = scene.poses[node];
        let hits = scene.config.hits(&scene.nodes[node].sweep);
        for submap in near_submaps(scene, node) {
            let submap = &scene.submaps[submap];
            let center = scene.in_submap(submap, pose);
            let none = Sym3::default();
            let starts = search(&submap.field, &hits, center, &none, (&window, 1));
            let Some(start) = starts.first() else {
                continue;
            };
            let found = align(&submap.field, &hits, start.pose, None, &scene.config.align);
            let mut record = scene.record(submap, node, &found, Stage::Density);
            let moved_m = found.pose.position().distance(center.position());
            if record.verdict == Verdict::Accepted && moved_m > 1.5 * rule.dense_reach_m {
                record.verdict = Verdict::LowScore;
            }
            records.push(record);
        }
    }
    records
}

/// The nearest submaps of a node that it is no part of.
fn near_submaps(scene: &LoopScene<'_>, node: usize) -> Vec<usize> {
    let rule = &scene.config.loops;
    let pose = scene.poses[node];
    let mut near: Vec<(f64, usize)> = scene
        .submaps
        .iter()
        .enumerate()
        .filter(|(_, submap)| {
            let is_before = submap.nodes.1 + rule.min_gap <= node;
            let is_after = node + rule.min_gap <= submap.nodes.0;
            (is_before || is_after) && submap.n_nodes() >= 5
        })
        .map(|(i, submap)| (scene.distance_m(submap, pose), i))
        .filter(|(distance, _)| *distance <= NEAR_M)
        .collect();
    near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    near.truncate(rule.n_dense_submaps);
    near.into_iter().map(|(_, submap)| submap).collect()
}
