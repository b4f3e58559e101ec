//! Parameters of matching scan after scan.

use crate::matching::Window;
use serde::{Deserialize, Serialize};

/// Parameters of matching scan after scan.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FrontEndRule {
    /// A scan this far from the last key scan becomes one, meters.
    pub key_distance_m: f64,
    /// A scan turned this far from the last key scan becomes one, radians.
    pub key_turn_rad: f64,
    /// Key scans in a submap; the next submap begins at half of them.
    pub n_submap_scans: usize,
    /// The first window of the correlative search.
    pub window: Window,
    /// The window after a match that was not good enough.
    pub wide_window: Window,
    /// Window of the search by branch and bound after that, and without odometry: half its width,
    /// meters.
    pub far_reach_m: f64,
    /// The same, half the range of headings, radians.
    pub far_turn_rad: f64,
    /// Least mean score of a match.
    pub min_score: f64,
    /// Least share of hits on seen ground.
    pub min_seen_share: f64,
    /// Fewer hits than this are no scan.
    pub min_hits: usize,
}

impl Default for FrontEndRule {
    fn default() -> Self {
        Self {
            key_distance_m: 0.25,
            key_turn_rad: 0.2,
            n_submap_scans: 20,
            window: Window::default(),
            wide_window: Window {
                reach_m: 0.5,
                turn_rad: 30_f64.to_radians(),
                turn_step_rad: 1.5_f64.to_radians(),
            },
            far_reach_m: 1.3,
            far_turn_rad: 50_f64.to_radians(),
            min_score: 0.5,
            min_seen_share: 0.35,
            min_hits: 12,
        }
    }
}
