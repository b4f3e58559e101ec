//! All that the search for loops works on.

use super::record::{LoopRecord, Stage, Verdict};
use crate::config::MappingConfig;
use crate::front_end::{Node, Submap};
use crate::matching::Alignment;
use formicar::Pose2;

/// All that the search for loops works on.
pub(crate) struct LoopScene<'a> {
    pub(crate) nodes: &'a [Node],
    pub(crate) submaps: &'a [Submap],
    /// Current poses of the nodes.
    pub(crate) poses: &'a [Pose2],
    /// Loops of the round before.
    pub(crate) known: &'a [LoopRecord],
    pub(crate) config: &'a MappingConfig,
}

impl LoopScene<'_> {
    /// A pose of the graph in the frame in which a submap was built.
    pub(super) fn in_submap(&self, submap: &Submap, pose: Pose2) -> Pose2 {
        let anchor = submap.anchor();
        let local = self.poses[anchor].relative(pose);
        self.nodes[anchor].front_pose.compose(local)
    }

    /// A loop from an alignment found in the frame of a submap.
    pub(super) fn record(
        &self,
        submap: &Submap,
        to: usize,
        found: &Alignment,
        stage: Stage,
    ) -> LoopRecord {
        let from = submap.anchor();
        let anchor = self.nodes[from].front_pose;
        let rule = &self.config.loops;
        let verdict = if found.score < rule.min_score {
            Verdict::LowScore
        } else if found.seen_share < rule.min_seen_share {
            Verdict::FewSeen
        } else {
            Verdict::Accepted
        };
        LoopRecord {
            from,
            to,
            motion: anchor.relative(found.pose).wrapped(),
            information: found.information.turned(-anchor.heading),
            score: found.score,
            seen_share: found.seen_share,
            eigen_ratio: found.eigen_ratio,
            stage,
            verdict,
        }
    }

    /// Distance of a pose to the nearest node of a submap, meters.
    pub(super) fn distance_m(&self, submap: &Submap, pose: Pose2) -> f64 {
        let nodes = submap.nodes.0..submap.nodes.1;
        let distances = nodes.map(|node| self.poses[node].position().distance(pose.position()));
        distances.fold(f64::INFINITY, f64::min)
    }
}
