//! The conditions on which a colony stops before the last iteration.

use crate::parameters::parameters;

parameters! {
    /// When to stop before the last iteration.
    #[derive(Default)]
    pub struct Stopping {
        /// Iterations without a better path after which the colony stops; 0 for never.
        pub stall_iterations: u32,
        /// Least gain of a path that counts as better, as a share of the cost.
        #[range(0.0..=1.0)]
        pub least_gain: f64,
        /// Cost at which a path is good enough; 0 for none.
        #[range(0.0..)]
        pub target_cost: f64,
    }
}

impl Stopping {
    /// The cost below which a path counts as better than a known one.
    pub(super) fn counts_below(&self, known_cost: f64) -> f64 {
        (1.0 - self.least_gain) * known_cost
    }
}
