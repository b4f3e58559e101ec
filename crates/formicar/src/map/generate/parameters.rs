//! Parameters of the generators, with ranges.

use super::GenerateError;
use crate::parameters::parameters;

parameters! {
    /// Measures of an alley neighborhood.
    pub struct NeighborhoodParameters {
        /// Number of columns; columns times resolution must reach 20 m.
        #[range(1..)]
        pub n_cols: usize = 800,
        /// Number of rows; rows times resolution must reach 20 m.
        #[range(1..)]
        pub n_rows: usize = 500,
        /// Side of a cell, meters.
        #[range(0.02..=1.0)]
        pub resolution_m: f64 = 0.2,
        /// Mean width of streets between the house fronts, meters; each varies by a fifth.
        #[range(4.0..=20.0)]
        pub street_width_m: f64 = 7.0,
        /// Longest side of an area between streets, meters.
        #[range(30.0..=300.0)]
        pub street_spacing_m: f64 = 60.0,
        /// Narrowest alley, meters.
        #[range(1.0..=6.0)]
        pub min_alley_width_m: f64 = 2.0,
        /// Widest alley, meters.
        #[range(1.0..=6.0)]
        pub max_alley_width_m: f64 = 4.0,
        /// Longest side of a block of houses between alleys, meters.
        #[range(16.0..=100.0)]
        pub block_m: f64 = 25.0,
        /// Share of the last alleys that end blind.
        #[range(0.0..=1.0)]
        pub dead_end_share: f64 = 0.35,
        /// Share of large blocks with a yard inside, reached by a gateway.
        #[range(0.0..=1.0)]
        pub yard_share: f64 = 0.6,
        /// Share of parking places along streets that are taken.
        #[range(0.0..=1.0)]
        pub parked_car_share: f64 = 0.7,
    }
}

impl NeighborhoodParameters {
    pub(super) fn check_alleys(&self) -> Result<(), GenerateError> {
        if self.min_alley_width_m <= self.max_alley_width_m {
            return Ok(());
        }
        Err(GenerateError::Reversed {
            low_name: "min_alley_width_m",
            low: self.min_alley_width_m,
            high_name: "max_alley_width_m",
            high: self.max_alley_width_m,
        })
    }
}

parameters! {
    /// Measures of a field of scattered obstacles.
    pub struct ScatterParameters {
        /// Number of columns.
        #[range(1..)]
        pub n_cols: usize = 200,
        /// Number of rows.
        #[range(1..)]
        pub n_rows: usize = 200,
        /// Side of a cell, meters.
        #[range(0.001..=100.0)]
        pub resolution_m: f64 = 0.1,
        /// Share of cells that obstacles take; the last obstacle may exceed it.
        #[range(0.0..=0.8)]
        pub density: f64 = 0.1,
        /// Longest side of an obstacle, cells; sides are uniform from 1 to this.
        #[range(1..=1000)]
        pub max_obstacle_cells: usize = 4,
    }
}
