//! Parameters of hybrid A*.

use crate::objective::VehicleCost;
use crate::parameters::parameters;

parameters! {
    /// Parameters of hybrid A*. What motions cost is in the section `cost`, but for what only a
    /// search over motions needs.
    pub struct HybridAstarConfig {
        /// Weight of the heuristic: at 1 the path is near the best on the lattice, more is faster.
        /// On the refined lattice, twice that.
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
        /// The share of the surcharges for reverse, changes of gear and nearness that the search
        /// counts: with 1 it looks for the cheapest path, with less it finds one sooner. On the
        /// refined lattice, where a vehicle must shunt, a first search counts none.
        #[range(0.0..=1.0)]
        pub cost_share: f64 = 0.1,
        /// Added to the factor on an arc that steers the other way than the motion before.
        #[range(0.0..=100.0)]
        pub change_penalty: f64 = 0.0,
        /// Factor on the length driven with the wheels turned.
        #[range(1.0..=100.0)]
        pub non_straight_penalty: f64 = 1.07,
    }
}

impl HybridAstarConfig {
    /// The cost of motions: that of driving, a share of its surcharges, and what turned wheels cost
    /// a search. Jumps and bends are priced by the factor on turned wheels alone, since motions
    /// cannot choose their radius.
    pub fn cost_of_motions(&self, cost: &VehicleCost, share: f64) -> VehicleCost {
        VehicleCost {
            turn_factor: self.non_straight_penalty,
            swing_factor: self.change_penalty,
            reverse_factor: 1.0 + share * (cost.reverse_factor - 1.0),
            gear_switch_m: share * cost.gear_switch_m,
            clearance_weight: share * cost.clearance_weight,
            curvature_change_weight: 0.0,
            bend_weight: 0.0,
            ..*cost
        }
    }
}
