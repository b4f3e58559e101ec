//! Parameters of ants that drive.

use crate::parameters::{OutOfRange, Parameters, Range, parameters};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The most ants of a generation.
const MAX_ANTS: u32 = 10_000;

parameters! {
    /// Parameters of ants that drive.
    pub struct DriveConfig where check_racers {
        /// Who races for a first path.
        pub race: Racers = Racers::default(),
        /// Ants of a generation; without any, hybrid A* searches alone.
        #[range(0..=MAX_ANTS)]
        pub n_ants: u32 = 8,
        /// How much ants prefer what leads on: a motion that costs its own length more than the
        /// best one is taken exp(-beta) times as often.
        #[range(0.0..=100.0)]
        pub beta: f64 = 8.0,
        /// Steps back that an ant takes where nothing leads on before it dies.
        #[range(0..=10_000)]
        pub n_retreats: u32 = 30,
        /// An ant dies after so many times the steps that the way along the field takes.
        #[range(1.0..=100.0)]
        pub detour_ratio: f64 = 3.0,
        /// How the goal field is repaired where ants die.
        pub repair: FieldRepair = FieldRepair::default(),
        /// The trails that focused ants follow.
        pub trails: TrailsConfig = TrailsConfig::default(),
        /// Generations of focused ants without a gain after which to stop; 0 sends none.
        #[range(0..=10_000)]
        pub n_stalled: u32 = 1,
        /// Steps that hybrid A* has for a path of its own where ants won the race.
        #[range(0..=1_000_000_000)]
        pub second_steps: u64 = 20_000,
    }
}

parameters! {
    /// The trails that focused ants follow.
    pub struct TrailsConfig {
        /// How much ants prefer trails: a motion onto full pheromone weighs 1 + alpha times as
        /// much.
        #[range(0.0..=1000.0)]
        pub alpha: f64 = 1.0,
        /// Share of the pheromone that evaporates in a generation.
        #[range(0.0..=1.0)]
        pub rho: f64 = 0.2,
        /// What the best way so far lays in a generation; a bin holds at most 1.
        #[range(0.0..=1.0)]
        pub deposit: f64 = 0.5,
    }
}

/// Who races for a first path; less than both shows what the other is good for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Racers {
    /// Ants and hybrid A*, in turns.
    #[default]
    Both,
    /// Ants alone: they may give up where there is a path.
    Ants,
    /// Hybrid A* alone.
    HybridAstar,
}

impl Parameters for Racers {}

parameters! {
    /// How the goal field is repaired where ants die.
    pub struct FieldRepair {
        /// Radius of the ground that becomes dearer about a place of death, in turning radii.
        #[range(0.0..=10.0)]
        pub reach_radii: f64 = 0.5,
        /// What a cell there costs beyond its step, in steps per death; 0 repairs nothing.
        #[range(0.0..=100.0)]
        pub toll_per_death: f64 = 1.0,
    }
}

impl DriveConfig {
    /// Ants that race alone must exist.
    fn check_racers(&self) -> Result<(), OutOfRange> {
        match self.race {
            Racers::Ants => Range::of::<u32>(1..=MAX_ANTS).check("n_ants", &self.n_ants),
            Racers::Both | Racers::HybridAstar => Ok(()),
        }
    }
}
