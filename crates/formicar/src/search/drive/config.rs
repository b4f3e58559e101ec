//! Parameters of hybrid A*.

use crate::numeric::{OutOfRange, check_range};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Parameters of hybrid A*; costs are in metres of forward driving.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct HybridAstarConfig {
    /// Weight of the heuristic, 1 to 10: at 1 the path is near the best on the lattice, more is
    /// faster.
    #[schemars(range(min = 1.0, max = 10.0))]
    pub weight: f64,
    /// Search steps after which to give up, 1 to 10^9; a request's budget may be lower.
    #[schemars(range(min = 1, max = 1_000_000_000))]
    pub max_iterations: u64,
    /// Number of headings of the lattice, 16 to 360.
    #[schemars(range(min = 16, max = 360))]
    pub angle_quantization_bins: u32,
    /// Least length of a motion primitive as a share of the turning radius, 0.05 to 1; never
    /// shorter than one and a half map cells.
    #[schemars(range(min = 0.05, max = 1.0))]
    pub step_radii: f64,
    /// Factor on the length driven in reverse, 1 to 100.
    #[schemars(range(min = 1.0, max = 100.0))]
    pub reverse_penalty: f64,
    /// Cost of a change of gear, metres, 0 to 1000.
    #[schemars(range(min = 0.0, max = 1000.0))]
    pub direction_switching_cost: f64,
    /// Added to the factor on an arc that steers the other way than the motion before, 0 to 100.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub change_penalty: f64,
    /// Factor on the length driven with the wheels turned, 1 to 100.
    #[schemars(range(min = 1.0, max = 100.0))]
    pub non_straight_penalty: f64,
    /// Factor on length near obstacles: 1 + `cost_penalty` at contact, falling to 1 at
    /// `clearance_wish_m`; 0 to 100.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub cost_penalty: f64,
    /// Clearance from which on obstacles no longer count, metres, 0 to 100.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub clearance_wish_m: f64,
}

impl Default for HybridAstarConfig {
    fn default() -> Self {
        Self {
            weight: 1.5,
            max_iterations: 1_000_000,
            angle_quantization_bins: 72,
            step_radii: 0.25,
            reverse_penalty: 2.0,
            direction_switching_cost: 1.0,
            change_penalty: 0.0,
            non_straight_penalty: 1.07,
            cost_penalty: 1.0,
            clearance_wish_m: 0.3,
        }
    }
}

impl HybridAstarConfig {
    /// Checks the ranges.
    ///
    /// # Errors
    /// The first parameter outside its range.
    pub fn check(&self) -> Result<(), OutOfRange> {
        let n_bins = f64::from(self.angle_quantization_bins);
        check_range("hybrid_astar.weight", self.weight, 1.0..=10.0)?;
        check_range("hybrid_astar.angle_quantization_bins", n_bins, 16.0..=360.0)?;
        let n_iterations = self.max_iterations as f64;
        check_range("hybrid_astar.max_iterations", n_iterations, 1.0..=1e9)?;
        check_range("hybrid_astar.step_radii", self.step_radii, 0.05..=1.0)?;
        check_range(
            "hybrid_astar.reverse_penalty",
            self.reverse_penalty,
            1.0..=100.0,
        )?;
        let switching = self.direction_switching_cost;
        check_range(
            "hybrid_astar.direction_switching_cost",
            switching,
            0.0..=1000.0,
        )?;
        check_range(
            "hybrid_astar.change_penalty",
            self.change_penalty,
            0.0..=100.0,
        )?;
        let non_straight = self.non_straight_penalty;
        check_range(
            "hybrid_astar.non_straight_penalty",
            non_straight,
            1.0..=100.0,
        )?;
        check_range("hybrid_astar.cost_penalty", self.cost_penalty, 0.0..=100.0)?;
        check_range(
            "hybrid_astar.clearance_wish_m",
            self.clearance_wish_m,
            0.0..=100.0,
        )
    }
}
