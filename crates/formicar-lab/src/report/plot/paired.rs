//! Differences between two that had the same seeds.

use crate::analysis::statistics::quantile;
use formicar::geometry::Point2;
use formicar::render::{Axis, Chart, ChartGrid, DotFill, Dots, SERIES_LOOKS, Series, palette};
use serde::Serialize;

const N_COLUMNS: usize = 3;
const HEIGHT_PX: f64 = 120.0;

/// The differences of one pair of groups.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct PairedPanel {
    /// The two that are compared.
    pub name: String,
    /// A difference per seed or scenario, in any order.
    pub differences: Vec<f64>,
}

/// Differences one by one, sorted, from a line at 0: filled dots below it, hollow ones above; a
/// panel per comparison, each with its own axis.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct PairedPlot {
    /// The caption below the picture.
    pub caption: String,
    /// Quantity and unit.
    pub quantity: String,
    /// The comparisons.
    pub panels: Vec<PairedPanel>,
}

impl PairedPlot {
    /// The picture.
    pub fn to_svg(&self) -> String {
        let grid = ChartGrid {
            title: format!("Paired differences: {}", self.quantity),
            charts: self.panels.iter().map(PairedPanel::chart).collect(),
            n_columns: N_COLUMNS,
            ..ChartGrid::default()
        };
        grid.to_svg()
    }
}

impl PairedPanel {
    fn chart(&self) -> Chart {
        let mut sorted = self.differences.clone();
        sorted.retain(|d| d.is_finite());
        sorted.sort_by(f64::total_cmp);
        let places = || {
            let numbered = sorted.iter().enumerate();
            numbered.map(|(i, &d)| Point2::new(i as f64 + 1.0, d))
        };
        let dots = |fill, points: Vec<Point2>, (color, _)| Dots {
            points,
            color,
            fill,
            radius_px: 2.6,
            stem_from: Some(0.0),
        };
        let below = places().filter(|p| p.y <= 0.0).collect();
        let above = places().filter(|p| p.y > 0.0).collect();
        let end = sorted.len() as f64 + 1.0;
        let zero = vec![Point2::default(), Point2::new(end, 0.0)];
        Chart {
            title: self.name.clone(),
            x: Axis {
                range: Some((0.0, end)),
                ..Axis::named(&summary(&sorted))
            },
            series: vec![Series::new("", zero, palette::INK)],
            dots: vec![
                dots(DotFill::Solid, below, SERIES_LOOKS[0]),
                dots(DotFill::Hollow, above, SERIES_LOOKS[1]),
            ],
            height_px: HEIGHT_PX,
            ..Chart::default()
        }
    }
}

/// The number of pairs and the sides of 0 on which they lie.
fn summary(sorted: &[f64]) -> String {
    let Some(median) = quantile(sorted, 0.5) else {
        return "no pairs".to_owned();
    };
    let n_below = sorted.iter().filter(|d| **d < 0.0).count();
    let n_above = sorted.iter().filter(|d| **d > 0.0).count();
    format!(
        "{} pairs, sorted: median {}, {n_below} below, {n_above} above 0",
        sorted.len(),
        short(median)
    )
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
