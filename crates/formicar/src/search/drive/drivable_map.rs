//! A map prepared for the motions of a vehicle, once for all queries.

use super::drivable_cells::DrivableCells;
use super::{HybridAstarConfig, Inflation};
use crate::collision::{Body, ObstacleMap};
use crate::layers::DriveMasks;
use crate::map::{CellRegion, MoveMasks, PaddedGrid};
use crate::vehicle::{Gears, PrimitiveSet, Vehicle, VehicleError};
use std::sync::Arc;

/// A step leads out of its state: it is longer than the state's diagonal.
const STATES_PER_STEP: f64 = 1.5;

/// Obstacles, body, motions and masks: everything that does not depend on the query.
#[derive(Debug)]
pub struct DrivableMap {
    obstacles: Arc<ObstacleMap>,
    parts: DrivableMapParts,
}

/// A [`DrivableMap`] without its obstacles, while these are changed.
#[derive(Clone, Debug)]
pub struct DrivableMapParts {
    motions: Arc<Motions>,
    cells: DrivableCells,
}

impl DrivableMapParts {
    /// The same map, prepared, that has changed in a rectangle at most. The cost is that of the
    /// rectangle; masks and the moves of the rest are kept.
    pub fn on(mut self, obstacles: Arc<ObstacleMap>, changed: Option<&CellRegion>) -> DrivableMap {
        if let Some(changed) = changed {
            self.cells.refresh(&obstacles, changed);
        }
        DrivableMap {
            obstacles,
            parts: self,
        }
    }
}

/// Everything that depends on vehicle and resolution, and not on the cells of the map.
#[derive(Debug)]
struct Motions {
    body: Body,
    coarse: Lattice,
    fine: Lattice,
    radius_m: f64,
}

/// The motions of a vehicle, their swept masks, and the size of a state.
#[derive(Debug)]
pub(super) struct Lattice {
    pub(super) masks: DriveMasks,
    pub(super) state_m: f64,
}

impl DrivableMap {
    /// Prepares a map for a vehicle; masks and moves are made when they are first needed.
    ///
    /// # Errors
    /// A vehicle that does not steer.
    pub fn new(
        obstacles: Arc<ObstacleMap>,
        vehicle: &Vehicle,
        config: &HybridAstarConfig,
    ) -> Result<Self, VehicleError> {
        let resolution_m = obstacles.frame().resolution_m();
        let radius_m = vehicle.min_turning_radius_m();
        // A cell of the map may be larger than the turning circle: half of that is the longest.
        let step_m = (config.step_radii * radius_m)
            .max(1.5 * resolution_m)
            .min(3.0 * radius_m);
        let n_headings = config.angle_quantization_bins as usize;
        let lattice = |n_headings, step_m| -> Result<Lattice, VehicleError> {
            let primitives = PrimitiveSet::new(vehicle, n_headings, step_m, Gears::Both)?;
            Ok(Lattice {
                masks: DriveMasks::new(vehicle, primitives, resolution_m),
                state_m: step_m / STATES_PER_STEP,
            })
        };
        let coarse = lattice(n_headings, step_m)?;
        let fine = lattice(
            (4 * n_headings).min(360),
            (0.25 * step_m).max(resolution_m).min(3.0 * radius_m),
        )?;
        let reach = coarse.masks.reach_cells().max(fine.masks.reach_cells());
        let body = Body::new(vehicle);
        let cells = DrivableCells::new(&obstacles, reach, inflations_m(&body, vehicle));
        let motions = Arc::new(Motions {
            body,
            coarse,
            fine,
            radius_m,
        });
        Ok(DrivableMapParts { motions, cells }.on(obstacles, None))
    }

    /// Releases the obstacles, so that they can be changed in place; parts still in use elsewhere
    /// are copied.
    pub fn into_parts(map: Arc<Self>) -> DrivableMapParts {
        match Arc::try_unwrap(map) {
            Ok(map) => map.parts,
            Err(shared) => shared.parts.clone(),
        }
    }

    /// The prepared map.
    pub fn obstacles(&self) -> &Arc<ObstacleMap> {
        &self.obstacles
    }

    /// The vehicle's body.
    pub fn body(&self) -> &Body {
        &self.parts.motions.body
    }

    /// The least turning radius, meters.
    pub fn radius_m(&self) -> f64 {
        self.parts.motions.radius_m
    }

    pub(super) fn padded(&self) -> &PaddedGrid {
        &self.parts.cells.padded
    }

    pub(super) fn coarse(&self) -> &Lattice {
        &self.parts.motions.coarse
    }

    pub(super) fn fine(&self) -> &Lattice {
        &self.parts.motions.fine
    }

    /// The moves of a goal field on inflated obstacles, and the width of its cells in map cells.
    pub(super) fn moves(&self, inflation: Inflation) -> (&MoveMasks, u32) {
        self.parts.cells.moves(&self.obstacles, inflation)
    }
}

/// Radii of inflation for the goal field, largest first: halfway to the width that the body sweeps
/// in its tightest turn, which leaves gaps that can mostly be driven, with a quarter of the body's
/// width and without; the body's inner disc, which
/// leaves gaps that are wide enough to drive straight; and the least distance of the rear axle from
/// any obstacle, which closes no gap wrongly.
fn inflations_m(body: &Body, vehicle: &Vehicle) -> [f64; 4] {
    let sure = vehicle.inradius_m().max(0.0);
    let wide = body.inner_radius_m().max(sure);
    let turning = 0.5 * body.swept_width_m(vehicle.min_turning_radius_m());
    let between = 0.5 * (wide + turning.max(wide));
    [between + 0.25 * vehicle.width_m(), between, wide, sure]
}
