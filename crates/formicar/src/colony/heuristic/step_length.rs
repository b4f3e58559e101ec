//! Visibility as the shortness of a step: eta = 1 / its length.

use super::desire::{LogDesire, step_length};
use crate::parameters::parameters;

parameters! {
    /// eta = 1 / d with the length d of the step: 1, or the square root of 2 for a diagonal one.
    ///
    /// Wang 2019 (8) to the letter. With beta = 7 it gives a diagonal step 0.088 of the weight of a
    /// straight one.
    pub struct StepLength {
        /// β: exponent of η.
        #[range(0.0..=100.0)]
        pub beta: f64 = 1.0,
    }
}

impl StepLength {
    pub(super) fn add_to(&self, desire: &mut LogDesire) {
        for (step, log) in desire.steps.iter_mut().enumerate() {
            *log -= self.beta * step_length(step).ln();
        }
    }
}
