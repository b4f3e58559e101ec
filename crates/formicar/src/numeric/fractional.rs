//! Derivatives of fractional order by Grünwald and Letnikov.

use std::collections::VecDeque;

/// The first `n` weights of the derivative of order a: w(0) = 1,
/// w(k) = w(k - 1) (1 - (a + 1) / k), that is (-1)^k C(a, k).
///
/// Li 2024 (4-5); Podlubny 1999, section 2.2.
///
/// ```
/// use formicar::numeric::grunwald_letnikov_weights;
///
/// // Order 1 is the backward difference; order 1/2 remembers.
/// assert_eq!(grunwald_letnikov_weights(1.0, 3), [1.0, -1.0, 0.0]);
/// assert_eq!(grunwald_letnikov_weights(0.5, 3), [1.0, -0.5, -0.125]);
/// ```
pub fn grunwald_letnikov_weights(order: f64, n: usize) -> Vec<f64> {
    let mut weights = Vec::with_capacity(n);
    let mut weight = 1.0;
    for k in 0..n {
        if k > 0 {
            weight *= 1.0 - (order + 1.0) / k as f64;
        }
        weights.push(weight);
    }
    weights
}

/// D^a f at equally spaced samples: h^-a times the sum of w(k) f(t - k h) over the samples so far,
/// or over the last ones alone (short memory).
///
/// Order 0 gives the samples themselves, order 1 backward differences, negative orders integrals.
/// The error is of order h where f and its first derivatives vanish at the first sample.
#[derive(Clone, Debug, PartialEq)]
pub struct FractionalDerivative {
    order: f64,
    step: f64,
    window: Option<usize>,
}

impl FractionalDerivative {
    /// The derivative of an order, from samples `step` apart, with full memory.
    ///
    /// `step` must be positive.
    pub fn new(order: f64, step: f64) -> Self {
        Self {
            order,
            step,
            window: None,
        }
    }

    /// The same from the last `window` samples alone, at least one.
    #[must_use]
    pub fn with_window(self, window: usize) -> Self {
        Self {
            window: Some(window.max(1)),
            ..self
        }
    }

    /// The derivative at every sample. Time grows with samples times memory.
    pub fn of(&self, samples: &[f64]) -> Vec<f64> {
        let memory = self.window.unwrap_or(samples.len());
        let weights = grunwald_letnikov_weights(self.order, memory.min(samples.len()));
        let at = |i: usize| {
            let past = samples[..=i].iter().rev();
            self.scale() * past.zip(&weights).map(|(f, w)| f * w).sum::<f64>()
        };
        (0..samples.len()).map(at).collect()
    }

    /// The same for samples that come one after the other.
    pub fn stream(&self) -> FractionalStream {
        FractionalStream {
            scale: self.scale(),
            derivative: self.clone(),
            weights: Vec::new(),
            past: VecDeque::new(),
        }
    }

    /// h^-a.
    fn scale(&self) -> f64 {
        self.step.powf(-self.order)
    }
}

/// A fractional derivative of samples that come one after the other.
#[derive(Clone, Debug, PartialEq)]
pub struct FractionalStream {
    derivative: FractionalDerivative,
    /// h^-a.
    scale: f64,
    weights: Vec<f64>,
    /// Samples, the latest first.
    past: VecDeque<f64>,
}

impl FractionalStream {
    /// Takes a sample, and gives the derivative there.
    pub fn push(&mut self, sample: f64) -> f64 {
        self.past.push_front(sample);
        if let Some(window) = self.derivative.window {
            self.past.truncate(window);
        }
        self.scale * sample + self.scaled_memory(1)
    }

    /// What samples before the next one contribute to its derivative: all but h^-a times that
    /// sample.
    pub fn memory(&mut self) -> f64 {
        if let Some(window) = self.derivative.window {
            // The oldest sample makes room for the next one.
            self.past.truncate(window.saturating_sub(1));
        }
        self.grow_weights(self.past.len() + 1);
        let past = self.past.iter().zip(&self.weights[1..]);
        self.scale * past.map(|(f, w)| f * w).sum::<f64>()
    }

    /// What samples from the `first` latest on contribute.
    fn scaled_memory(&mut self, first: usize) -> f64 {
        self.grow_weights(self.past.len());
        let past = self.past.iter().zip(&self.weights).skip(first);
        self.scale * past.map(|(f, w)| f * w).sum::<f64>()
    }

    fn grow_weights(&mut self, n: usize) {
        if self.weights.len() < n {
            let n_more = n.next_power_of_two();
            self.weights = grunwald_letnikov_weights(self.derivative.order, n_more);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::ln_gamma;
    use proptest::prelude::*;

    #[test]
    fn weights_are_binomial_coefficients_with_alternating_signs() {
        assert_eq!(
            grunwald_letnikov_weights(2.0, 5),
            [1.0, -2.0, 1.0, 0.0, 0.0]
        );
        assert_eq!(grunwald_letnikov_weights(0.0, 3), [1.0, 0.0, 0.0]);
        let half = grunwald_letnikov_weights(0.5, 4);
        assert_eq!(half, [1.0, -0.5, -0.125, -0.0625]);
    }

    #[test]
    fn order_0_is_the_identity_and_order_1_the_backward_difference() {
        let samples = [3.0, 1.0, 4.0, 1.5, 9.0];
        assert_eq!(FractionalDerivative::new(0.0, 0.1).of(&samples), samples);
        let first = FractionalDerivative::new(1.0, 0.5).of(&samples);
        let differences = samples.windows(2).map(|w| (w[1] - w[0]) / 0.5);
        let expected: Vec<f64> = std::iter::once(6.0).chain(differences).collect();
        assert_eq!(first, expected);
    }

    /// The relative error at t = 1 of D^a t^p, which is Gamma(p + 1) / Gamma(p + 1 - a) t^(p - a).
    fn error_of_power(order: f64, power: f64, n: usize) -> f64 {
        let step = 1.0 / n as f64;
        let samples: Vec<f64> = (0..=n).map(|i| (i as f64 * step).powf(power)).collect();
        let derivative = FractionalDerivative::new(order, step).of(&samples)[n];
        let exact = (ln_gamma(power + 1.0) - ln_gamma(power + 1.0 - order)).exp();
        (derivative / exact - 1.0).abs()
    }

    #[test]
    fn powers_have_their_known_derivatives_to_first_order() {
        for (order, power) in [(0.5, 1.0), (0.5, 2.0), (0.3, 1.5), (0.9, 2.0), (-0.5, 1.0)] {
            let (coarse, fine) = (
                error_of_power(order, power, 200),
                error_of_power(order, power, 400),
            );
            assert!(fine < 5e-3, "D^{order} t^{power}: {fine}");
            let ratio = coarse / fine;
            assert!((1.8..2.2).contains(&ratio), "D^{order} t^{power}: {ratio}");
        }
    }

    proptest! {
        #[test]
        fn a_stream_gives_what_the_batch_gives(
            samples in prop::collection::vec(-10.0_f64..10.0, 1..40),
            order in -1.0_f64..2.0,
            window in prop::option::of(1_usize..20),
        ) {
            let full = FractionalDerivative::new(order, 0.2);
            let derivative = match window {
                Some(window) => full.with_window(window),
                None => full,
            };
            let mut stream = derivative.stream();
            for (sample, expected) in samples.iter().zip(derivative.of(&samples)) {
                let memory = stream.memory();
                let split = derivative.scale() * sample + memory;
                let whole = stream.push(*sample);
                prop_assert!((whole - expected).abs() <= 1e-9 * (1.0 + expected.abs()));
                prop_assert!((split - expected).abs() <= 1e-9 * (1.0 + expected.abs()));
            }
        }
    }
}
