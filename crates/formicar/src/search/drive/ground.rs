//! A map prepared for the motions of a vehicle, once for all queries.

use super::{HybridAstarConfig, Inflation};
use crate::collision::{Body, ObstacleMap};
use crate::layers::DriveMasks;
use crate::map::{BitGrid, Cell, DiagonalRule, MoveMasks, PaddedGrid};
use crate::vehicle::{Gears, PrimitiveSet, Vehicle, VehicleError};
use std::sync::{Arc, OnceLock};

/// A step leads out of its state: it is longer than the state's diagonal.
const STATES_PER_STEP: f64 = 1.5;

/// Obstacles, body, motions and masks: whatever does not depend on the query.
#[derive(Debug)]
pub struct DriveGround {
    obstacles: Arc<ObstacleMap>,
    body: Body,
    padded: PaddedGrid,
    coarse: Lattice,
    fine: Lattice,
    radius_m: f64,
    inflations_m: [f64; 3],
    moves: [OnceLock<MoveMasks>; 3],
}

/// The motions of a vehicle, what they sweep, and the size of the states they lead to.
#[derive(Debug)]
pub(super) struct Lattice {
    pub(super) masks: DriveMasks,
    pub(super) state_m: f64,
}

impl DriveGround {
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
        Ok(Self {
            padded: PaddedGrid::new(obstacles.lethal(), reach),
            inflations_m: inflations_m(&body, vehicle),
            moves: Default::default(),
            obstacles,
            body,
            coarse,
            fine,
            radius_m,
        })
    }

    /// The prepared map.
    pub fn obstacles(&self) -> &Arc<ObstacleMap> {
        &self.obstacles
    }

    /// The vehicle's body.
    pub fn body(&self) -> &Body {
        &self.body
    }

    /// The least turning radius, metres.
    pub fn radius_m(&self) -> f64 {
        self.radius_m
    }

    pub(super) fn padded(&self) -> &PaddedGrid {
        &self.padded
    }

    pub(super) fn coarse(&self) -> &Lattice {
        &self.coarse
    }

    pub(super) fn fine(&self) -> &Lattice {
        &self.fine
    }

    /// Moves between the cells of a field that are free when obstacles are grown by one of the
    /// radii, and how many cells of the map a cell of the field is wide.
    pub(super) fn moves(&self, inflation: Inflation) -> (&MoveMasks, u32) {
        let place = inflation as usize;
        let resolution_m = self.obstacles.frame().resolution_m();
        // Only what blocks a position wherever it lies in its cell: from the cell's center to the
        // position half a diagonal, from the obstacle's center to its side half a cell.
        let radius =
            self.inflations_m[place] / resolution_m - (std::f64::consts::FRAC_1_SQRT_2 - 0.5);
        let stride = match inflation {
            Inflation::Sure => 1,
            _ => stride(radius),
        };
        let moves = self.moves[place].get_or_init(|| {
            let distance = self.obstacles.distance();
            let truncation = f64::from(distance.truncation_cells());
            let blocked = distance.within(radius.clamp(0.0, truncation - 0.5));
            let blocked = blocked.unwrap_or_else(|| self.obstacles.lethal().clone());
            MoveMasks::new(
                &thinned(&blocked, stride as usize),
                DiagonalRule::AtMostOneObstacle,
            )
        });
        (moves, stride)
    }
}

/// How many cells of the map a cell of the field may be wide: an odd number, so that both have
/// their centers in one place. Half a diagonal step is then shorter than the radius by which
/// obstacles were grown, so that no step between free cells leads over one.
fn stride(radius_cells: f64) -> u32 {
    let most = (radius_cells / CELLS_PER_STRIDE) as u32;
    (most.max(1) - 1) / 2 * 2 + 1
}

/// The radius by which obstacles are grown is at least so many strides.
const CELLS_PER_STRIDE: f64 = 1.1;

/// The cells in the middle of blocks of `stride` times `stride` cells.
fn thinned(cells: &BitGrid, stride: usize) -> BitGrid {
    if stride == 1 {
        return cells.clone();
    }
    let (n_cols, n_rows) = (
        cells.n_cols().div_ceil(stride),
        cells.n_rows().div_ceil(stride),
    );
    let mut thinned = BitGrid::new(n_cols, n_rows);
    let middle = |i: usize, n: usize| (i * stride + stride / 2).min(n - 1);
    for row in 0..n_rows {
        for col in 0..n_cols {
            if cells.get(middle(col, cells.n_cols()), middle(row, cells.n_rows())) {
                thinned.insert(Cell::new(col as u32, row as u32));
            }
        }
    }
    thinned
}

/// Radii by which to grow obstacles for the goal field, most first: halfway to what the body
/// sweeps in its tightest turn, which leads through gaps that can mostly be driven; the body's
/// inner disc, which leads through gaps that are wide enough to go straight; and what the rear
/// axle can never get nearer than, which keeps nothing out wrongly.
fn inflations_m(body: &Body, vehicle: &Vehicle) -> [f64; 3] {
    let sure = vehicle.footprint().inradius().max(0.0);
    let wide = body.inner_radius_m().max(sure);
    let turning = 0.5 * body.swept_width_m(vehicle.min_turning_radius_m());
    [0.5 * (wide + turning.max(wide)), wide, sure]
}
