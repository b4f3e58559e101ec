//! The cost of a path over cells: its length and its turns.

use crate::parameters::parameters;
use std::f64::consts::SQRT_2;

parameters! {
    /// The cost of a path over cells, F = A P + B T (Lei & Zheng 2020, equation 3).
    pub struct PathCost {
        /// A: weight of the length in cells.
        #[range(1e-6..=1e6)]
        pub length_weight: f64 = 1.0,
        /// Length of a diagonal step in cells; the square root of 2 is exact.
        #[range(1.0..=2.0)]
        pub diagonal_length: f64 = SQRT_2,
        /// B: weight of a change of direction.
        #[range(0.0..=1e6)]
        pub turn_weight: f64 = 0.0,
    }
}

impl PathCost {
    /// P: length in cells.
    pub fn length_cells(&self, counts: StepCounts) -> f64 {
        counts.n_straight as f64 + self.diagonal_length * counts.n_diagonal as f64
    }

    /// F: the cost.
    pub fn cost(&self, counts: StepCounts) -> f64 {
        self.length_weight * self.length_cells(counts) + self.turn_weight * counts.n_turns as f64
    }
}

/// The numbers of steps and turns of a path over cells.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StepCounts {
    /// Steps to a cell with a common edge.
    pub n_straight: usize,
    /// Steps to a cell with a common corner.
    pub n_diagonal: usize,
    /// Steps in another direction than the one before.
    pub n_turns: usize,
}

impl StepCounts {
    /// Counts steps, each a place in [`STEPS`](crate::map::STEPS).
    pub fn of(steps: &[u8]) -> Self {
        let n_diagonal = steps.iter().filter(|&&step| step % 2 == 1).count();
        let changes = steps.iter().zip(steps.iter().skip(1));
        Self {
            n_straight: steps.len() - n_diagonal,
            n_diagonal,
            n_turns: changes.filter(|(a, b)| a != b).count(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_steps_and_turns() {
        let counts = StepCounts::of(&[0, 0, 1, 1, 2, 0]);
        let expected = StepCounts {
            n_straight: 4,
            n_diagonal: 2,
            n_turns: 3,
        };
        assert_eq!(counts, expected);
        assert_eq!(StepCounts::of(&[]), StepCounts::default());
        let cost = PathCost {
            diagonal_length: 1.4,
            turn_weight: 0.5,
            ..PathCost::default()
        };
        assert!((cost.cost(counts) - 8.3).abs() < 1e-12);
    }

    #[test]
    fn refuses_what_is_no_cost() {
        let cost = PathCost {
            turn_weight: -1.0,
            ..PathCost::default()
        };
        assert!(
            cost.check()
                .unwrap_err()
                .to_string()
                .contains("turn_weight")
        );
    }
}
