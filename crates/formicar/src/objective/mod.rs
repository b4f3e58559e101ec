//! What a path costs: over cells, as a polyline that a car will steer along, or as a driven chain
//! of arcs.

mod drive;
mod drive_meter;
mod grid_path;
mod polyline;
mod straightness;

pub use drive::DriveCost;
pub use drive_meter::{DriveMeter, SoftCost};
pub use grid_path::{PathCost, StepCounts};
pub use polyline::{PolylineCost, SteeredLine, SteeringCost, SteeringMeter};
pub use straightness::Straightness;
