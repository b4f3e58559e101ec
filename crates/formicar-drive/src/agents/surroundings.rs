//! What agents see.

use crate::solid::Solid;
use crate::world::World;

/// What agents see.
pub(crate) struct Surroundings<'a> {
    pub(crate) world: &'a World,
    /// The parts of the robot.
    pub(crate) robot: &'a [Solid],
}
