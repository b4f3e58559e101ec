//! Walkers by social forces.
//!
//! D. Helbing and P. Molnar, *Social force model for pedestrian dynamics*, Phys. Rev. E 51 (1995):
//! a walker is drawn to the wished velocity within a relaxation time (2), and pushed away from others
//! by a force that falls exponentially with the gap (3). The constants are those of Helbing, Farkas
//! and Vicsek (2000), scaled to unit mass, without body contact: nobody is pushed through another.

use super::surroundings::Surroundings;
use crate::solid::Solid;
use formicar::Point2;

/// Time within which a walker takes up the wished velocity, seconds.
const RELAXATION_S: f64 = 0.5;
/// Push of another at contact, m/s^2, and the gap over which it falls by e, meters.
const PUSH_MPS2: f64 = 3.0;
const PUSH_RANGE_M: f64 = 0.3;
/// Push of the robot on one who yields, felt from farther away.
const ROBOT_PUSH_MPS2: f64 = 6.0;
const ROBOT_RANGE_M: f64 = 0.6;
/// Nobody runs faster than this, in wished speeds.
const FASTEST: f64 = 1.3;
/// Others farther away are not felt, meters.
const FELT_M: f64 = 3.0;

/// A walker at a moment.
pub(super) struct Walk<'a> {
    pub(super) body: &'a Solid,
    pub(super) velocity_mps: Point2,
    pub(super) target: Point2,
    pub(super) speed_mps: f64,
    pub(super) yields: bool,
}

impl Walk<'_> {
    /// The velocity after a time.
    pub(super) fn next_velocity_mps<'b>(
        &self,
        others: impl Iterator<Item = &'b Solid>,
        around: &Surroundings,
        duration_s: f64,
    ) -> Point2 {
        let way = self.target - self.body.center();
        let wished = way * (self.speed_mps / way.norm().max(self.speed_mps * RELAXATION_S));
        let mut force = (wished - self.velocity_mps) * (1.0 / RELAXATION_S);
        for other in others {
            force = force + self.push(other, PUSH_MPS2, PUSH_RANGE_M);
        }
        for solid in around.world.solids() {
            force = force + self.push(solid, PUSH_MPS2, PUSH_RANGE_M);
        }
        if self.yields {
            for part in around.robot {
                force = force + self.push(part, ROBOT_PUSH_MPS2, ROBOT_RANGE_M);
            }
        }
        let velocity = self.velocity_mps + force * duration_s;
        let most = FASTEST * self.speed_mps;
        velocity * (most / velocity.norm().max(most).max(f64::MIN_POSITIVE))
    }

    fn push(&self, other: &Solid, push_mps2: f64, range_m: f64) -> Point2 {
        if self.body.gap_bound_m(other) > FELT_M {
            return Point2::default();
        }
        let near = self.body.nearness(other);
        let away = self.body.center() - near.to;
        let strength = push_mps2 * (-near.gap_m / range_m).exp();
        away * (strength / away.norm().max(1e-6))
    }
}
