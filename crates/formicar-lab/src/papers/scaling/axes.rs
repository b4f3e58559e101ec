//! The quantities that grow, and their grounds.

use crate::papers::experiment::{Ground, Scale, Variant};
use crate::words::named;
use anyhow::{Context, Result};
use formicar::map::generate::{ScatterParameters, free_pose_pairs, scattered_obstacles};
use formicar::numeric::Seed;
use formicar::planner::{ChordParameters, ColonyParameters, PlannerName};
use formicar::scenario::{GoalHeading, Request};
use formicar::vehicle::{Vehicle, VehicleParameters};

/// Side of a cell, meters.
const RESOLUTION_M: f64 = 0.2;
/// Share of occupied cells, where it is not what grows.
const DENSITY: f64 = 0.02;
/// Columns and rows, where they are not what grows.
const SIDE: usize = 400;
/// Ants of an iteration where threads grow: so many that they take most of a query.
const N_ANTS_OF_THREADS: u32 = 640;
/// Pairs of poses of which the farthest apart are asked.
const N_PAIRS: usize = 8;
/// Seed of the maps and the ends.
const SEED: Seed = Seed(21);
/// Search steps after which a query gives up.
const BUDGET_STEPS: u64 = 50_000_000;

named! {
    /// A quantity that grows.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub(super) enum Quantity {
        Cells = "cells",
        Density = "density",
        VehicleSize = "vehicle",
        Ants = "ants",
        Threads = "threads",
    }
}

/// One value of it: ground, planner and threads.
pub(super) struct Point {
    pub(super) x: f64,
    pub(super) ground: Ground,
    pub(super) variants: Vec<Variant>,
    pub(super) n_threads: usize,
}

impl Quantity {
    /// The meaning of its numbers.
    pub(super) fn about(self) -> &'static str {
        match self {
            Self::Cells => "cells of the map",
            Self::Density => "share of occupied cells",
            Self::VehicleSize => "length of the vehicle, meters",
            Self::Ants => "ants of an iteration",
            Self::Threads => "threads",
        }
    }

    /// Its values, ascending.
    fn values(self, scale: Scale) -> &'static [f64] {
        let (few, all): (&[f64], &[f64]) = match self {
            // Columns and rows.
            Self::Cells => (
                &[100.0, 180.0, 316.0],
                &[
                    100.0, 180.0, 316.0, 562.0, 1000.0, 1778.0, 3162.0, 5623.0, 10_000.0,
                ],
            ),
            Self::Density => (&[0.005, 0.01, 0.02], &[0.005, 0.01, 0.02, 0.03, 0.04, 0.06]),
            // Times the vehicle of Lei & Zheng 2020.
            Self::VehicleSize => (&[0.5, 0.7, 1.0], &[0.35, 0.5, 0.7, 1.0, 1.4, 2.0]),
            Self::Ants => (&[10.0, 20.0, 40.0], &[10.0, 20.0, 40.0, 80.0, 160.0]),
            Self::Threads => (&[1.0, 2.0, 4.0], &[1.0, 2.0, 4.0]),
        };
        if scale.is_small { few } else { all }
    }

    /// All of its points.
    pub(super) fn points(self, scale: Scale) -> Result<Vec<Point>> {
        let values = self.values(scale).iter();
        values.map(|&value| self.point(value)).collect()
    }

    fn point(self, value: f64) -> Result<Point> {
        let side = if self == Self::Cells {
            value as usize
        } else {
            SIDE
        };
        let density = if self == Self::Density {
            value
        } else {
            DENSITY
        };
        let size = if self == Self::VehicleSize {
            value
        } else {
            1.0
        };
        let vehicle = scaled(size)?;
        let x = match self {
            Self::Cells => value * value,
            Self::VehicleSize => {
                let (low, high) = vehicle.footprint().bounds();
                high.x - low.x
            }
            _ => value,
        };
        let n_ants = match self {
            Self::Ants => Some(value as u32),
            Self::Threads => Some(N_ANTS_OF_THREADS),
            _ => None,
        };
        Ok(Point {
            x,
            ground: ground(side, density, vehicle)?,
            variants: self
                .planners()
                .iter()
                .map(|&p| variant(p, n_ants))
                .collect(),
            n_threads: if self == Self::Threads {
                value as usize
            } else {
                1
            },
        })
    }

    /// Colonies for ants and threads, which others have none of.
    fn planners(self) -> &'static [PlannerName] {
        match self {
            Self::Ants | Self::Threads => &[PlannerName::Aco, PlannerName::Faco2024],
            _ => &[
                PlannerName::Formicar,
                PlannerName::HybridAstar,
                PlannerName::Astar,
                PlannerName::Faco2024,
            ],
        }
    }
}

fn variant(planner: PlannerName, n_ants: Option<u32>) -> Variant {
    let mut variant = Variant::of(planner);
    if let Some(n_ants) = n_ants {
        if let Some(parameters) = variant.config.family_mut::<ColonyParameters>() {
            parameters.colony.n_ants = n_ants;
        }
        if let Some(parameters) = variant.config.family_mut::<ChordParameters>() {
            parameters.chords.n_ants = n_ants;
        }
    }
    variant
}

/// The vehicle of Lei & Zheng 2020 with all lengths times a factor.
fn scaled(factor: f64) -> Result<Vehicle> {
    let own = Vehicle::lei2020();
    let own = own.parameters();
    let times = |length_m: Option<f64>| length_m.map(|length_m| factor * length_m);
    Ok(Vehicle::new(VehicleParameters {
        wheelbase_m: times(own.wheelbase_m),
        track_width_m: times(own.track_width_m),
        front_overhang_m: times(own.front_overhang_m),
        rear_overhang_m: times(own.rear_overhang_m),
        width_m: times(own.width_m),
        ..own.clone()
    })?)
}

/// Scattered obstacles, and the two poses farthest apart of some pairs.
fn ground(side: usize, density: f64, vehicle: Vehicle) -> Result<Ground> {
    let parameters = ScatterParameters {
        n_cols: side,
        n_rows: side,
        resolution_m: RESOLUTION_M,
        density,
        ..ScatterParameters::default()
    };
    let grid = scattered_obstacles(&parameters, SEED)?;
    let pairs = free_pose_pairs(&grid, &vehicle, N_PAIRS, SEED)?.into_iter();
    let apart_m = |(a, b): &(formicar::geometry::Pose2, formicar::geometry::Pose2)| {
        a.position().distance(b.position())
    };
    let farthest = pairs.max_by(|a, b| apart_m(a).total_cmp(&apart_m(b)));
    let (start, goal) = farthest.context("no free poses")?;
    Ok(Ground {
        map: format!(
            "{side} x {side}, density {density}, vehicle {:.2} m wide",
            vehicle.width_m()
        ),
        grid,
        vehicle,
        request: Request {
            goal_heading: GoalHeading::Any,
            budget_steps: Some(BUDGET_STEPS),
            ..Request::new(start, goal)
        },
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_quantity_grows_and_has_grounds() {
        for quantity in Quantity::ALL {
            let points = quantity.points(Scale::QUICK).unwrap();
            assert!(points.len() >= 3, "{quantity:?}");
            assert!(points.windows(2).all(|pair| pair[0].x < pair[1].x));
            assert!(points.iter().all(|point| !point.variants.is_empty()));
            let full = quantity.values(Scale::FULL);
            assert!(
                full.starts_with(quantity.values(Scale::QUICK))
                    || quantity == Quantity::VehicleSize
            );
        }
        let ants = Quantity::Ants.points(Scale::QUICK).unwrap();
        let [colony, chords] = &ants[1].variants[..] else {
            panic!("two colonies")
        };
        assert_eq!(colony.config.colony().unwrap().colony.n_ants, 20);
        let chords = chords.config.family::<ChordParameters>().unwrap();
        assert_eq!(chords.chords.n_ants, 20);
        let vehicles = Quantity::VehicleSize.points(Scale::QUICK).unwrap();
        assert!((vehicles[2].x - 3.0).abs() < 1e-9, "{}", vehicles[2].x);
    }
}
