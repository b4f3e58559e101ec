//! Every parameter of an evolution.

use crate::objective::SteeringCost;
use crate::parameters::{OutOfRange, Range, parameters, rules};
use crate::vehicle::SuspensionParameters;
use std::ops::RangeInclusive;

/// Most via points of a polyline.
const MAX_VIA: u32 = 8;

parameters! {
    /// A population of polylines, and how it breeds.
    ///
    /// The default is that of `ga`.
    pub struct EvolutionConfig where check_counts {
        /// Individuals of a generation.
        #[range(2..=100_000)]
        pub n_individuals: u32,
        /// Generations at most, the first population among them.
        #[range(1..=1_000_000)]
        pub n_generations: u32,
        /// Via points of an individual that is made at random, from `n_via_min` to `n_via_max`.
        #[range(1..=MAX_VIA)]
        pub n_via: u32,
        /// Fewest via points of any individual.
        #[range(1..=MAX_VIA)]
        pub n_via_min: u32,
        /// Most via points of any individual, at least `n_via_min`.
        #[range(1..=MAX_VIA)]
        pub n_via_max: u32,
        /// The first population.
        pub initial: InitialPopulation,
        /// Individuals of which the fittest becomes a parent.
        #[range(1..=1000)]
        pub tournament_size: u32,
        /// Fittest individuals that stay as they are, fewer than `n_individuals`.
        #[range(0..=99_999)]
        pub n_elite: u32,
        /// Probability that a child has two parents.
        #[range(0.0..=1.0)]
        pub crossover: f64,
        /// Mutations of children.
        pub mutation: Mutations,
        /// Penalty, in units of the cost, for as much way through blocked cells as the shortest
        /// path is long. A segment that is not free counts one cell more.
        #[range(0.0..=1_000_000.0)]
        pub collision_weight: f64,
        /// Generations without a better collision-free polyline after which it stops; 0 for never.
        pub stall_generations: u32,
        /// Cost of a polyline.
        pub cost: SteeringCost,
        /// The suspension, which limits the steering in turns.
        pub suspension: SuspensionParameters,
    }
}

rules! {
    /// The first population.
    #[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
    pub enum InitialPopulation {
        /// Via points at random, all cells that can be reached alike.
        Random,
        /// A share of the individuals follows the shortest path over cells, the others are random.
        AstarSeeded(AstarSeeded),
    }
}

parameters! {
    /// A share of the first population follows the shortest path over cells: its nodes without
    /// redundant ones, brought to the number of via points allowed, each moved a little.
    pub struct AstarSeeded {
        /// Share of the population.
        #[range(0.0..=1.0)]
        pub share: f64 = 1.0 / 3.0,
        /// Farthest that a via point is moved along either axis, meters; those of the first
        /// individual stay where they are.
        #[range(0.0..=1000.0)]
        pub noise_m: f64 = 1.0,
    }
}

parameters! {
    /// Probabilities of the mutations of a child, each drawn by itself.
    pub struct Mutations {
        /// Probability that a via point moves.
        #[range(0.0..=1.0)]
        pub r#move: f64 = 0.5,
        /// Probability that a via point is put in, where more are allowed.
        #[range(0.0..=1.0)]
        pub insert: f64 = 0.1,
        /// Probability that a via point is taken out, where fewer are allowed.
        #[range(0.0..=1.0)]
        pub delete: f64 = 0.1,
        /// Probability that a via point goes halfway to the middle between its neighbors.
        #[range(0.0..=1.0)]
        pub smooth: f64 = 0.2,
        /// Farthest that a via point moves along either axis, in shares of the longer side of the
        /// map; small moves are likelier.
        #[range(0.0..=1.0)]
        pub move_reach: f64 = 0.2,
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

    /// Checks the counts that bound each other.
    fn check_counts(&self) -> Result<(), OutOfRange> {
        let range = |range: RangeInclusive<u32>| Range::of::<u32>(range);
        range(self.n_via_min..=MAX_VIA).check("n_via_max", &self.n_via_max)?;
        range(self.n_via_min..=self.n_via_max).check("n_via", &self.n_via)?;
        range(0..=self.n_individuals - 1).check("n_elite", &self.n_elite)
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
        assert_eq!(error, "n_via = 3; it must be in 4 to 8");
        let error = with(3, 4, 3).unwrap_err();
        assert_eq!(error, "n_via_max = 3; it must be in 4 to 8");
    }
}
