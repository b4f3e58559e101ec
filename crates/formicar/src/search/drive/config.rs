//! Parameters of hybrid A*.

use crate::collision::MIN_CLEARANCE_M;
use crate::objective::{DriveCost, Falloff};
use crate::parameters::parameters;

parameters! {
    /// Parameters of hybrid A*; costs are in meters of forward driving.
    pub struct HybridAstarConfig {
        /// Weight of the heuristic: at 1 the path is near the best on the lattice, more is faster.
        #[range(1.0..=10.0)]
        pub weight: f64 = 1.5,
        /// Search steps after which to give up; a request's budget may be lower.
        #[range(1..=1_000_000_000)]
        pub max_iterations: u64 = 1_000_000,
        /// Number of headings of the lattice.
        #[range(16..=360)]
        pub angle_quantization_bins: u32 = 72,
        /// Least length of a motion primitive as a share of the turning radius; never shorter than
        /// one and a half map cells.
        #[range(0.05..=1.0)]
        pub step_radii: f64 = 0.25,
        /// Factor on the length driven in reverse.
        #[range(1.0..=100.0)]
        pub reverse_penalty: f64 = 2.0,
        /// Cost of a change of gear, meters.
        #[range(0.0..=1000.0)]
        pub direction_switching_cost: f64 = 1.0,
        /// Added to the factor on an arc that steers the other way than the motion before.
        #[range(0.0..=100.0)]
        pub change_penalty: f64 = 0.0,
        /// Factor on the length driven with the wheels turned.
        #[range(1.0..=100.0)]
        pub non_straight_penalty: f64 = 1.07,
        /// Factor on length near obstacles: 1 + `cost_penalty` at contact, falling to 1 at
        /// `clearance_wish_m`.
        #[range(0.0..=100.0)]
        pub cost_penalty: f64 = 1.0,
        /// Clearance from which on obstacles no longer count, meters.
        #[range(0.0..=100.0)]
        pub clearance_wish_m: f64 = 0.3,
    }
}

impl HybridAstarConfig {
    /// The cost of motions.
    pub fn cost(&self) -> DriveCost {
        DriveCost {
            reverse_factor: self.reverse_penalty,
            gear_switch_m: self.direction_switching_cost,
            turn_factor: self.non_straight_penalty,
            swing_factor: self.change_penalty,
            clearance_weight: self.cost_penalty,
            // Clearances below the least one are not measured.
            clearance_wish_m: self.clearance_wish_m.max(2.0 * MIN_CLEARANCE_M),
            falloff: Falloff::Linear,
            ..DriveCost::length_alone()
        }
    }
}
