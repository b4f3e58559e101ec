//! Paths, one type per stage of planning: cells, way points, drivable curves, curves in time.

mod ahead;
mod curve_path;
mod spacing;
mod speed_limits;
mod timed;

pub use curve_path::{CurvePath, CurveSegment, Direction, PathPose};
pub use spacing::Spacing;
pub use speed_limits::SpeedLimits;
pub use timed::{Phase, Stop, TimedPath, TimedPose, TimedState, steer_rate_rad_per_s};

use crate::geometry::Point2;
use crate::map::Cell;

/// A chain of neighboring cells, from start to goal.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct GridPath {
    /// The cells in order.
    pub cells: Vec<Cell>,
}

/// A polyline, from start to goal.
///
/// ```
/// use formicar::Point2;
/// use formicar::path::WaypointPath;
///
/// let points = [[0.0, 0.0], [3.0, 4.0], [3.0, 6.0]].map(|[x, y]| Point2::new(x, y));
/// assert_eq!(WaypointPath { points: points.to_vec() }.length_m(), 7.0);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WaypointPath {
    /// The corners in order, meters.
    pub points: Vec<Point2>,
}

impl WaypointPath {
    /// Length in meters.
    pub fn length_m(&self) -> f64 {
        self.points.windows(2).map(|w| w[0].distance(w[1])).sum()
    }
}
