//! Pose graphs: poses, relative poses between them, and the most likely arrangement.

mod ldl;
mod ordering;
mod solve;

pub use ldl::{Block, BlockMatrix};
pub use ordering::Ordering;
pub use solve::{GraphRule, Solution, solve};

use crate::matrix::Sym3;
use formicar::Pose2;
use serde::{Deserialize, Serialize};

/// The origin of an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum EdgeKind {
    /// From one key scan to the next.
    Sequence,
    /// The same where a scan was lost: the odometry alone, which may be wrong.
    Weak,
    /// Between key scans at one place.
    Loop,
}

/// A measured relative pose.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Edge {
    /// The node in whose frame it is given.
    pub from: usize,
    /// The node that it leads to.
    pub to: usize,
    /// The pose of `to` in the frame of `from`.
    pub motion: Pose2,
    /// Its information, in the frame of `from`.
    pub information: Sym3,
    /// Its origin.
    pub kind: EdgeKind,
}

impl Edge {
    /// The deviation of two poses from the edge, in the frame of `from`.
    pub fn error(&self, from: Pose2, to: Pose2) -> [f64; 3] {
        crate::matrix::difference(from.relative(to), self.motion)
    }
}
