//! Differences between two that had the same seeds.

use super::axis::{Scale, ScaleKind};
use super::canvas::{Anchor, Canvas, FIRST, INK, MUTED, Pen, SECOND, TEXT_PX};
use crate::analysis::statistics::quantile;
use serde::Serialize;

const N_COLUMNS: usize = 3;
const PLOT_PX: [f64; 2] = [310.0, 120.0];
const MARGIN_PX: [f64; 4] = [52.0, 42.0, 14.0, 26.0];

/// The differences of one pair of groups.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct PairedPanel {
    /// Who is compared with whom.
    pub name: String,
    /// A difference per seed or scenario, in any order.
    pub differences: Vec<f64>,
}

/// Differences one by one, sorted, from a line at 0: filled dots below it, hollow ones above; a
/// panel per comparison, each with its own axis.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct PairedPlot {
    /// What it shows.
    pub caption: String,
    /// Quantity and unit.
    pub quantity: String,
    /// The comparisons.
    pub panels: Vec<PairedPanel>,
}

impl PairedPlot {
    /// The picture.
    pub fn to_svg(&self) -> String {
        let [left, top, right, bottom] = MARGIN_PX;
        let cell = [left + PLOT_PX[0] + right, top + PLOT_PX[1] + bottom];
        let mut canvas = Canvas::default();
        for (i, panel) in self.panels.iter().enumerate() {
            let (column, row) = (i % N_COLUMNS, i / N_COLUMNS);
            let corner = [column as f64 * cell[0] + left, row as f64 * cell[1] + top];
            draw(&mut canvas, corner, panel);
        }
        let n_rows = self.panels.len().div_ceil(N_COLUMNS).max(1);
        let n_columns = self.panels.len().clamp(1, N_COLUMNS);
        let title = format!("Paired differences: {}", self.quantity);
        let width_px = n_columns as f64 * cell[0];
        canvas.document([width_px, n_rows as f64 * cell[1] + 6.0], &title)
    }
}

fn draw(canvas: &mut Canvas, [left, top]: [f64; 2], panel: &PairedPanel) {
    let (right, bottom) = (left + PLOT_PX[0], top + PLOT_PX[1]);
    let mut sorted: Vec<f64> = panel.differences.clone();
    sorted.retain(|d| d.is_finite());
    sorted.sort_by(f64::total_cmp);
    let values = sorted.iter().copied().chain([0.0]);
    let scale = Scale::fit(values, ScaleKind::Linear, [bottom, top]);
    canvas.text([left, top - 24.0], &panel.name, (Anchor::Start, INK));
    let median = quantile(&sorted, 0.5);
    let words = median.map_or("no pairs".to_owned(), |median| {
        let n_below = sorted.iter().filter(|d| **d < 0.0).count();
        let n_above = sorted.iter().filter(|d| **d > 0.0).count();
        format!(
            "median {}, {n_below} below, {n_above} above 0",
            short(median)
        )
    });
    canvas.text([left, top - 8.0], &words, (Anchor::Start, MUTED));
    scale.draw_left(canvas, [left, right], "");
    let zero = scale.px(0.0);
    canvas.line([left, zero], [right, zero], Pen::new(INK, 1.3));
    let step = PLOT_PX[0] / (sorted.len() as f64 + 1.0);
    for (i, &difference) in sorted.iter().enumerate() {
        let place = [left + step * (i as f64 + 1.0), scale.px(difference)];
        let (color, fill) = if difference <= 0.0 {
            (FIRST, FIRST)
        } else {
            (SECOND, "#ffffff")
        };
        canvas.line([place[0], zero], place, Pen::new(color, 1.0));
        canvas.dot(place, 2.6, (fill, Pen::new(color, 1.2)));
    }
    let words = format!("{} pairs, sorted", sorted.len());
    let place = [0.5 * (left + right), bottom + TEXT_PX + 4.0];
    canvas.text(place, &words, (Anchor::Middle, MUTED));
}

/// A number with three digits that count.
fn short(value: f64) -> String {
    let n_decimals = if value == 0.0 {
        0
    } else {
        (2.0 - value.abs().log10().floor()).clamp(0.0, 6.0) as usize
    };
    format!("{value:.n_decimals$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_are_sorted_about_nought() {
        let plot = PairedPlot {
            quantity: "m".to_owned(),
            panels: vec![
                PairedPanel {
                    name: "a - b".to_owned(),
                    differences: vec![2.0, -1.0, 0.0, -3.5],
                },
                PairedPanel::default(),
            ],
            ..PairedPlot::default()
        };
        let svg = plot.to_svg();
        assert!(svg.contains("median -0.500, 2 below, 1 above 0"), "{svg}");
        assert!(svg.contains("no pairs"), "{svg}");
        assert_eq!(svg.matches("<circle").count(), 4);
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
        assert_eq!(short(0.001_234), "0.00123");
        assert_eq!(short(1234.5), "1234");
    }
}
