//! Values and where they stand.

use super::canvas::{Anchor, Canvas, HAIRLINE, MUTED, Pen, RULE, TEXT_PX, width_px};

/// Whether equal differences or equal ratios are equally far apart.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum ScaleKind {
    /// Equal differences.
    #[default]
    Linear,
    /// Equal ratios; values from 0 down are left out.
    Log,
}

/// An axis from a lowest to a highest value, laid between two pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    kind: ScaleKind,
    low: f64,
    high: f64,
    px: [f64; 2],
}

/// A mark on an axis.
pub(super) struct Tick {
    pub(super) px: f64,
    pub(super) label: String,
}

impl Scale {
    /// An axis that holds all values that are finite, with a little room beside them.
    pub(super) fn fit(values: impl Iterator<Item = f64>, kind: ScaleKind, px: [f64; 2]) -> Self {
        let shown = values.filter(|v| v.is_finite() && (kind == ScaleKind::Linear || *v > 0.0));
        let (low, high) = shown.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
            (low.min(v), high.max(v))
        });
        let (low, high) = if low <= high { (low, high) } else { (1.0, 2.0) };
        let (low, high) = match kind {
            ScaleKind::Log => (low / 1.06, high * 1.06),
            ScaleKind::Linear => {
                let room = if high > low {
                    0.04 * (high - low)
                } else {
                    0.05 * high.abs().max(0.1)
                };
                (low - room, high + room)
            }
        };
        Self {
            kind,
            low,
            high,
            px,
        }
    }

    pub(super) fn px(&self, value: f64) -> f64 {
        let share = match self.kind {
            ScaleKind::Linear => (value - self.low) / (self.high - self.low),
            ScaleKind::Log => (value / self.low).ln() / (self.high / self.low).ln(),
        };
        self.px[0] + share * (self.px[1] - self.px[0])
    }

    /// Where the axis begins.
    pub(super) fn left_px(&self) -> f64 {
        self.px[0]
    }

    /// Round values, about as many as fit.
    pub(super) fn ticks(&self) -> Vec<Tick> {
        let length_px = (self.px[1] - self.px[0]).abs();
        let values = match self.kind {
            ScaleKind::Log if self.high / self.low >= 8.0 => self.decades(length_px / 56.0),
            _ => self.multiples(length_px / 62.0),
        };
        let tick = |(value, label)| Tick {
            px: self.px(value),
            label,
        };
        values.into_iter().map(tick).collect()
    }

    fn multiples(&self, n_most: f64) -> Vec<(f64, String)> {
        let rough = (self.high - self.low) / n_most.max(2.0);
        let power = 10_f64.powf(rough.log10().floor());
        let factor = [1.0, 2.0, 5.0].into_iter().find(|f| f * power >= rough);
        let step = factor.unwrap_or(10.0) * power;
        let n_decimals = (-(step.log10() + 1e-9).floor()).clamp(0.0, 9.0) as usize;
        let (first, last) = ((self.low / step).ceil(), (self.high / step).floor());
        let n = (last - first).clamp(0.0, 100.0) as usize;
        let at = |i: usize| {
            let value = (first + i as f64) * step;
            let value = if value.abs() < 1e-12 * step {
                0.0
            } else {
                value
            };
            (value, label(value, n_decimals))
        };
        (0..=n).map(at).collect()
    }

    /// Powers of ten, with 2 and 5 between them where there is room, or only some of them.
    fn decades(&self, n_most: f64) -> Vec<(f64, String)> {
        let (first, last) = (
            self.low.log10().floor() as i32,
            self.high.log10().ceil() as i32,
        );
        let n_decades = (self.high / self.low).log10();
        let factors: &[f64] = if 3.0 * n_decades <= n_most {
            &[1.0, 2.0, 5.0]
        } else {
            &[1.0]
        };
        let step = (n_decades / n_most).ceil().max(1.0) as usize;
        let powers = (first..=last).step_by(step);
        let values = powers.flat_map(|n| factors.iter().map(move |f| f * 10_f64.powi(n)));
        let inside = values.filter(|v| (self.low..=self.high).contains(v));
        let n_decimals = |v: f64| (-v.log10().floor()).clamp(0.0, 9.0) as usize;
        inside.map(|v| (v, label(v, n_decimals(v)))).collect()
    }

    /// Draws an axis below a plot: hairlines up to `top_px`, numbers and a name.
    pub(super) fn draw_below(
        &self,
        canvas: &mut Canvas,
        [top_px, bottom_px]: [f64; 2],
        name: &str,
    ) {
        for tick in self.ticks() {
            canvas.line(
                [tick.px, top_px],
                [tick.px, bottom_px],
                Pen::new(HAIRLINE, 1.0),
            );
            let place = [tick.px, bottom_px + TEXT_PX + 4.0];
            canvas.text(place, &tick.label, (Anchor::Middle, MUTED));
        }
        let ends = [[self.px[0], bottom_px], [self.px[1], bottom_px]];
        canvas.line(ends[0], ends[1], Pen::new(RULE, 1.0));
        let middle = 0.5 * (self.px[0] + self.px[1]);
        let place = [middle, bottom_px + 2.0 * TEXT_PX + 9.0];
        canvas.text(place, name, (Anchor::Middle, MUTED));
    }

    /// Draws an axis left of a plot: hairlines up to `right_px`, numbers and a name.
    pub(super) fn draw_left(&self, canvas: &mut Canvas, [left_px, right_px]: [f64; 2], name: &str) {
        let mut widest_px: f64 = 0.0;
        for tick in self.ticks() {
            canvas.line(
                [left_px, tick.px],
                [right_px, tick.px],
                Pen::new(HAIRLINE, 1.0),
            );
            let place = [left_px - 6.0, tick.px + 0.35 * TEXT_PX];
            canvas.text(place, &tick.label, (Anchor::End, MUTED));
            widest_px = widest_px.max(width_px(&tick.label));
        }
        let ends = [[left_px, self.px[0]], [left_px, self.px[1]]];
        canvas.line(ends[0], ends[1], Pen::new(RULE, 1.0));
        if !name.is_empty() {
            let middle = 0.5 * (self.px[0] + self.px[1]);
            canvas.upright([left_px - widest_px - 14.0, middle], name);
        }
    }
}

fn label(value: f64, n_decimals: usize) -> String {
    if value.abs() >= 1e6 {
        return format!("{value:.0e}");
    }
    format!("{value:.n_decimals$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(values: &[f64], kind: ScaleKind) -> Vec<String> {
        let scale = Scale::fit(values.iter().copied(), kind, [0.0, 310.0]);
        scale.ticks().into_iter().map(|tick| tick.label).collect()
    }

    #[test]
    fn marks_are_round_and_inside() {
        let linear = |values| labels(values, ScaleKind::Linear);
        assert_eq!(linear(&[0.0, 10.0]), ["0", "5", "10"]);
        assert_eq!(
            linear(&[-0.1, 0.12]),
            ["-0.10", "-0.05", "0.00", "0.05", "0.10"]
        );
        assert_eq!(
            labels(&[3.0, 2e4], ScaleKind::Log),
            ["10", "100", "1000", "10000"]
        );
        assert_eq!(labels(&[0.0, 3.0, 40.0], ScaleKind::Log), ["5", "10", "20"]);
        // One value, or none, is an axis too.
        assert!(!linear(&[7.0]).is_empty() && !linear(&[]).is_empty());
    }
}
