//! Car-like vehicles: measures, footprint, limits and motion.

mod kinematics;
mod parameters;
mod presets;
mod primitives;
mod shape;
mod suspension;

pub use kinematics::{AckermannAxles, BicycleInput, BicycleState, Wheels};
pub use parameters::{FootprintSpec, VehicleParameters};
pub use presets::PRESET_NAMES;
pub use primitives::{Alignment, Gears, Primitive, PrimitiveSet};
pub use shape::{Motion, Vehicle, VehicleError};
pub use suspension::{SteeringDemand, SuspendedSteering, SuspensionParameters};
