//! Parameters of ants that drive.

use crate::numeric::{OutOfRange, check_range};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Parameters of ants that drive.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct DriveConfig {
    /// Who races for a first path.
    pub race: Racers,
    /// Ants of a generation, 0 to 10000; without any, hybrid A* searches alone.
    #[schemars(range(min = 0, max = 10_000))]
    pub n_ants: u32,
    /// How much ants prefer what leads on, 0 to 100: a motion that costs its own length more than
    /// the best one is taken exp(-beta) times as often.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub beta: f64,
    /// Steps back that an ant takes where nothing leads on before it dies, 0 to 10000.
    #[schemars(range(min = 0, max = 10_000))]
    pub n_retreats: u32,
    /// An ant dies after so many times the steps that the way along the field takes, 1 to 100.
    #[schemars(range(min = 1.0, max = 100.0))]
    pub detour_ratio: f64,
    /// How the goal field is repaired where ants die.
    pub repair: FieldRepair,
    /// The trails that focused ants follow.
    pub trails: TrailsConfig,
    /// Generations of focused ants without a gain after which to stop, 0 to 10000; 0 sends none.
    #[schemars(range(min = 0, max = 10_000))]
    pub n_stalled: u32,
    /// Steps that hybrid A* has for a path of its own where ants won the race, 0 to 10^9.
    #[schemars(range(min = 0, max = 1_000_000_000))]
    pub second_steps: u64,
}

/// The trails that focused ants follow.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct TrailsConfig {
    /// How much ants prefer trails, 0 to 1000: a motion onto full pheromone weighs 1 + alpha times
    /// as much.
    #[schemars(range(min = 0.0, max = 1000.0))]
    pub alpha: f64,
    /// Share of the pheromone that evaporates in a generation, 0 to 1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub rho: f64,
    /// What the best way so far lays in a generation, 0 to 1; a bin holds at most 1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub deposit: f64,
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

/// How the goal field is repaired where ants die.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct FieldRepair {
    /// Radius of the ground that becomes dearer about a place of death, in turning radii, 0 to 10.
    #[schemars(range(min = 0.0, max = 10.0))]
    pub reach_radii: f64,
    /// What a cell there costs beyond its step, in steps per death, 0 to 100; 0 repairs nothing.
    #[schemars(range(min = 0.0, max = 100.0))]
    pub toll_per_death: f64,
}

impl Default for DriveConfig {
    fn default() -> Self {
        Self {
            race: Racers::default(),
            n_ants: 8,
            beta: 8.0,
            n_retreats: 30,
            detour_ratio: 3.0,
            repair: FieldRepair::default(),
            trails: TrailsConfig::default(),
            n_stalled: 1,
            second_steps: 20_000,
        }
    }
}

impl Default for TrailsConfig {
    fn default() -> Self {
        Self {
            alpha: 1.0,
            rho: 0.2,
            deposit: 0.5,
        }
    }
}

impl Default for FieldRepair {
    fn default() -> Self {
        Self {
            reach_radii: 0.5,
            toll_per_death: 1.0,
        }
    }
}

impl DriveConfig {
    /// Checks the ranges.
    ///
    /// # Errors
    /// The first parameter outside its range.
    pub fn check(&self) -> Result<(), OutOfRange> {
        let least_ants = match self.race {
            Racers::Ants => 1.0,
            Racers::Both | Racers::HybridAstar => 0.0,
        };
        let n_ants = f64::from(self.n_ants);
        check_range("drive.n_ants", n_ants, least_ants..=10_000.0)?;
        check_range("drive.beta", self.beta, 0.0..=100.0)?;
        let n_retreats = f64::from(self.n_retreats);
        check_range("drive.n_retreats", n_retreats, 0.0..=10_000.0)?;
        check_range("drive.detour_ratio", self.detour_ratio, 1.0..=100.0)?;
        let n_stalled = f64::from(self.n_stalled);
        check_range("drive.n_stalled", n_stalled, 0.0..=10_000.0)?;
        check_range("drive.second_steps", self.second_steps as f64, 0.0..=1e9)?;
        let TrailsConfig {
            alpha,
            rho,
            deposit,
        } = self.trails;
        check_range("drive.trails.alpha", alpha, 0.0..=1000.0)?;
        check_range("drive.trails.rho", rho, 0.0..=1.0)?;
        check_range("drive.trails.deposit", deposit, 0.0..=1.0)?;
        let FieldRepair {
            reach_radii,
            toll_per_death,
        } = self.repair;
        check_range("drive.repair.reach_radii", reach_radii, 0.0..=10.0)?;
        check_range("drive.repair.toll_per_death", toll_per_death, 0.0..=100.0)
    }
}
