//! Costs of paths: over cells, as a polyline that a car steers along, or as a driven chain of arcs.

mod drive;
mod drive_meter;
mod grid_path;
mod polyline;
mod straightness;
mod vehicle_cost;

pub use drive::DriveCost;
pub use drive_meter::{DriveMeter, SoftCost};
pub use grid_path::{PathCost, StepCounts};
pub use polyline::{PolylineCost, SteeredLine, SteeringCost, SteeringMeter};
pub use straightness::Straightness;
pub use vehicle_cost::VehicleCost;
