//! Parameters of the improvement of driven paths.

use crate::parameters::parameters;

parameters! {
    /// Parameters of the improvement of driven paths. An operator whose share is 0 is left out.
    pub struct ImproveConfig {
        /// Tries after which to stop; a budget of steps may be lower.
        #[range(0..=1_000_000_000)]
        pub max_tries: u64 = 1_000_000,
        /// Tries without a gain after which to stop, per turning radius of the path's length.
        #[range(1..=1_000_000)]
        pub stall_tries_per_radius: u32 = 10,
        /// The gain, relative to the cost, below which tries count as without one.
        #[range(0.0..=0.1)]
        pub stall_gain: f64 = 1e-3,
        /// Share of tries that join two places of the path by one curve.
        #[range(0.0..=1000.0)]
        pub shortcut_share: f64 = 1.0,
        /// Share of tries that move a place of the path and join it anew on both sides.
        #[range(0.0..=1000.0)]
        pub shift_share: f64 = 2.0,
        /// Share of tries that replace a change of gear with its surroundings; where no gear
        /// changes, the other tries take it.
        #[range(0.0..=1000.0)]
        pub cusp_share: f64 = 0.3,
        /// Share of tries that move the end within the goal tolerance, where there is one.
        #[range(0.0..=1000.0)]
        pub end_share: f64 = 0.2,
        /// Most systematic passes over all pieces of the path, before and after the random tries.
        #[range(0..=1000)]
        pub polish_passes: u32 = 1,
        /// Curves whose surroundings are looked at in a try, cheapest first.
        #[range(1..=100)]
        pub n_checked: u32 = 3,
    }
}
