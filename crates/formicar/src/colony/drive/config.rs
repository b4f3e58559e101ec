//! Parameters of ants that drive.

use crate::parameters::{OutOfRange, Parameters, Range, parameters};

/// The most ants of a generation.
const MAX_ANTS: u32 = 10_000;

parameters! {
    /// Parameters of ants that drive.
    pub struct DriveConfig where check_racers {
        /// The searches that race for a first path.
        pub race: Racers = Racers::default(),
        /// Ants of a generation; without any, hybrid A* searches alone.
        #[range(0..=MAX_ANTS)]
        pub n_ants: u32 = 8,
        /// Greediness of ants: a motion whose cost exceeds the best one's by its own length is taken
        /// exp(-beta) times as often.
        #[range(0.0..=100.0)]
        pub beta: f64 = 8.0,
        /// Steps back out of dead ends that an ant may take before it dies.
        #[range(0..=10_000)]
        pub n_retreats: u32 = 30,
        /// An ant dies after this many times the steps of the path along the goal field.
        #[range(1.0..=100.0)]
        pub detour_ratio: f64 = 3.0,
        /// Repair of the goal field where ants die.
        pub repair: FieldRepair = FieldRepair::default(),
        /// The trails that focused ants follow.
        pub trails: TrailsConfig = TrailsConfig::default(),
        /// Generations of focused ants without a gain after which they stop; 0 sends none.
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
        /// Weight of pheromone: a motion onto full pheromone weighs 1 + alpha times as much.
        #[range(0.0..=1000.0)]
        pub alpha: f64 = 1.0,
        /// Share of the pheromone that evaporates in a generation.
        #[range(0.0..=1.0)]
        pub rho: f64 = 0.2,
        /// Pheromone that the best path so far deposits in a generation; a bin holds at most 1.
        #[range(0.0..=1.0)]
        pub deposit: f64 = 0.5,
    }
}

/// The searches that race for a first path; one of them alone shows the gain of the other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
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
    /// Repair of the goal field where ants die.
    pub struct FieldRepair {
        /// Radius around a place of death in which cells get a toll, in turning radii.
        #[range(0.0..=10.0)]
        pub reach_radii: f64 = 0.5,
        /// Toll of a cell there, in steps per death; 0 repairs nothing.
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
