//! What a path costs before it is driven: over cells, or as a polyline that a car will steer along.

mod grid_path;
mod polyline;
mod straightness;

pub use grid_path::{PathCost, StepCounts};
pub use polyline::{PolylineCost, SteeredLine, SteeringCost, SteeringMeter};
pub use straightness::Straightness;
