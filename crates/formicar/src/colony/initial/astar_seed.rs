//! Pheromone laid out along a shortest path.

use super::unit::PheromoneUnit;
use crate::parameters::parameters;

parameters! {
    /// tau0 = n c on the cells of a path that A* finds from start to goal, c on all others: Li 2024
    /// (21).
    ///
    /// The path is a shortest one on the moves of the map. The paper gives c and n no values; a
    /// fivefold start is a reading.
    pub struct AstarSeed {
        /// c: pheromone off the path.
        #[range(1e-6..=1e6)]
        pub tau: f64 = 1.0,
        /// n: how many times that lies on the path.
        #[range(1e-3..=1e3)]
        pub factor: f64 = 5.0,
        /// The unit of `tau`.
        pub unit: PheromoneUnit = PheromoneUnit::Deposit,
    }
}

impl AstarSeed {
    /// Pheromone at so many places, of which those that a path goes through are given.
    pub(in crate::colony) fn values(
        &self,
        n_places: usize,
        path: impl IntoIterator<Item = usize>,
    ) -> Vec<f64> {
        let mut values = vec![self.tau; n_places];
        for place in path {
            // Li 2024 (21).
            values[place] = self.factor * self.tau;
        }
        values
    }

    /// The least pheromone on a map with a path.
    pub(in crate::colony) fn least(&self) -> f64 {
        self.tau * self.factor.min(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lies_thick_on_the_path_and_thin_beside_it() {
        let rule = AstarSeed::default();
        assert_eq!(rule.values(4, [1, 3, 1]), [1.0, 5.0, 1.0, 5.0]);
        assert_eq!(rule.least(), 1.0);
    }
}
