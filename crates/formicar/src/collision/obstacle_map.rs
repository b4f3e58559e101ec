//! A map made ready for distance queries: the map set-up that every query shares.

use crate::geometry::Pose2;
use crate::map::{BitGrid, GridFrame, OccupancyGrid};

/// The lethal cells of a map, its frame and its distance transform.
#[derive(Clone, Debug)]
pub struct ObstacleMap {
    frame: GridFrame,
    lethal: BitGrid,
}

impl ObstacleMap {
    /// Prepares a map: cost proportional to its cells.
    pub fn new(map: &OccupancyGrid) -> Self {
        Self {
            frame: *map.frame(),
            lethal: map.lethal_cells(),
        }
    }

    /// Size, resolution and origin of the map.
    pub fn frame(&self) -> &GridFrame {
        &self.frame
    }

    /// Occupied and unknown cells.
    pub fn lethal(&self) -> &BitGrid {
        &self.lethal
    }

    /// A world pose in grid coordinates.
    pub fn to_grid(&self, world: Pose2) -> Pose2 {
        self.frame.to_grid(world)
    }
}
