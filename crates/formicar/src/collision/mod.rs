//! Exact clearance of a vehicle's body, standing or driving, to occupied cell squares.
//!
//! Everything here works in grid coordinates (metres from the map's lower left corner along its
//! axes); [`ObstacleMap::to_grid`] carries world poses there.

mod obstacle_map;

pub use obstacle_map::ObstacleMap;
