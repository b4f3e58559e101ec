//! Every parameter of an evolution.

use crate::numeric::{OutOfRange, check_range};
use crate::objective::SteeringCost;
use crate::vehicle::SuspensionParameters;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Most via points of a polyline.
const MAX_VIA: f64 = 8.0;

/// A population of polylines, and how it breeds.
///
/// The default is that of `ga`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct EvolutionConfig {
    /// Individuals, 2 to 100 000.
    #[schemars(range(min = 2, max = 100_000))]
    pub n_individuals: u32,
    /// Generations at most, the first population among them, 1 to 1 000 000.
    #[schemars(range(min = 1, max = 1_000_000))]
    pub n_generations: u32,
    /// Via points of an individual that is made at random, `n_via_min` to `n_via_max`.
    #[schemars(range(min = 1, max = 8))]
    pub n_via: u32,
    /// Fewest via points of any individual, 1 to 8.
    #[schemars(range(min = 1, max = 8))]
    pub n_via_min: u32,
    /// Most via points of any individual, `n_via_min` to 8.
    #[schemars(range(min = 1, max = 8))]
    pub n_via_max: u32,
    /// How the first population is made.
    pub initial: InitialPopulation,
    /// Individuals of which the fittest becomes a parent, 1 to 1000.
    #[schemars(range(min = 1, max = 1000))]
    pub tournament_size: u32,
    /// Fittest individuals that stay as they are, 0 to `n_individuals` - 1.
    #[schemars(range(min = 0, max = 99_999))]
    pub n_elite: u32,
    /// Probability that a child has two parents, 0 to 1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub crossover: f64,
    /// How children change.
    pub mutation: Mutations,
    /// Penalty, in units of the cost, for as much way through blocked cells as the shortest path
    /// is long, 0 to 1 000 000. A segment that is not free counts one cell more.
    #[schemars(range(min = 0.0, max = 1_000_000.0))]
    pub collision_weight: f64,
    /// Generations without a better collision-free polyline after which it stops; 0 for never.
    pub stall_generations: u32,
    /// What a polyline costs.
    pub cost: SteeringCost,
    /// How the steering gives way in turns.
    pub suspension: SuspensionParameters,
}

/// How the first population is made.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "rule", rename_all = "kebab-case", deny_unknown_fields)]
pub enum InitialPopulation {
    /// Via points at random, all cells that can be reached alike.
    Random,
    /// A share of the individuals follows the shortest path over cells, the others are random.
    AstarSeeded(AstarSeeded),
}

/// A share of the first population follows the shortest path over cells: its nodes without
/// redundant ones, brought to the number of via points allowed, each moved a little.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct AstarSeeded {
    /// Share of the population, 0 to 1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub share: f64,
    /// Farthest that a via point is moved along either axis, 0 to 1000 m; those of the first
    /// individual stay where they are.
    #[schemars(range(min = 0.0, max = 1000.0))]
    pub noise_m: f64,
}

impl Default for AstarSeeded {
    fn default() -> Self {
        Self {
            share: 1.0 / 3.0,
            noise_m: 1.0,
        }
    }
}

/// Probabilities of the mutations of a child, each drawn by itself.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Mutations {
    /// A via point moves, 0 to 1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub r#move: f64,
    /// A via point is put in, where more are allowed, 0 to 1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub insert: f64,
    /// A via point is taken out, where fewer are allowed, 0 to 1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub delete: f64,
    /// A via point goes halfway to the middle between its neighbors, 0 to 1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub smooth: f64,
    /// Farthest that a via point moves along either axis, in shares of the longer side of the map,
    /// 0 to 1; small moves are likelier.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub move_reach: f64,
}

impl Default for Mutations {
    fn default() -> Self {
        Self {
            r#move: 0.5,
            insert: 0.1,
            delete: 0.1,
            smooth: 0.2,
            move_reach: 0.2,
        }
    }
}

impl Default for EvolutionConfig {
    fn default() -> Self {
        Self::ga()
    }
}

impl EvolutionConfig {
    /// GA of Li 2024, sec. 5: 100 individuals, 50 generations, three via points to begin with.
    pub fn ga() -> Self {
        Self {
            n_individuals: 100,
            n_generations: 50,
            n_via: 3,
            n_via_min: 1,
            n_via_max: 8,
            initial: InitialPopulation::Random,
            tournament_size: 3,
            n_elite: 2,
            crossover: 0.8,
            mutation: Mutations::default(),
            collision_weight: 10.0,
            stall_generations: 0,
            cost: SteeringCost::default(),
            suspension: SuspensionParameters::default(),
        }
    }

    /// AGA of Li 2024, sec. 5: the same, a third of the first population about the path of A*.
    pub fn aga() -> Self {
        Self {
            initial: InitialPopulation::AstarSeeded(AstarSeeded::default()),
            ..Self::ga()
        }
    }

    /// Checks the ranges.
    ///
    /// # Errors
    /// The first parameter outside its range.
    pub fn check(&self) -> Result<(), OutOfRange> {
        let n_individuals = f64::from(self.n_individuals);
        check_range("evolution.n_individuals", n_individuals, 2.0..=1e5)?;
        let n_generations = f64::from(self.n_generations);
        check_range("evolution.n_generations", n_generations, 1.0..=1e6)?;
        let [n_via, least, most] = [self.n_via, self.n_via_min, self.n_via_max].map(f64::from);
        check_range("evolution.n_via_min", least, 1.0..=MAX_VIA)?;
        check_range("evolution.n_via_max", most, least..=MAX_VIA)?;
        check_range("evolution.n_via", n_via, least..=most)?;
        let tournament_size = f64::from(self.tournament_size);
        check_range("evolution.tournament_size", tournament_size, 1.0..=1e3)?;
        let n_elite = f64::from(self.n_elite);
        check_range("evolution.n_elite", n_elite, 0.0..=n_individuals - 1.0)?;
        check_range("evolution.crossover", self.crossover, 0.0..=1.0)?;
        let weight = self.collision_weight;
        check_range("evolution.collision_weight", weight, 0.0..=1e6)?;
        self.mutation.check()?;
        self.initial.check()?;
        self.cost.check()?;
        self.suspension.check()
    }
}

impl Mutations {
    fn check(&self) -> Result<(), OutOfRange> {
        for (key, share) in [
            ("evolution.mutation.move", self.r#move),
            ("evolution.mutation.insert", self.insert),
            ("evolution.mutation.delete", self.delete),
            ("evolution.mutation.smooth", self.smooth),
            ("evolution.mutation.move_reach", self.move_reach),
        ] {
            check_range(key, share, 0.0..=1.0)?;
        }
        Ok(())
    }
}

impl InitialPopulation {
    fn check(&self) -> Result<(), OutOfRange> {
        let Self::AstarSeeded(seeded) = self else {
            return Ok(());
        };
        check_range("evolution.initial.share", seeded.share, 0.0..=1.0)?;
        check_range("evolution.initial.noise_m", seeded.noise_m, 0.0..=1e3)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ga_and_aga_differ_in_the_first_population_alone() {
        let [ga, aga] = [EvolutionConfig::ga(), EvolutionConfig::aga()];
        assert!(ga.check().is_ok() && aga.check().is_ok());
        assert_ne!(ga, aga);
        let unseeded = EvolutionConfig {
            initial: InitialPopulation::Random,
            ..aga
        };
        assert_eq!(unseeded, ga);
    }

    #[test]
    fn the_numbers_of_via_points_bound_each_other() {
        let with = |n_via: u32, n_via_min: u32, n_via_max: u32| {
            let config = EvolutionConfig {
                n_via,
                n_via_min,
                n_via_max,
                ..EvolutionConfig::ga()
            };
            config.check().map_err(|error| error.to_string())
        };
        assert!(with(3, 3, 3).is_ok());
        let error = with(3, 4, 8).unwrap_err();
        assert_eq!(error, "evolution.n_via = 3; it must be in 4 to 8");
        let error = with(3, 4, 3).unwrap_err();
        assert_eq!(error, "evolution.n_via_max = 3; it must be in 4 to 8");
    }
}
