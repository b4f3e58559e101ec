//! The first stage: joined scans against submaps, by branch and bound.

use super::drift::{SearchWindow, Ways, window};
use super::record::{LoopRecord, Stage};
use super::scene::LoopScene;
use crate::front_end::{Quality, Submap};
use crate::matching::{BoundSearch, ScoreGrids, align};
use formicar::Point2;
use std::collections::{BTreeMap, BTreeSet};

/// Side of the cells of the search, meters, and levels above them.
const SEARCH_CELL_M: f64 = 0.1;
const N_LEVELS: usize = 6;
/// Joined hits are thinned to one per square of this side, meters.
const JOINED_SPACING_M: f64 = 0.15;
/// Most hits of the search; the alignment takes up to four times as many.
const MAX_SEARCH_HITS: usize = 120;
/// Submaps with fewer scans show too little.
const MIN_SUBMAP_SCANS: usize = 5;
/// The search cells are coarser than the map, so that its scores are higher than the alignment's.
const SEARCH_SCORE: f64 = 0.95;

/// Windows wider than this are searched for every other query: they take long, and what they find
/// narrows the windows of the others.
const WIDE_M: f64 = 5.0;

/// Loops of a round, before their neighbors are asked: those with too low a score included.
pub(crate) fn round(scene: &LoopScene<'_>, max_m: f64, memory: &mut LoopMemory) -> Vec<LoopRecord> {
    let rule = &scene.config.loops;
    let widest_m = rule.reaches_m.iter().copied().fold(0.0, f64::max);
    let queries: Vec<usize> = (0..scene.nodes.len())
        .step_by(rule.query_stride.max(1))
        .collect();
    let mut joined: Vec<Option<Vec<Point2>>> = vec![None; queries.len()];
    let ways = Ways::new(scene);
    let mut records = Vec::new();
    for (s, submap) in scene.submaps.iter().enumerate() {
        if submap.n_nodes() < MIN_SUBMAP_SCANS {
            continue;
        }
        let ways = ways.from(submap.anchor());
        let mut grids = None;
        for (q, &query) in queries.iter().enumerate() {
            if query < submap.nodes.1 + rule.min_gap {
                continue;
            }
            let mut window = window(scene, submap, query, ways[query]);
            window.reach_m = window.reach_m.min(widest_m);
            let apart_m = scene.distance_m(submap, scene.poses[query]);
            let is_far = apart_m > window.reach_m + 2.0;
            let is_left_out = window.reach_m > WIDE_M && q % 2 == 1;
            if is_far || is_left_out || window.reach_m > max_m {
                continue;
            }
            if let Some(answer) = memory.answer((s, query), &window, scene) {
                records.extend(answer);
                continue;
            }
            let grids = grids
                .get_or_insert_with(|| ScoreGrids::new(&submap.field, SEARCH_CELL_M, N_LEVELS));
            let Some(grids) = grids else {
                continue;
            };
            let hits = joined[q].get_or_insert_with(|| joined_hits(scene, query));
            let found = match_query(scene, submap, grids, (query, hits), &window);
            memory.note((s, query), &window, found.as_ref());
            records.extend(found);
        }
    }
    records
}

fn match_query(
    scene: &LoopScene<'_>,
    submap: &Submap,
    grids: &ScoreGrids,
    (query, hits): (usize, &[Point2]),
    window: &SearchWindow,
) -> Option<LoopRecord> {
    let rule = &scene.config.loops;
    let stride = hits.len().div_ceil(MAX_SEARCH_HITS).max(1);
    let few: Vec<Point2> = hits.iter().copied().step_by(stride).collect();
    let search = BoundSearch {
        center: window.center,
        reach_m: window.reach_m,
        turn_rad: window.turn_rad,
        turn_step_rad: rule.turn_step_rad,
        min_score: SEARCH_SCORE * rule.min_score,
    };
    let (start, _) = search.run(grids, &few)?;
    let stride = hits.len().div_ceil(4 * MAX_SEARCH_HITS).max(1);
    let many: Vec<Point2> = hits.iter().copied().step_by(stride).collect();
    let found = align(&submap.field, &many, start, None, &scene.config.align);
    Some(scene.record(submap, query, &found, Stage::Topology))
}

/// The hits of a node and of those before it, in its frame, thinned.
fn joined_hits(scene: &LoopScene<'_>, query: usize) -> Vec<Point2> {
    let mut first = query;
    let n = scene.config.loops.n_joined_scans;
    while first > 0 && query - first + 1 < n && scene.nodes[first].quality != Quality::Lost {
        first -= 1;
    }
    let own = scene.nodes[query].front_pose;
    let mut taken = BTreeSet::new();
    let mut hits = Vec::new();
    for node in scene.nodes[first..=query].iter().rev() {
        let pose = own.relative(node.front_pose);
        for hit in node.sweep.points() {
            let hit = pose.transform(hit);
            let cell = hit * (1.0 / JOINED_SPACING_M);
            if taken.insert((cell.x.floor() as i32, cell.y.floor() as i32)) {
                hits.push(hit);
            }
        }
    }
    hits
}

/// Results of earlier rounds: found alignments, or the window in which there was none.
#[derive(Clone, Debug, Default)]
pub struct LoopMemory {
    found: BTreeMap<(usize, usize), LoopRecord>,
    empty: BTreeMap<(usize, usize), SearchWindow>,
}

impl LoopMemory {
    /// The answer of an earlier round, one loop or none; `None` where the search must run.
    fn answer(
        &self,
        key: (usize, usize),
        window: &SearchWindow,
        scene: &LoopScene<'_>,
    ) -> Option<Vec<LoopRecord>> {
        if let Some(record) = self.found.get(&key) {
            let found = scene.nodes[record.from].front_pose.compose(record.motion);
            let off_m = found.position().distance(window.center.position());
            return (off_m <= window.reach_m + 0.5).then(|| vec![*record]);
        }
        let old = self.empty.get(&key)?;
        old.covers(window).then(Vec::new)
    }

    fn note(&mut self, key: (usize, usize), window: &SearchWindow, found: Option<&LoopRecord>) {
        match found {
            Some(record) => drop(self.found.insert(key, *record)),
            None => drop(self.empty.insert(key, *window)),
        }
    }
}
