//! Changing the map of a planner, at the cost of what has changed.

use super::{PlanError, Planner};
use crate::map::{CellRegion, regrow};
use crate::search::{DrivableMap, DrivableMapParts};
use std::sync::Arc;

impl Planner {
    /// Puts new values into a rectangle of cells of the map, row by row, lowest row first: -1
    /// unknown, 0 free, to 100 occupied. The frame stays, and with it the vehicle's masks.
    ///
    /// Afterwards the planner is, to the bit of every path, one made for the changed map. A map
    /// that others hold too is copied first. Cost is proportional to the cells of the rectangle
    /// that change, grown by twice the truncation of the distance transform (64 cells); the next
    /// query relabels which ground hangs together.
    ///
    /// # Errors
    /// A part of the rectangle off the map, another number of values than cells, or a value
    /// outside -1..=100; nothing is changed then.
    pub fn update_map(&mut self, region: CellRegion, values: &[i8]) -> Result<(), PlanError> {
        region.check(self.obstacles.frame(), values)?;
        // While the ground holds the map too, it could not be changed where it is.
        let ground = self.drive_ground.take().map(DrivableMap::into_parts);
        let changed = Arc::make_mut(&mut self.obstacles).update(&region, values)?;
        let on_map = |parts: DrivableMapParts| parts.on(self.obstacles.clone(), changed.as_ref());
        self.drive_ground = ground.map(on_map).map(Arc::new);
        let Some(changed) = changed else {
            return Ok(());
        };
        self.axle_ground = None;
        let growth_cells = self.growth_cells();
        if let Some(cells) = &mut self.cells {
            let distance = self.obstacles.distance();
            regrow(&mut cells.moves, distance, &changed, (growth_cells, 1));
        }
        Ok(())
    }
}
