//! From values to shares of a color scale.

use super::legend::Swatch;

/// The mapping of values to colors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum HeatScale {
    /// Equal differences look equal.
    Linear,
    /// Equal ratios look equal, over at most so many powers of ten below the largest value.
    Log { max_decades: f64 },
}

/// A color scale over the values that it was made for.
pub(super) struct Heat {
    scale: HeatScale,
    low: f64,
    high: f64,
}

impl Heat {
    /// The scale for some values; none where no value is finite.
    pub(super) fn new(values: &[f32], scale: HeatScale) -> Option<Self> {
        let finite = values.iter().copied().filter(|v| v.is_finite());
        let (least, most) = finite.fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), v| {
            (low.min(v), high.max(v))
        });
        let (least, high) = (f64::from(least), f64::from(most));
        let low = match scale {
            HeatScale::Linear => least,
            HeatScale::Log { max_decades } => least.max(high / 10_f64.powf(max_decades)),
        };
        (least <= high).then_some(Self { scale, low, high })
    }

    /// The position of a value between the ends, 0 to 1; 0 where they are equal, none beyond them.
    pub(super) fn share(&self, value: f64) -> Option<f64> {
        let share = match self.scale {
            HeatScale::Linear => (value - self.low) / (self.high - self.low),
            HeatScale::Log { .. } => (value / self.low).ln() / (self.high / self.low).ln(),
        };
        let is_within = (self.low..=self.high).contains(&value);
        is_within.then(|| share.max(0.0))
    }

    pub(super) fn swatch(&self) -> Swatch {
        Swatch::Heat {
            low: self.low,
            high: self.high,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_log_scale_shows_ratios_down_to_its_end() {
        let values = [1e-9, 0.1, f32::NAN, 10.0, 1000.0];
        let heat = Heat::new(&values, HeatScale::Log { max_decades: 4.0 }).unwrap();
        assert_eq!(heat.share(1e-9), None);
        assert_eq!(heat.share(f64::NAN), None);
        let shares = [0.1, 10.0, 1000.0].map(|v| heat.share(v).unwrap());
        let expected = [0.0, 0.5, 1.0];
        let is_close = |(a, b): (&f64, f64)| (a - b).abs() < 1e-6;
        assert!(shares.iter().zip(expected).all(is_close), "{shares:?}");
    }

    #[test]
    fn equal_and_negative_values_are_no_trouble() {
        for scale in [HeatScale::Linear, HeatScale::Log { max_decades: 3.0 }] {
            let equal = Heat::new(&[2.0, 2.0], scale).unwrap();
            assert_eq!(equal.share(2.0), Some(0.0));
            assert!(Heat::new(&[f32::INFINITY], scale).is_none());
            for values in [[-2.0, -1.0, 0.0], [-2.0, -1.0, 1.0], [0.0, 0.0, 0.0]] {
                let heat = Heat::new(&values, scale).unwrap();
                let shares = values.map(|v| heat.share(f64::from(v)));
                assert!(
                    shares.iter().flatten().all(|s| (0.0..=1.0).contains(s)),
                    "{shares:?}"
                );
            }
        }
    }
}
