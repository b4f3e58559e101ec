//! The input of a control law.

use super::stretch::Stretch;
use crate::geometry::Pose2;

/// A vehicle on its stretch, in the travel frame.
pub(super) struct View<'a> {
    pub(super) stretch: &'a Stretch,
    /// Length driven on the stretch.
    pub(super) driven_m: f64,
    /// The place on the stretch that is nearest to the rear axle.
    pub(super) foot_m: f64,
    pub(super) pose: Pose2,
    pub(super) wheelbase_m: f64,
    pub(super) speed_mps: f64,
}
