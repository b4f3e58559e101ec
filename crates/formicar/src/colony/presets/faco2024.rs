//! The fractional-order colony of Li et al. 2024.

use crate::colony::chord::{
    ChordConfig, ChordTransition, CornerRule, CornerTerm, DistanceTerm, DynamicLimit,
    FootprintSafety, FractionalTransition, KnownLengths, Safety, SpreadDeposit, SteeringLimit,
};
use crate::colony::corridor::{Corridor, RatioCorridor};
use crate::colony::dead_end::{DeadEnd, Retreat};
use crate::colony::evaporation::{Evaporation, Generational};
use crate::colony::heuristic::{Advantage, Guidance};
use crate::colony::initial::{AstarSeed, PheromoneUnit};
use crate::colony::stopping::Stopping;
use crate::objective::SteeringCost;

impl Default for ChordConfig {
    /// [`faco2024`].
    fn default() -> Self {
        faco2024()
    }
}

/// FACO, Li et al. 2024: ants that step by chords with the steering that a suspended car has,
/// seeded by a shortest path, and weigh steps by fractional derivatives along their way.
///
/// Guidance by advantage, the corridor and retreat from dead ends are ours: without them hardly an
/// ant finds its way over some hundred cells. The paper's plain form is `guidance` and `corridor`
/// of `none`, and `dead_end` of `die`.
pub fn faco2024() -> ChordConfig {
    ChordConfig {
        n_ants: 50,
        n_iterations: 50,
        reach: 5,
        growth_radii: vec![0.1, 0.0],
        pheromone_exponent: 1.0,
        corner_exponent: 1.0,
        distance_exponent: 1.0,
        safety: Safety::Footprint(FootprintSafety { margin_cells: 0.5 }),
        corridor: Corridor::Ratio(RatioCorridor {
            ratio: 1.1,
            step_loss_cells: 4.0,
        }),
        guidance: Guidance::Advantage(Advantage { beta: 1.0 }),
        corner: CornerTerm::Product(CornerRule::default()),
        distance: DistanceTerm::KnownLengths(KnownLengths { eta: 1.1 }),
        limit: SteeringLimit::Dynamic(DynamicLimit::default()),
        transition: ChordTransition::Fractional(FractionalTransition::default()),
        dead_end: DeadEnd::Retreat(Retreat { max_steps: 10 }),
        initial: AstarSeed {
            tau: 1.0,
            factor: 5.0,
            unit: PheromoneUnit::Deposit,
        },
        evaporation: Evaporation::Generational(Generational::default()),
        deposit: SpreadDeposit::default(),
        cost: SteeringCost::default(),
        stopping: Stopping {
            stall_iterations: 3,
            least_gain: 2e-3,
            target_cost: 0.0,
        },
    }
}
