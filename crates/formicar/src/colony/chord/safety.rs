//! Collision checks of steps.

use crate::collision::{Body, Drive, ObstacleMap};
use crate::geometry::{Point2, Pose2};
use crate::layers::SweptMasks;
use crate::map::{BitGrid, Cell};
use crate::parameters::{parameters, rules};
use crate::vehicle::{Vehicle, VehicleError};

rules! {
    /// phi1 of Li 2024 (16-17): a step is infinitely dear where it is not safe.
    pub enum Safety {
        /// The footprint, turned into the step's direction, keeps off obstacles with a margin.
        Footprint(FootprintSafety),
        /// The disc about the rear axle that holds the footprint keeps off obstacles: what a map
        /// grown by one radius does.
        Disc,
        /// The goal field alone keeps ants off obstacles.
        None,
    }
}

parameters! {
    /// The margin of the footprint.
    pub struct FootprintSafety {
        /// `L_tr`: margin around the body in cells.
        #[range(0.0..=64.0)]
        pub margin_cells: f64 = 0.5,
    }
}

/// The rule made ready for a map, a vehicle and the steps of a ring.
pub(super) enum Guard {
    Footprint { masks: SweptMasks, body: Box<Body> },
    Disc(Option<BitGrid>),
    None,
}

impl Guard {
    pub(super) fn new(
        rule: &Safety,
        obstacles: &ObstacleMap,
        vehicle: &Vehicle,
        steps: &[(i32, i32)],
    ) -> Result<Self, VehicleError> {
        let resolution_m = obstacles.frame().resolution_m();
        Ok(match rule {
            Safety::Footprint(rule) => {
                let margin_m = rule.margin_cells * resolution_m;
                let own_m = vehicle.parameters().safety_margin_m.unwrap_or(0.0);
                Self::Footprint {
                    masks: SweptMasks::new(vehicle, margin_m, steps, resolution_m),
                    body: Box::new(Body::new(&vehicle.with_safety_margin(own_m + margin_m)?)),
                }
            }
            Safety::Disc => {
                let radius_cells = vehicle.footprint().circumradius() / resolution_m;
                Self::Disc(obstacles.distance().within(radius_cells + 0.5))
            }
            Safety::None => Self::None,
        })
    }

    /// Whether a step from a cell is safe.
    #[inline]
    pub(super) fn is_clear(&self, obstacles: &BitGrid, from: Cell, step: usize, to: Cell) -> bool {
        match self {
            Self::Footprint { masks, .. } => masks.is_clear(obstacles, from, step),
            Self::Disc(closed) => closed
                .as_ref()
                .is_some_and(|closed| !closed.get(to.col as usize, to.row as usize)),
            Self::None => true,
        }
    }

    /// Whether a straight step between two points, grid coordinates, is safe.
    pub(super) fn is_free(&self, obstacles: &ObstacleMap, [from, to]: [Point2; 2]) -> bool {
        let scale = 1.0 / obstacles.frame().resolution_m();
        match self {
            Self::Footprint { body, .. } => {
                let step = to - from;
                let drive = Drive {
                    start: Pose2::at(from, step.angle()),
                    curvature_per_m: 0.0,
                    signed_length_m: step.norm(),
                };
                obstacles.is_free(body, &drive)
            }
            Self::Disc(closed) => closed.as_ref().is_some_and(|closed| {
                !closed.get((to.x * scale) as usize, (to.y * scale) as usize)
            }),
            Self::None => true,
        }
    }
}
