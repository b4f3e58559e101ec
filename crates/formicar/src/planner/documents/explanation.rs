//! Why there is no path, for programs and pictures: places and measures.

use crate::map::Cell;
use crate::planner::PlanError;
use crate::scenario::ScenarioError;

/// The obstacle to a path, as far as it is known.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Explanation {
    /// The leg that failed, counted from 1; null without via points.
    pub leg: Option<usize>,
    /// A pose at which the vehicle cannot stand: a request that cannot be asked.
    pub collision: Option<Collision>,
    /// Two parts of the map that are not connected for any vehicle of this kind.
    pub disconnected: Option<Disconnected>,
    /// The narrowest place on the widest way.
    pub gap: Option<Gap>,
}

/// A footprint on obstacles.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Collision {
    /// Start, goal or which via point.
    pub end: String,
    /// The obstacle cells that it covers, `[column, row]`; none where it reaches off the map.
    pub cells: Vec<[u32; 2]>,
}

/// Start and goal in different parts of the ground where the vehicle's rear axle can be at all.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Disconnected {
    /// The axle's center keeps at least this from obstacles, meters: the largest disc about it
    /// inside the footprint.
    pub disc_radius_m: f64,
    /// Cells of the start's part.
    pub n_cells_at_start: u32,
    /// Cells of the goal's part; 0 where the goal lies in none.
    pub n_cells_at_goal: u32,
}

/// A narrow place.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Gap {
    /// Its middle, world coordinates, meters.
    pub x: f64,
    /// Its middle, world coordinates, meters.
    pub y: f64,
    /// Its width, to about a cell, meters.
    pub gap_m: f64,
    /// The vehicle's width, meters.
    pub vehicle_width_m: f64,
}

impl PlanError {
    /// The obstacle in the way of a request that cannot be asked; none for other errors.
    pub fn explanation(&self) -> Option<Explanation> {
        let Self::Scenario(ScenarioError::Occupied { which, cells, .. }) = self else {
            return None;
        };
        let pair = |cell: &Cell| [cell.col, cell.row];
        Some(Explanation {
            collision: Some(Collision {
                end: which.to_string(),
                cells: cells.iter().map(pair).collect(),
            }),
            ..Explanation::default()
        })
    }
}
