//! Loops: places visited again, found by joined scans, kept only where their neighbors agree.
//!
//! Two stages: topology first (joined scans, branch and bound in a window wider than the drift,
//! agreement of neighbors), density second (single scans around the then consistent estimate).
//! A single scan in a long corridor fits in many places: two of five such loops are wrong and agree
//! with each other along the corridor, so that no robust kernel finds them.

mod agreement;
mod dense;
mod drift;
mod record;
mod scene;
mod topology;

pub use agreement::Support;
pub use record::{LoopRecord, Stage, Verdict};
pub use topology::LoopMemory;

pub(crate) use dense::densify;
pub(crate) use record::widened;
pub(crate) use scene::LoopScene;

use crate::config::LoopRule;
use crate::graph::Edge;

/// Loops of a round of the first stage, judged by their neighbors.
pub(crate) fn topology_round(
    scene: &LoopScene<'_>,
    reach_m: f64,
    memory: &mut LoopMemory,
) -> Vec<LoopRecord> {
    let mut records = topology::round(scene, reach_m, memory);
    agreement::judge(&mut records, scene.nodes, &scene.config.loops.agreement);
    records
}

/// The edges of the accepted loops, in their order.
pub(crate) fn edges(records: &[LoopRecord], rule: &LoopRule) -> Vec<Edge> {
    let accepted = records
        .iter()
        .filter(|record| record.verdict == Verdict::Accepted);
    accepted.map(|record| record.edge(rule)).collect()
}

/// A loop whose weight fell below this is none.
const OUTLIER_WEIGHT: f64 = 0.1;

/// Marks accepted loops, whose weights stand in their order, that the graph contradicts.
pub(crate) fn mark_outliers(records: &mut [LoopRecord], weights: &[f64]) {
    let accepted = records
        .iter_mut()
        .filter(|record| record.verdict == Verdict::Accepted);
    for (record, &weight) in accepted.zip(weights) {
        if weight < OUTLIER_WEIGHT {
            record.verdict = Verdict::Outlier;
        }
    }
}
