//! Signed distance maps: tiles, insertion of scans, distances and gradients.

mod fossel;
mod insert;
mod map;
mod sweep;
mod tiles;

pub use fossel::FosselRule;
pub use insert::WedgeRule;
pub use map::{PackedSdf, Sample, SdfCell, SdfMap, SignedDistances};
pub use sweep::{SurfaceLine, Sweep};
pub use tiles::{Place, TILE, Tiles};

use formicar::Pose2;
use serde::{Deserialize, Serialize};

/// The way in which scans enter a map.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "rule", rename_all = "snake_case", deny_unknown_fields)]
pub enum InsertionRule {
    /// Wedges between beams, weighted means.
    Wedge(WedgeRule),
    /// Regression lines in dual cells with the priority of rings (Fossel, Tuyls & Sturm 2015).
    Fossel2015(FosselRule),
}

impl Default for InsertionRule {
    fn default() -> Self {
        Self::Wedge(WedgeRule::default())
    }
}

impl InsertionRule {
    /// Inserts a scan taken from a pose of the sensor.
    pub fn insert(&self, map: &mut SdfMap, sweep: &Sweep, pose: Pose2) {
        match self {
            Self::Wedge(rule) => map.insert(sweep, &sweep.lines(rule.line_reach_m), pose, rule),
            Self::Fossel2015(rule) => map.insert_fossel(sweep, pose, rule),
        }
    }

    /// The farthest surface that is inserted, meters.
    pub fn reach_m(&self) -> f64 {
        match self {
            Self::Wedge(rule) => rule.reach_m,
            Self::Fossel2015(rule) => rule.reach_m,
        }
    }
}
