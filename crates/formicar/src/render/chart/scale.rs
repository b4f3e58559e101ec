//! An axis laid over values: shares of its length, and round values on it.

use super::AxisScale;
use crate::render::ticks;

/// Shorter logarithmic axes than this ratio are marked like linear ones.
const LEAST_DECADES_RATIO: f64 = 8.0;

/// An axis from a lowest to a highest value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    pub(super) kind: AxisScale,
    pub(super) low: f64,
    pub(super) high: f64,
}

/// A mark on an axis.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tick {
    pub(super) value: f64,
    pub(super) label: String,
}

impl Scale {
    pub(super) fn new(kind: AxisScale, low: f64, high: f64) -> Self {
        Self { kind, low, high }
    }

    /// Position of a value: 0 at the lowest, 1 at the highest.
    pub(super) fn share(&self, value: f64) -> f64 {
        match self.kind {
            AxisScale::Linear => (value - self.low) / (self.high - self.low),
            AxisScale::Log => (value / self.low).ln() / (self.high / self.low).ln(),
        }
    }

    /// Round values, about so many.
    pub(super) fn ticks(&self, n_most: f64) -> Vec<Tick> {
        match self.kind {
            AxisScale::Log if self.high / self.low >= LEAST_DECADES_RATIO => self.decades(n_most),
            _ => self.multiples(n_most),
        }
    }

    fn multiples(&self, n_most: f64) -> Vec<Tick> {
        let step = ticks::round_step(self.high - self.low, n_most);
        let values = ticks::multiples(self.low, self.high, step).into_iter();
        let tick = |value| Tick {
            value,
            label: ticks::label(value, step),
        };
        values.map(tick).collect()
    }

    /// Powers of ten, with 2 and 5 between them where there is room, or only some of them.
    fn decades(&self, n_most: f64) -> Vec<Tick> {
        let (first, last) = (self.low.log10().floor(), self.high.log10().ceil());
        let n_decades = (self.high / self.low).log10();
        let factors: &[f64] = if 3.0 * n_decades <= n_most {
            &[1.0, 2.0, 5.0]
        } else {
            &[1.0]
        };
        let step = (n_decades / n_most).ceil().max(1.0) as usize;
        let powers = (first as i32..=last as i32).step_by(step);
        let values = powers.flat_map(|n| factors.iter().map(move |f| (f * 10_f64.powi(n), n)));
        let tick = |(value, n)| Tick {
            value,
            label: ticks::label(value, 10_f64.powi(n)),
        };
        let inside = values.filter(|(value, _)| (self.low..=self.high).contains(value));
        inside.map(tick).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(low: f64, high: f64, kind: AxisScale) -> Vec<String> {
        let ticks = Scale::new(kind, low, high).ticks(5.5);
        ticks.into_iter().map(|tick| tick.label).collect()
    }

    #[test]
    fn marks_are_round_and_inside() {
        assert_eq!(
            labels(-0.4, 10.4, AxisScale::Linear),
            ["0", "2", "4", "6", "8", "10"]
        );
        assert_eq!(
            labels(-0.109, 0.129, AxisScale::Linear),
            ["-0.10", "-0.05", "0", "0.05", "0.10"]
        );
        assert_eq!(
            labels(2.8, 2.1e4, AxisScale::Log),
            ["10", "100", "1000", "10000"]
        );
        assert_eq!(labels(2.8, 42.4, AxisScale::Log), ["5", "10", "20"]);
        assert_eq!(
            labels(0.08, 1.1, AxisScale::Log),
            ["0.1", "0.2", "0.5", "1"]
        );
    }

    #[test]
    fn equal_ratios_are_equally_far_apart_on_a_logarithmic_axis() {
        let scale = Scale::new(AxisScale::Log, 1.0, 100.0);
        assert!((scale.share(10.0) - 0.5).abs() < 1e-12);
        assert!((scale.share(100.0) - 1.0).abs() < 1e-12);
    }
}
