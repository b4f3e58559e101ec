//! A map as searches prepare it for a vehicle: kept from query to query, repaired where cells
//! change.

use super::door::AxleGround;
use crate::collision::ObstacleMap;
use crate::map::{BitGrid, CellRegion, DiagonalRule, MapError, MoveMasks, regrow};
use crate::progress::{Limits, Status};
use crate::search::{AstarWorkspace, DrivableMap, DrivableMapParts, HybridAstarConfig};
use crate::vehicle::{Motion, Vehicle, VehicleError};
use std::sync::Arc;

/// Prepared moves and memory of searches over cells, reused from query to query.
#[derive(Clone, Debug)]
pub struct PreparedCells {
    /// Moves on obstacles grown by half the vehicle's width.
    pub moves: MoveMasks,
    /// Memory of A*.
    pub workspace: AstarWorkspace,
}

/// A map and a vehicle, with what searches have prepared for them.
#[derive(Clone, Debug)]
pub(super) struct PreparedMap {
    pub(super) obstacles: Arc<ObstacleMap>,
    pub(super) vehicle: Vehicle,
    cells: Option<PreparedCells>,
    /// For searches that drive, with the lattice that it was made for.
    drive: Option<(HybridAstarConfig, Arc<DrivableMap>)>,
    /// Connected parts of the map for the vehicle's rear axle.
    axle: Option<Arc<AxleGround>>,
}

impl PreparedMap {
    pub(super) fn new(obstacles: Arc<ObstacleMap>, vehicle: Vehicle) -> Self {
        Self {
            obstacles,
            vehicle,
            cells: None,
            drive: None,
            axle: None,
        }
    }

    /// The map prepared for the vehicle's motions, once per lattice.
    pub(super) fn drive_ground(
        &mut self,
        config: &HybridAstarConfig,
    ) -> Result<Arc<DrivableMap>, VehicleError> {
        if let Some((of, ground)) = &self.drive
            && of == config
        {
            return Ok(ground.clone());
        }
        let ground = DrivableMap::new(self.obstacles.clone(), &self.vehicle, config)?;
        let ground = Arc::new(ground);
        self.drive = Some((config.clone(), ground.clone()));
        Ok(ground)
    }

    /// The connected parts for the rear axle, labeled once.
    ///
    /// # Errors
    /// Deadline or cancel.
    pub(super) fn axle_ground(&mut self, limits: &mut Limits) -> Result<Arc<AxleGround>, Status> {
        if let Some(ground) = &self.axle {
            return Ok(ground.clone());
        }
        let ground = AxleGround::new(&self.obstacles, &self.vehicle, limits)?;
        Ok(self.axle.insert(Arc::new(ground)).clone())
    }

    /// Takes what searches over cells reuse; [`Self::keep_cells`] puts it back.
    pub(super) fn take_cells(&mut self, rule: DiagonalRule) -> PreparedCells {
        let kept = self.cells.take().filter(|cells| cells.moves.rule() == rule);
        kept.unwrap_or_else(|| PreparedCells {
            moves: MoveMasks::new(&self.grown(), rule),
            workspace: AstarWorkspace::new(),
        })
    }

    pub(super) fn keep_cells(&mut self, cells: PreparedCells) {
        self.cells = Some(cells);
    }

    /// Cells on which the vehicle's middle may not be: nearer to an obstacle's square than half its
    /// width, which is half a cell more from center to center. For a point, obstacles.
    fn grown(&self) -> BitGrid {
        let grown = self.obstacles.distance().within(self.growth_cells());
        grown.unwrap_or_else(|| self.obstacles.lethal().clone())
    }

    /// Growth of obstacles from center to center, at most what the distance transform resolves.
    pub(super) fn growth_cells(&self) -> f64 {
        if self.vehicle.motion() == Motion::Point {
            return 0.0;
        }
        let limit = f64::from(self.obstacles.distance().truncation_cells()) - 0.5;
        let half_width_cells = 0.5 * self.vehicle.width_m() / self.obstacles.frame().resolution_m();
        (half_width_cells + 0.5).min(limit)
    }

    /// Puts new values into a rectangle of cells; see [`Planner::update_map`](super::Planner).
    pub(super) fn update(&mut self, region: &CellRegion, values: &[i8]) -> Result<(), MapError> {
        region.check(self.obstacles.frame(), values)?;
        // While the ground holds the map too, it could not be changed where it is.
        let drive = self.drive.take();
        let drive = drive.map(|(config, ground)| (config, DrivableMap::into_parts(ground)));
        let changed = Arc::make_mut(&mut self.obstacles).update(region, values)?;
        let on_map = |parts: DrivableMapParts| parts.on(self.obstacles.clone(), changed.as_ref());
        self.drive = drive.map(|(config, parts)| (config, Arc::new(on_map(parts))));
        let Some(changed) = changed else {
            return Ok(());
        };
        self.axle = None;
        let growth_cells = self.growth_cells();
        if let Some(cells) = &mut self.cells {
            let distance = self.obstacles.distance();
            regrow(&mut cells.moves, distance, &changed, (growth_cells, 1));
        }
        Ok(())
    }
}
