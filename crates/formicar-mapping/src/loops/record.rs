//! A loop that was looked at, and the verdict on it.

use crate::config::LoopRule;
use crate::graph::{Edge, EdgeKind};
use crate::matrix::Sym3;
use formicar::Pose2;
use serde::{Deserialize, Serialize};

/// The verdict on a loop.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "verdict", rename_all = "snake_case")]
pub enum Verdict {
    /// It is an edge of the graph.
    Accepted,
    /// Its score is too low.
    LowScore,
    /// Too few of its hits fall on seen ground.
    FewSeen,
    /// Too few neighbors agree.
    Unsupported {
        /// Neighbors that agree.
        n_supporters: usize,
    },
    /// Too many neighbors contradict.
    Contradicted {
        /// Neighbors that agree.
        n_supporters: usize,
        /// Neighbors that contradict.
        n_contradictors: usize,
    },
    /// The optimized graph contradicts it: its weight fell below a tenth.
    Outlier,
}

impl Verdict {
    /// The reason in words.
    pub fn words(&self) -> String {
        match self {
            Self::Accepted => "accepted".to_owned(),
            Self::LowScore => "the scans fit too badly".to_owned(),
            Self::FewSeen => "too few hits fall on seen ground".to_owned(),
            Self::Unsupported { n_supporters } => {
                format!("only {n_supporters} neighboring loops agree")
            }
            Self::Contradicted {
                n_supporters,
                n_contradictors,
            } => format!("{n_supporters} neighboring loops agree, {n_contradictors} contradict"),
            Self::Outlier => "the optimized graph contradicts it".to_owned(),
        }
    }
}

/// The stage that found a loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Stage {
    /// Joined scans in a wide window.
    Topology,
    /// A single scan around a consistent estimate.
    Density,
}

/// A loop that was looked at.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LoopRecord {
    /// The node in the middle of the submap.
    pub from: usize,
    /// The node of the query.
    pub to: usize,
    /// The pose of `to` in the frame of `from`.
    pub motion: Pose2,
    /// Information of the scans, in the frame of `from`.
    pub information: Sym3,
    /// Mean score, 0 to 1.
    pub score: f64,
    /// Share of hits on seen ground.
    pub seen_share: f64,
    /// Least over greatest information on the translation.
    pub eigen_ratio: f64,
    /// The stage that found it.
    pub stage: Stage,
    /// The verdict.
    pub verdict: Verdict,
}

impl LoopRecord {
    /// The edge of an accepted loop.
    pub(super) fn edge(&self, rule: &LoopRule) -> Edge {
        let floor = Sym3::diagonal(
            rule.sigma_m.powi(2),
            rule.sigma_m.powi(2),
            rule.sigma_rad.powi(2),
        );
        Edge {
            from: self.from,
            to: self.to,
            motion: self.motion,
            information: widened(self.information, &floor),
            kind: EdgeKind::Loop,
        }
    }
}

/// The information of a measurement with more noise: `(M⁻¹ + N)⁻¹`.
pub(crate) fn widened(information: Sym3, noise: &Sym3) -> Sym3 {
    // A little information in every direction keeps a corridor's matrix invertible.
    let covariance = information
        .plus(Sym3::diagonal(1.0, 1.0, 10.0), 1.0)
        .inverse();
    let sum = covariance.map(|c| c.plus(*noise, 1.0));
    sum.and_then(Sym3::inverse)
        .unwrap_or_else(|| Sym3::diagonal(1.0, 1.0, 10.0))
}
