//! Parameters of replanning.

use crate::parameters::parameters;

parameters! {
    /// Parameters of replanning.
    pub struct ReplanConfig {
        /// The share of its cost by which a path planned anew must be cheaper than what has become of
        /// the previous path, to take its place. At 1 the previous path stays as long as it can be
        /// mended.
        #[range(0.0..=1.0)]
        pub consistency: f64 = 0.05,
    }
}
