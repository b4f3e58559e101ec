//! Parameters of closing loops.

use crate::graph::GraphRule;
use serde::{Deserialize, Serialize};

/// Parameters of closing loops.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LoopRule {
    /// Scans that are joined for a query.
    pub n_joined_scans: usize,
    /// Every so many-th key scan is a query.
    pub query_stride: usize,
    /// Key scans between a query and a submap, at least.
    pub min_gap: usize,
    /// Rounds of the first stage: each searches the windows up to half this width, meters. The
    /// widest must exceed the drift.
    pub reaches_m: Vec<f64>,
    /// How wide the windows are.
    pub drift: DriftRule,
    /// Step between headings, radians.
    pub turn_step_rad: f64,
    /// Least mean score of a loop.
    pub min_score: f64,
    /// Least share of hits on seen ground.
    pub min_seen_share: f64,
    /// Agreement of neighbors.
    pub agreement: AgreementRule,
    /// Every so many-th key scan is matched in the second stage.
    pub dense_stride: usize,
    /// Half the window of the second stage, meters.
    pub dense_reach_m: f64,
    /// The same for headings, radians.
    pub dense_turn_rad: f64,
    /// Submaps that a scan is matched with in the second stage.
    pub n_dense_submaps: usize,
    /// Standard deviation of a loop beyond what its scan says, meters.
    pub sigma_m: f64,
    /// The same for its heading, radians.
    pub sigma_rad: f64,
    /// The graph's optimization.
    pub graph: GraphRule,
}

impl Default for LoopRule {
    fn default() -> Self {
        Self {
            n_joined_scans: 6,
            query_stride: 4,
            min_gap: 25,
            reaches_m: vec![4.0, 15.0, 4.0],
            drift: DriftRule::default(),
            turn_step_rad: 1.5_f64.to_radians(),
            min_score: 0.6,
            min_seen_share: 0.6,
            agreement: AgreementRule::default(),
            dense_stride: 2,
            dense_reach_m: 0.6,
            dense_turn_rad: 6_f64.to_radians(),
            n_dense_submaps: 2,
            sigma_m: 0.03,
            sigma_rad: 0.4_f64.to_radians(),
            graph: GraphRule::default(),
        }
    }
}

/// How far a pose may be off, by the way driven since the place that is compared: the shortest way
/// over scans and accepted loops.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct DriftRule {
    /// At any place, meters.
    pub base_m: f64,
    /// More per meter of the way.
    pub per_m: f64,
    /// Heading at any place, radians.
    pub base_rad: f64,
    /// Heading per meter of the way, radians.
    pub rad_per_m: f64,
    /// Never more heading than this, radians.
    pub max_rad: f64,
    /// A lost scan counts as this way, meters.
    pub lost_m: f64,
    /// A loop counts as this way, meters.
    pub loop_m: f64,
}

impl Default for DriftRule {
    fn default() -> Self {
        Self {
            base_m: 1.0,
            per_m: 0.04,
            base_rad: 4_f64.to_radians(),
            rad_per_m: 0.2_f64.to_radians(),
            max_rad: 20_f64.to_radians(),
            lost_m: 50.0,
            loop_m: 2.0,
        }
    }
}

/// Parameters of the agreement of loops with their neighbors.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct AgreementRule {
    /// Loops whose queries are this many key scans apart are neighbors.
    pub query_scans: usize,
    /// And whose submaps' middles are this many key scans apart.
    pub submap_scans: usize,
    /// Two neighbors agree when their small cycle closes to this, meters.
    pub base_m: f64,
    /// More per key scan of the cycle, meters.
    pub per_scan_m: f64,
    /// And to this, radians.
    pub base_rad: f64,
    /// More per key scan of the cycle, radians.
    pub per_scan_rad: f64,
    /// Neighbors that must agree.
    pub min_supporters: usize,
    /// Those that agree per one that contradicts.
    pub supporters_per_contradictor: usize,
}

impl Default for AgreementRule {
    fn default() -> Self {
        Self {
            query_scans: 15,
            submap_scans: 25,
            base_m: 0.25,
            per_scan_m: 0.02,
            base_rad: 2.5_f64.to_radians(),
            per_scan_rad: 0.1_f64.to_radians(),
            min_supporters: 2,
            supporters_per_contradictor: 2,
        }
    }
}
