//! The errors of a vehicle beside its path.

use super::stretch::{Stretch, faced};
use crate::geometry::{Pose2, wrap_angle};

/// The position of a vehicle relative to a stretch.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Offset {
    /// The place on the stretch that is nearest to the rear axle.
    pub(super) foot_m: f64,
    /// Positive where the vehicle is left of the path, as it faces.
    pub(super) cross_track_m: f64,
    pub(super) heading_rad: f64,
}

impl Offset {
    /// Beside a stretch, looked for from a place on.
    pub(super) fn new(stretch: &Stretch, pose: Pose2, from_m: f64) -> Self {
        let foot_m = stretch.foot_m(pose.position(), 0.0, from_m);
        let on_path = faced(stretch.pose_at(foot_m), stretch.direction);
        Self {
            foot_m,
            ..Self::beside(on_path, pose)
        }
    }

    /// Beside a single pose.
    pub(super) fn beside(on_path: Pose2, pose: Pose2) -> Self {
        let beside = on_path.relative(pose);
        Self {
            foot_m: 0.0,
            cross_track_m: beside.y,
            heading_rad: wrap_angle(beside.heading),
        }
    }
}

/// Largest errors and sums of squares over driven length.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Errors {
    pub(super) max_cross_track_m: f64,
    pub(super) max_heading_rad: f64,
    squared_cross_track: f64,
    squared_heading: f64,
    length_m: f64,
}

impl Errors {
    /// Counts an offset for the length driven to it.
    pub(super) fn add(&mut self, offset: &Offset, length_m: f64) {
        self.max_cross_track_m = self.max_cross_track_m.max(offset.cross_track_m.abs());
        self.max_heading_rad = self.max_heading_rad.max(offset.heading_rad.abs());
        self.squared_cross_track += offset.cross_track_m.powi(2) * length_m;
        self.squared_heading += offset.heading_rad.powi(2) * length_m;
        self.length_m += length_m;
    }

    /// Root mean squares of cross-track and heading error; of a vehicle that stood, its errors.
    pub(super) fn rms(&self) -> (f64, f64) {
        if self.length_m == 0.0 {
            return (self.max_cross_track_m, self.max_heading_rad);
        }
        let root = |squares: f64| (squares / self.length_m).sqrt();
        (root(self.squared_cross_track), root(self.squared_heading))
    }
}
