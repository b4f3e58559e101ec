//! Car-like vehicles: measures, footprint, limits and motion.

mod parameters;
mod presets;
mod shape;

pub use parameters::{FootprintSpec, VehicleParameters};
pub use presets::PRESET_NAMES;
pub use shape::{Motion, Vehicle, VehicleError};
