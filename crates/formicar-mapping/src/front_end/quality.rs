//! How a scan was matched.

use crate::matrix::Sym3;
use formicar::Pose2;
use serde::{Deserialize, Serialize};

/// How a scan was matched.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Quality {
    /// The first scan of a map: there was nothing to match with.
    First,
    /// Matched in the first window.
    Ok,
    /// Matched in a wider window.
    Widened,
    /// Not matched: its pose is the predicted one, and other submaps begin with it.
    Lost,
    /// Too few hits, or all at one range: it tells nothing.
    Degenerate,
}

/// The pose found for a scan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScanMatch {
    /// The pose.
    pub pose: Pose2,
    /// How it was found.
    pub quality: Quality,
    /// Mean score, 0 to 1.
    pub score: f64,
    /// Information about the pose, prediction included, in the frame of the map.
    pub information: Sym3,
}
