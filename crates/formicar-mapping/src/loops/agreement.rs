//! Agreement of loops: two loops close to each other close a small cycle, or one is wrong.

use super::record::{LoopRecord, Verdict};
use crate::config::AgreementRule;
use crate::front_end::Node;
use formicar::Pose2;

/// Neighbors of a loop that agree with it, and that contradict it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Support {
    /// Those that agree.
    pub n_supporters: usize,
    /// Those that contradict.
    pub n_contradictors: usize,
}

/// Rejects the accepted loops whose neighbors do not agree.
pub(super) fn judge(records: &mut [LoopRecord], nodes: &[Node], rule: &AgreementRule) {
    let good: Vec<LoopRecord> = records
        .iter()
        .filter(|record| record.verdict == Verdict::Accepted)
        .copied()
        .collect();
    for record in records
        .iter_mut()
        .filter(|r| r.verdict == Verdict::Accepted)
    {
        let support = support(record, &good, nodes, rule);
        record.verdict = verdict(support, rule);
    }
}

fn verdict(support: Support, rule: &AgreementRule) -> Verdict {
    let Support {
        n_supporters,
        n_contradictors,
    } = support;
    if n_supporters < rule.min_supporters {
        return Verdict::Unsupported { n_supporters };
    }
    if n_supporters < rule.supporters_per_contradictor * n_contradictors {
        return Verdict::Contradicted {
            n_supporters,
            n_contradictors,
        };
    }
    Verdict::Accepted
}

fn support(
    record: &LoopRecord,
    others: &[LoopRecord],
    nodes: &[Node],
    rule: &AgreementRule,
) -> Support {
    let mut support = Support::default();
    for other in others {
        let n_query = record.to.abs_diff(other.to);
        let n_submap = record.from.abs_diff(other.from);
        let is_same = n_query == 0 && n_submap == 0;
        if is_same || n_query > rule.query_scans || n_submap > rule.submap_scans {
            continue;
        }
        let (gap_m, gap_rad) = cycle(record, other, nodes);
        let n_scans = (n_query + n_submap) as f64;
        let closes = gap_m < rule.base_m + rule.per_scan_m * n_scans
            && gap_rad < rule.base_rad + rule.per_scan_rad * n_scans;
        support.n_supporters += usize::from(closes);
        support.n_contradictors += usize::from(!closes);
    }
    support
}

/// The gap of the cycle over two loops and the scans between their ends.
fn cycle(a: &LoopRecord, b: &LoopRecord, nodes: &[Node]) -> (f64, f64) {
    let between = |from: usize, to: usize| nodes[from].front_pose.relative(nodes[to].front_pose);
    // The pose of b's query, by a's loop and by b's.
    let by_a = a.motion.compose(between(a.to, b.to));
    let by_b: Pose2 = between(a.from, b.from).compose(b.motion);
    let gap = by_b.relative(by_a).wrapped();
    (gap.position().norm(), gap.heading.abs())
}
