//! Collision checks and costs of the improvement.

use super::ImproveConfig;
use crate::collision::{Body, Drive, ObstacleMap};
use crate::geometry::{Arc, Pose2};
use crate::objective::DriveMeter;
use crate::scenario::GoalRegion;
use crate::vehicle::Gears;

/// A body on a map with its parameters; grid coordinates.
#[derive(Clone, Copy)]
pub(super) struct ImproveTask<'a> {
    pub(super) obstacles: &'a ObstacleMap,
    pub(super) body: &'a Body,
    pub(super) radius_m: f64,
    pub(super) gears: Gears,
    pub(super) end: Option<&'a GoalRegion>,
    pub(super) meter: DriveMeter<'a>,
    pub(super) config: &'a ImproveConfig,
}

impl ImproveTask<'_> {
    /// Whether the body is free along an arc.
    pub(super) fn is_free(&self, start: Pose2, arc: Arc) -> bool {
        let drive = Drive {
            start,
            curvature_per_m: arc.curvature_per_m,
            signed_length_m: arc.signed_length_m,
        };
        self.obstacles.is_free_by_steps(self.body, &drive)
    }

    /// Whether the clearance is certainly below a value at one of several places along an arc,
    /// about a body length apart; each takes a look at one cell.
    pub(super) fn is_certainly_nearer(&self, start: Pose2, arc: Arc, clearance_m: f64) -> bool {
        let n_places = (arc.length_m() / self.body.reach_m()).ceil().max(1.0);
        (1..=n_places as usize).any(|i| {
            let share = i as f64 / n_places;
            let part = Arc::new(arc.curvature_per_m, share * arc.signed_length_m);
            let pose = part.end_from(start);
            self.obstacles.clearance_ceiling_m(self.body, pose) < clearance_m
        })
    }
}
