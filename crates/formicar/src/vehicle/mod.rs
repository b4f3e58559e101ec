//! Car-like vehicles: measures, footprint, limits and motion.

mod error;
mod gears;
mod kinematics;
mod parameters;
mod presets;
mod primitives;
mod shape;
mod suspension;
mod virtual_wheel;

pub use error::VehicleError;
pub use gears::Gears;
pub use kinematics::{AckermannAxles, BicycleInput, BicycleState, Wheels};
pub use parameters::{FootprintSpec, VehicleParameters};
pub use presets::PRESET_NAMES;
pub use primitives::{Alignment, Primitive, PrimitiveSet};
pub use shape::{Motion, Vehicle};
pub use suspension::{SteeringDemand, SuspendedSteering, SuspensionParameters};
pub use virtual_wheel::BodyMotion;
