//! Exact clearance of a vehicle's body, standing or driving, to occupied cell squares.
//!
//! Everything here works in grid coordinates (meters from the map's lower left corner along its
//! axes); [`ObstacleMap::frame`] carries world poses there and back. Distances are Euclidean,
//! from the closed body to the closed squares of lethal cells and to the map's border, exact up
//! to rounding: a straight sweep is one convex polygon, and along an arc the nearest pair always
//! has a corner of body or square in it, whose track is a circle. A clothoid is swept as arcs with
//! a proven deviation, which is taken off the clearance.

mod along;
mod arc;
mod body;
mod clothoid;
mod contact;
mod convex;
mod estimate;
mod march;
mod nearest;
mod obstacle_map;
mod overlap;
mod sweep;

pub use along::ClearanceAlong;
pub use body::Body;
pub use clothoid::{ClothoidDrive, NearbyDrive};
pub use obstacle_map::ObstacleMap;
pub use overlap::Overlap;
pub use sweep::Drive;

/// A body counts as free where its clearance exceeds this, meters.
pub const MIN_CLEARANCE_M: f64 = 1e-6;
