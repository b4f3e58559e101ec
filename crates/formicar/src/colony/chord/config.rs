//! Every parameter of a colony that steps by chords.

use super::corner::CornerTerm;
use super::deposit::SpreadDeposit;
use super::distance::DistanceTerm;
use super::limit::SteeringLimit;
use super::safety::Safety;
use super::transition::ChordTransition;
use crate::colony::corridor::Corridor;
use crate::colony::dead_end::DeadEnd;
use crate::colony::error::ColonyError;
use crate::colony::evaporation::Evaporation;
use crate::colony::heuristic::Guidance;
use crate::colony::initial::AstarSeed;
use crate::colony::stopping::Stopping;
use crate::numeric::{OutOfRange, check_range};
use crate::objective::SteeringCost;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A colony whose ants step by chords: its size, its steps, and a rule for each slot.
///
/// The default is that of Li et al. 2024, [`presets::faco2024`](crate::colony::presets::faco2024).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ChordConfig {
    /// K: ants in each generation, from 1 to 1 000 000.
    #[schemars(range(min = 1, max = 1_000_000))]
    pub n_ants: u32,
    /// `N_max`: generations at most, from 1 to 1 000 000.
    #[schemars(range(min = 1, max = 1_000_000))]
    pub n_iterations: u32,
    /// Chebyshev distance of a step's end in cells, from 1 (eight neighbors) to 16.
    #[schemars(range(min = 1, max = 16))]
    pub reach: u32,
    /// By how many turning radii obstacles are grown beyond half the vehicle's width for the
    /// shortest path that guides the ants, the first that gives a drivable path; each from 0 to
    /// 10, at least one.
    pub growth_radii: Vec<f64>,
    /// beta1: exponent of the pheromone, from 0 to 10.
    #[schemars(range(min = 0.0, max = 10.0))]
    pub pheromone_exponent: f64,
    /// beta2: exponent of the corner term, from 0 to 10.
    #[schemars(range(min = 0.0, max = 10.0))]
    pub corner_exponent: f64,
    /// beta3: exponent of the distance term, from 0 to 10.
    #[schemars(range(min = 0.0, max = 10.0))]
    pub distance_exponent: f64,
    /// Which steps the body has room for.
    pub safety: Safety,
    /// Where ants may go.
    pub corridor: Corridor,
    /// What an ant knows of the way to the goal besides the distance term.
    pub guidance: Guidance,
    /// What the corner before a step costs.
    pub corner: CornerTerm,
    /// What a step's way to the goal promises.
    pub distance: DistanceTerm,
    /// How far the vehicle can steer.
    pub limit: SteeringLimit,
    /// How both terms enter the weight of a step.
    pub transition: ChordTransition,
    /// What an ant does where no step is left. One that retreats goes back some steps, more of them
    /// each time, and draws anew.
    pub dead_end: DeadEnd,
    /// Pheromone before the first generation. The unit of a deposit is what the shortest path
    /// itself would get.
    pub initial: AstarSeed,
    /// How pheromone evaporates.
    pub evaporation: Evaporation,
    /// Who deposits pheromone, and how much.
    pub deposit: SpreadDeposit,
    /// J: what a path costs.
    pub cost: SteeringCost,
    /// When to stop before the last generation.
    pub stopping: Stopping,
}

impl ChordConfig {
    /// Checks every parameter.
    ///
    /// # Errors
    /// The first parameter that is out of its range.
    pub fn check(&self) -> Result<(), ColonyError> {
        for (key, value, range) in [
            ("chords.n_ants", f64::from(self.n_ants), 1.0..=1e6),
            (
                "chords.n_iterations",
                f64::from(self.n_iterations),
                1.0..=1e6,
            ),
            ("chords.reach", f64::from(self.reach), 1.0..=16.0),
            (
                "number of chords.growth_radii",
                self.growth_radii.len() as f64,
                1.0..=8.0,
            ),
            (
                "chords.pheromone_exponent",
                self.pheromone_exponent,
                0.0..=10.0,
            ),
            ("chords.corner_exponent", self.corner_exponent, 0.0..=10.0),
            (
                "chords.distance_exponent",
                self.distance_exponent,
                0.0..=10.0,
            ),
            (
                "chords.stopping.least_gain",
                self.stopping.least_gain,
                0.0..=1.0,
            ),
            (
                "chords.stopping.target_cost",
                self.stopping.target_cost,
                0.0..=f64::MAX,
            ),
        ] {
            check_range(key, value, range)?;
        }
        for &growth in &self.growth_radii {
            check_range("chords.growth_radii", growth, 0.0..=10.0)?;
        }
        self.safety.check()?;
        self.corridor.check().map_err(in_section)?;
        self.guidance.check().map_err(in_section)?;
        self.corner.check()?;
        self.distance.check()?;
        self.limit.check()?;
        self.transition.check()?;
        self.initial.check().map_err(in_section)?;
        self.evaporation
            .check(self.n_iterations)
            .map_err(|error| match error {
                ColonyError::OutOfRange(error) => in_section(error).into(),
                error @ ColonyError::Evaporation { .. } => error,
            })?;
        self.deposit.check()?;
        self.cost.check()?;
        Ok(())
    }
}

/// The error of a rule that other colonies use too, with the key that it has here.
fn in_section(error: OutOfRange) -> OutOfRange {
    error.in_section("chords")
}
