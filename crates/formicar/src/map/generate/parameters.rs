//! What the generators can be told, with ranges.

use super::GenerateError;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Measures of an alley neighborhood.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct NeighborhoodParameters {
    /// Number of columns, at least 1; columns times resolution must reach 20 m.
    pub n_cols: usize,
    /// Number of rows, at least 1; rows times resolution must reach 20 m.
    pub n_rows: usize,
    /// Side of a cell, metres, 0.02 to 1.
    #[schemars(range(min = 0.02, max = 1.0))]
    pub resolution_m: f64,
    /// Mean width of streets between the house fronts, metres, 4 to 20; each varies by a fifth.
    #[schemars(range(min = 4.0, max = 20.0))]
    pub street_width_m: f64,
    /// Longest side of an area between streets, metres, 30 to 300.
    #[schemars(range(min = 30.0, max = 300.0))]
    pub street_spacing_m: f64,
    /// Narrowest alley, metres, 1 to 6.
    #[schemars(range(min = 1.0, max = 6.0))]
    pub min_alley_width_m: f64,
    /// Widest alley, metres, 1 to 6.
    #[schemars(range(min = 1.0, max = 6.0))]
    pub max_alley_width_m: f64,
    /// Longest side of a block of houses between alleys, metres, 16 to 100.
    #[schemars(range(min = 16.0, max = 100.0))]
    pub block_m: f64,
    /// Share of the last alleys that end blind, 0 to 1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub dead_end_share: f64,
    /// Share of large blocks with a yard inside, reached by a gateway, 0 to 1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub yard_share: f64,
    /// Share of parking places along streets that are taken, 0 to 1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub parked_car_share: f64,
}

impl Default for NeighborhoodParameters {
    fn default() -> Self {
        Self {
            n_cols: 800,
            n_rows: 500,
            resolution_m: 0.2,
            street_width_m: 7.0,
            street_spacing_m: 60.0,
            min_alley_width_m: 2.0,
            max_alley_width_m: 4.0,
            block_m: 25.0,
            dead_end_share: 0.35,
            yard_share: 0.6,
            parked_car_share: 0.7,
        }
    }
}

impl NeighborhoodParameters {
    pub(super) fn check(&self) -> Result<(), GenerateError> {
        in_range("resolution_m", self.resolution_m, [0.02, 1.0])?;
        in_range("street_width_m", self.street_width_m, [4.0, 20.0])?;
        in_range("street_spacing_m", self.street_spacing_m, [30.0, 300.0])?;
        in_range("min_alley_width_m", self.min_alley_width_m, [1.0, 6.0])?;
        in_range("max_alley_width_m", self.max_alley_width_m, [1.0, 6.0])?;
        in_range("block_m", self.block_m, [16.0, 100.0])?;
        in_range("dead_end_share", self.dead_end_share, [0.0, 1.0])?;
        in_range("yard_share", self.yard_share, [0.0, 1.0])?;
        in_range("parked_car_share", self.parked_car_share, [0.0, 1.0])?;
        if self.min_alley_width_m > self.max_alley_width_m {
            return Err(GenerateError::Reversed {
                low_name: "min_alley_width_m",
                low: self.min_alley_width_m,
                high_name: "max_alley_width_m",
                high: self.max_alley_width_m,
            });
        }
        Ok(())
    }
}

/// Measures of a field of scattered obstacles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ScatterParameters {
    /// Number of columns, at least 1.
    pub n_cols: usize,
    /// Number of rows, at least 1.
    pub n_rows: usize,
    /// Side of a cell, metres, 0.001 to 100.
    #[schemars(range(min = 0.001, max = 100.0))]
    pub resolution_m: f64,
    /// Share of cells that obstacles take, 0 to 0.8; the last obstacle may exceed it.
    #[schemars(range(min = 0.0, max = 0.8))]
    pub density: f64,
    /// Longest side of an obstacle, cells, 1 to 1000; sides are uniform from 1 to this.
    #[schemars(range(min = 1, max = 1000))]
    pub max_obstacle_cells: usize,
}

impl Default for ScatterParameters {
    fn default() -> Self {
        Self {
            n_cols: 200,
            n_rows: 200,
            resolution_m: 0.1,
            density: 0.1,
            max_obstacle_cells: 4,
        }
    }
}

impl ScatterParameters {
    pub(super) fn check(&self) -> Result<(), GenerateError> {
        in_range("resolution_m", self.resolution_m, [0.001, 100.0])?;
        in_range("density", self.density, [0.0, 0.8])?;
        let sides = self.max_obstacle_cells as f64;
        in_range("max_obstacle_cells", sides, [1.0, 1000.0])
    }
}

fn in_range(name: &'static str, value: f64, [min, max]: [f64; 2]) -> Result<(), GenerateError> {
    if (min..=max).contains(&value) {
        return Ok(());
    }
    Err(GenerateError::OutOfRange {
        name,
        value,
        min,
        max,
    })
}
