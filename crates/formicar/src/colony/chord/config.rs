//! Every parameter of a colony that steps by chords.

use super::corner::CornerTerm;
use super::deposit::SpreadDeposit;
use super::distance::DistanceTerm;
use super::limit::SteeringLimit;
use super::safety::Safety;
use super::transition::ChordTransition;
use crate::colony::corridor::Corridor;
use crate::colony::dead_end::DeadEnd;
use crate::colony::evaporation::Evaporation;
use crate::colony::heuristic::Guidance;
use crate::colony::initial::AstarSeed;
use crate::colony::stopping::Stopping;
use crate::objective::SteeringCost;
use crate::parameters::{OutOfRange, Range, parameters};

parameters! {
    /// A colony whose ants step by chords: its size, its steps, and a rule for each slot.
    ///
    /// The default is that of Li et al. 2024,
    /// [`presets::faco2024`](crate::colony::presets::faco2024).
    pub struct ChordConfig where check_together {
        /// K: ants of each generation.
        #[range(1..=1_000_000)]
        pub n_ants: u32,
        /// `N_max`: generations at most.
        #[range(1..=1_000_000)]
        pub n_iterations: u32,
        /// Chebyshev distance of a step's end in cells; 1 is the eight neighbors.
        #[range(1..=16)]
        pub reach: u32,
        /// Inflation of obstacles beyond half the vehicle's width for the shortest path that guides
        /// the ants, in turning radii: one to eight values, of which the first counts that gives a
        /// drivable path.
        #[range(0.0..=10.0)]
        pub growth_radii: Vec<f64>,
        /// β₁: exponent of the pheromone.
        #[range(0.0..=10.0)]
        pub pheromone_exponent: f64,
        /// β₂: exponent of the corner term.
        #[range(0.0..=10.0)]
        pub corner_exponent: f64,
        /// β₃: exponent of the distance term.
        #[range(0.0..=10.0)]
        pub distance_exponent: f64,
        /// Collision check of steps.
        pub safety: Safety,
        /// The cells on which ants may step.
        pub corridor: Corridor,
        /// Guidance by the distance to the goal besides the distance term.
        pub guidance: Guidance,
        /// Cost of the corner before a step.
        pub corner: CornerTerm,
        /// Distance term of a step.
        pub distance: DistanceTerm,
        /// Steering limit of the vehicle.
        pub limit: SteeringLimit,
        /// Weight of a step by both terms.
        pub transition: ChordTransition,
        /// Behavior of an ant at a dead end. One that retreats goes back some steps, more of them
        /// each time, and draws anew.
        pub dead_end: DeadEnd,
        /// Pheromone before the first generation. The unit of a deposit is that of the shortest path
        /// itself.
        pub initial: AstarSeed,
        /// Evaporation of pheromone.
        pub evaporation: Evaporation,
        /// Deposits of pheromone.
        pub deposit: SpreadDeposit,
        /// J: what a path costs.
        pub cost: SteeringCost,
        /// When to stop before the last generation.
        pub stopping: Stopping,
    }
}

impl ChordConfig {
    fn check_together(&self) -> Result<(), OutOfRange> {
        let n_growths = Range::of::<usize>(1..=8);
        n_growths.check("growth_radii (number of values)", &self.growth_radii.len())?;
        let checked = self.evaporation.check_run(self.n_iterations);
        checked.map_err(|error| error.within("evaporation"))
    }
}
