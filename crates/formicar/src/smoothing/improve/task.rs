//! What a path is improved for: what is free, and what driving costs.

use super::ImproveConfig;
use crate::collision::{Body, Drive, ObstacleMap};
use crate::geometry::{Arc, Pose2};
use crate::objective::DriveMeter;
use crate::scenario::MotionMode;

/// A body on a map with its parameters; grid coordinates.
#[derive(Clone, Copy)]
pub(super) struct Task<'a> {
    pub(super) obstacles: &'a ObstacleMap,
    pub(super) body: &'a Body,
    pub(super) radius_m: f64,
    pub(super) motion: MotionMode,
    pub(super) meter: DriveMeter<'a>,
    pub(super) config: &'a ImproveConfig,
}

impl Task<'_> {
    /// Whether the body is free along an arc.
    pub(super) fn is_free(&self, start: Pose2, arc: Arc) -> bool {
        let drive = Drive {
            start,
            curvature_per_m: arc.curvature_per_m,
            signed_length_m: arc.signed_length_m,
        };
        self.obstacles.is_free(self.body, &drive)
    }

    /// Whether the body certainly hits something at the end or halfway: a look at two cells.
    pub(super) fn certainly_hits(&self, start: Pose2, arc: Arc) -> bool {
        let half = Arc::new(arc.curvature_per_m, 0.5 * arc.signed_length_m);
        [half, arc].into_iter().any(|arc| {
            let pose = arc.end_from(start);
            self.obstacles.clearance_ceiling_m(self.body, pose) < 0.0
        })
    }
}
