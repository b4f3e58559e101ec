//! A speed plan, its ending, and where its profile comes from.

use super::forbidden::Region;
use crate::path::TimedPath;

/// The ending of a speed plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum MotionStatus {
    /// The drive ends at the end of the path.
    Arrives,
    /// The drive ends before an obstacle that stays in the way; it waits there.
    Waits,
}

impl MotionStatus {
    /// The word used in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Arrives => "arrives",
            Self::Waits => "waits",
        }
    }
}

/// The profile that was taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum ProfileSource {
    /// The fastest within the limits: no region is in its way.
    Fastest,
    /// The fastest on the lattice, and the fastest within the limits from where nothing is in the
    /// way any more.
    Lattice,
}

/// A speed plan.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct MotionPlan {
    /// The path with its times.
    pub timed: TimedPath,
    /// Its ending.
    pub status: MotionStatus,
    /// Where its profile comes from.
    pub source: ProfileSource,
    /// The time that the drive takes where nothing is in the way, seconds.
    pub unhindered_s: f64,
    /// Stretches of the path that are closed for a while.
    pub regions: Vec<Region>,
    /// The time step of regions and lattice, seconds.
    pub time_step_s: f64,
}

impl MotionPlan {
    /// The time that obstacles cost, seconds; infinite where the drive does not arrive.
    pub fn lost_s(&self) -> f64 {
        match self.status {
            MotionStatus::Arrives => self.timed.duration_s() - self.unhindered_s,
            MotionStatus::Waits => f64::INFINITY,
        }
    }
}
