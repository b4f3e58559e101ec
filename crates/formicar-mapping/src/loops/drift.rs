//! Windows of the search for loops: as wide as the drift may be, and no wider.

use super::record::Verdict;
use super::scene::LoopScene;
use crate::front_end::{Quality, Submap};
use formicar::Pose2;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// A window of poses in the frame of a submap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SearchWindow {
    /// Its center.
    pub(super) center: Pose2,
    /// Half its width, meters.
    pub(super) reach_m: f64,
    /// Half its range of headings, radians.
    pub(super) turn_rad: f64,
}

impl SearchWindow {
    /// True where nearly all of another window lies in this one.
    pub(super) fn covers(&self, other: &Self) -> bool {
        let moved_m = self.center.position().distance(other.center.position());
        let turned = formicar::geometry::wrap_angle(self.center.heading - other.center.heading);
        moved_m + other.reach_m <= self.reach_m + 0.5
            && turned.abs() + other.turn_rad <= self.turn_rad + 0.05
    }
}

/// The shortest ways, in meters, between nodes that follow each other or close a loop.
pub(super) struct Ways {
    /// For each node, the nodes next to it and the way there.
    next: Vec<Vec<(u32, f64)>>,
}

impl Ways {
    /// The ways of a scene with its known loops.
    pub(super) fn new(scene: &LoopScene<'_>) -> Self {
        let rule = &scene.config.loops.drift;
        let mut next = vec![Vec::new(); scene.nodes.len()];
        let mut both = |a: usize, b: usize, way: f64| {
            next[a].push((b as u32, way));
            next[b].push((a as u32, way));
        };
        for (i, node) in scene.nodes.iter().enumerate().skip(1) {
            let lost = if node.quality == Quality::Lost {
                rule.lost_m
            } else {
                0.0
            };
            both(i - 1, i, node.motion.position().norm() + lost);
        }
        for record in scene
            .known
            .iter()
            .filter(|r| r.verdict == Verdict::Accepted)
        {
            both(record.from, record.to, rule.loop_m);
        }
        Self { next }
    }

    /// The way from a node to every node, by Dijkstra.
    pub(super) fn from(&self, start: usize) -> Vec<f64> {
        let mut ways = vec![f64::INFINITY; self.next.len()];
        // Ways in tenths of a millimeter order exactly.
        let key = |way: f64, node: u32| Reverse(((way * 1e4) as u64, node));
        let mut open = BinaryHeap::from([key(0.0, start as u32)]);
        ways[start] = 0.0;
        while let Some(Reverse((at, node))) = open.pop() {
            let way = ways[node as usize];
            if ((way * 1e4) as u64) < at {
                continue;
            }
            for &(other, step) in &self.next[node as usize] {
                if way + step < ways[other as usize] {
                    ways[other as usize] = way + step;
                    open.push(key(way + step, other));
                }
            }
        }
        ways
    }
}

/// The window of a query in a submap that is a way off.
pub(super) fn window(
    scene: &LoopScene<'_>,
    submap: &Submap,
    query: usize,
    way_m: f64,
) -> SearchWindow {
    let rule = &scene.config.loops.drift;
    SearchWindow {
        center: scene.in_submap(submap, scene.poses[query]),
        reach_m: rule.base_m + rule.per_m * way_m,
        turn_rad: (rule.base_rad + rule.rad_per_m * way_m).min(rule.max_rad),
    }
}
