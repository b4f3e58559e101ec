//! Weights of the next step: fractional derivatives along the ant's own path.

use crate::numeric::grunwald_letnikov_weights;
use crate::parameters::{parameters, rules};

rules! {
    /// The weight tau^beta1 R^beta2 Q^beta3 of a step (Li 2024, equation 25), with R by its corner and
    /// Q by its distance to the goal.
    pub enum ChordTransition {
        /// By their fractional derivatives along the ant's last steps.
        Fractional(FractionalTransition),
        /// As they are.
        Plain,
    }
}

parameters! {
    /// `D^a1` R and `D^a2` Q of Li 2024 (25-27), Grünwald-Letnikov along the ant's own steps.
    ///
    /// Values are relative to the best candidate of their step, and what is left after the
    /// derivative is at least a share of what was there before, since a derivative may be negative.
    pub struct FractionalTransition {
        /// α₁: order for corners; 0 is none.
        #[range(0.0..=1.0)]
        pub corner_order: f64 = 0.5,
        /// α₂: order for the distance; 0 is none.
        #[range(0.0..=1.0)]
        pub distance_order: f64 = 0.5,
        /// Steps that are remembered, the present one among them.
        #[range(1..=64)]
        pub window: u32 = 8,
        /// The least share that a derivative leaves.
        #[range(1e-6..=1.0)]
        pub floor: f64 = 0.05,
    }
}

impl ChordTransition {
    /// The memories of R and Q of an ant.
    pub(super) fn memories(&self) -> [Memory; 2] {
        match self {
            Self::Fractional(rule) => {
                let window = rule.window as usize;
                [rule.corner_order, rule.distance_order]
                    .map(|order| Memory::new(order, window, rule.floor))
            }
            Self::Plain => [0.0; 2].map(|order| Memory::new(order, 1, 1.0)),
        }
    }
}

/// The values of an ant's last steps, which lower the values of the next.
#[derive(Clone, Debug)]
pub(super) struct Memory {
    /// Weights of the steps before, the latest first.
    weights: Vec<f64>,
    /// Their values, the latest first.
    values: Vec<f64>,
    floor: f64,
}

impl Memory {
    fn new(order: f64, window: usize, floor: f64) -> Self {
        let weights = grunwald_letnikov_weights(order, window)[1..].to_vec();
        Self {
            values: Vec::with_capacity(weights.len() + 1),
            weights,
            floor,
        }
    }

    pub(super) fn forget(&mut self) {
        self.values.clear();
    }

    /// The share of the last steps in the derivative; not positive.
    pub(super) fn past(&self) -> f64 {
        let remembered = self.values.iter().zip(&self.weights);
        remembered.map(|(value, weight)| value * weight).sum()
    }

    /// The derivative at a step with a value from 0 to 1, given the share of the last steps.
    #[inline]
    pub(super) fn derivative(&self, value: f64, past: f64) -> f64 {
        (value + past).max(self.floor * value)
    }

    /// Remembers the value of the step taken.
    pub(super) fn push(&mut self, value: f64) {
        if self.weights.is_empty() {
            return;
        }
        self.values.truncate(self.weights.len() - 1);
        self.values.insert(0, value);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::FractionalDerivative;

    #[test]
    fn is_the_derivative_of_the_steps_taken() {
        let rule = ChordTransition::Fractional(FractionalTransition::default());
        let [mut memory, _] = rule.memories();
        let samples = [1.0, 0.9, 1.0, 0.7, 0.8, 1.0, 0.95, 1.0, 0.9, 1.0];
        let expected = FractionalDerivative::new(0.5, 1.0)
            .with_window(8)
            .of(&samples);
        for (value, expected) in samples.into_iter().zip(expected) {
            let derivative = memory.derivative(value, memory.past());
            assert!((derivative - expected.max(0.05 * value)).abs() < 1e-12);
            memory.push(value);
        }
        memory.forget();
        assert_eq!(memory.past(), 0.0);
    }

    #[test]
    fn without_an_order_nothing_changes() {
        let [mut memory, _] = ChordTransition::Plain.memories();
        memory.push(0.3);
        assert_eq!(memory.derivative(0.7, memory.past()), 0.7);
    }

    #[test]
    fn a_derivative_sets_candidates_farther_apart() {
        let [mut memory, _] =
            ChordTransition::Fractional(FractionalTransition::default()).memories();
        for _ in 0..8 {
            memory.push(1.0);
        }
        let past = memory.past();
        let ratio = memory.derivative(0.9, past) / memory.derivative(1.0, past);
        assert!(ratio < 0.6, "{ratio}");
    }
}
