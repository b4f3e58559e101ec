//! Parameters of `formicar`.

use crate::colony::drive::DriveConfig;
use crate::objective::DriveCost;
use crate::parameters::parameters;
use crate::planner::family::sections;
use crate::search::HybridAstarConfig;
use crate::smoothing::ImproveConfig;

sections! {
    /// Parameters of `formicar`.
    #[derive(Default)]
    FormicarParameters {
        /// Parameters of `hybrid-astar`, whose lattice `formicar` shares.
        hybrid_astar: HybridAstarConfig,
        /// The ants that drive, of `formicar`.
        drive: DriveConfig,
        /// Cost of driving, by which `formicar` searches and improves.
        cost: DriveCost,
        /// Improvement of a driven path.
        improve: ImproveConfig,
        /// Weight of a previous path when `formicar` replans.
        replan: ReplanConfig,
    }
}

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

impl ReplanConfig {
    /// True where a new path is cheaper than an old one by enough to take its place.
    pub(super) fn prefers_new(&self, old_m: f64, new_m: f64) -> bool {
        new_m < old_m * (1.0 - self.consistency)
    }
}
