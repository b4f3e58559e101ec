//! Charts in rows and columns, for a page that is read in a browser.

use super::{Chart, Side};
use crate::geometry::Point2;
use crate::render::legend::Legend;
use crate::render::svg::{Letters, Svg};

/// Width of the whole grid at full width.
const WIDTH_PX: f64 = 1000.0;
const LEGEND_GAP_PX: f64 = 4.0;
const COLUMN_GAP_PX: f64 = 16.0;
/// Air right of the last column, for numbers at the end of an axis.
const RIGHT_PX: f64 = 14.0;

/// Charts of one kind in rows, with one legend for all of them. Words are text, so that a browser
/// can search them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ChartGrid {
    /// The words that a screen reader says.
    pub title: String,
    /// The charts, row by row.
    pub charts: Vec<Chart>,
    /// Charts in a full row, at least 1: each has this share of the width.
    pub n_columns: usize,
    /// The range of the left axes.
    pub y_range: YRange,
}

/// The range of the left axes of charts side by side.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum YRange {
    /// Every chart has its own.
    #[default]
    Own,
    /// The same for all charts.
    Shared,
}

impl ChartGrid {
    /// The charts as an SVG document.
    pub fn to_svg(&self) -> String {
        let mut svg = Svg::with_letters(Letters::Font);
        let n_columns = self.n_columns.max(1);
        let gaps_px = COLUMN_GAP_PX * (n_columns - 1) as f64;
        let column_px = (WIDTH_PX - RIGHT_PX - gaps_px) / n_columns as f64;
        let n_in_row = self.charts.len().clamp(1, n_columns) as f64;
        let width_px = n_in_row * column_px + (n_in_row - 1.0) * COLUMN_GAP_PX + RIGHT_PX;
        let mut top = self.draw_legend(&mut svg, width_px);
        for row in self.ranged_charts().chunks(n_columns) {
            let heights = row.iter().map(Chart::height_without_legend_px);
            for (i, chart) in row.iter().enumerate() {
                let left = i as f64 * (column_px + COLUMN_GAP_PX);
                chart.draw_without_legend(&mut svg, Point2::new(left, top), column_px);
            }
            top += heights.fold(0.0, f64::max);
        }
        svg.document(Point2::new(width_px, top), &self.title, "")
    }

    /// The charts with the ranges of their left axes.
    fn ranged_charts(&self) -> Vec<Chart> {
        let mut charts = self.charts.clone();
        if self.y_range == YRange::Shared {
            let scales = charts.iter().map(|chart| chart.y_scale(Side::Left));
            let (low, high) = scales.fold((f64::INFINITY, f64::NEG_INFINITY), |ends, scale| {
                (ends.0.min(scale.low), ends.1.max(scale.high))
            });
            for chart in &mut charts {
                chart.y.range = Some((low, high));
            }
        }
        charts
    }

    /// Draws the names of all series, each once, and returns where they end.
    fn draw_legend(&self, svg: &mut Svg, width_px: f64) -> f64 {
        let mut legend = Legend::default();
        for chart in &self.charts {
            chart.name_series(&mut legend);
        }
        if legend.is_empty() {
            return 0.0;
        }
        let left = self.charts.first().map_or(0.0, Chart::left_px);
        let at = Point2::new(left, LEGEND_GAP_PX);
        legend.draw(svg, at, width_px - left, 0.0);
        at.y + legend.height_px(width_px - left, 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::chart::{Dots, SERIES_LOOKS, Series};
    use crate::render::{BoxRow, DotFill};

    fn chart() -> Chart {
        let points = vec![Point2::new(1.0, 2.0), Point2::new(3.0, 2.5)];
        Chart {
            series: vec![Series::new("ants", points, SERIES_LOOKS[0].0)],
            ..Chart::default()
        }
    }

    #[test]
    fn charts_in_a_row_share_a_legend() {
        let charts = vec![chart(), chart()];
        let svg = |charts: Vec<Chart>| {
            let grid = ChartGrid {
                charts,
                n_columns: 2,
                ..ChartGrid::default()
            };
            grid.to_svg()
        };
        let both = svg(charts);
        assert_eq!(both.matches(">ants</text>").count(), 1, "{both}");
        assert!(both.contains("width=\"1000\"") && !both.contains("NaN"));
        assert!(svg(vec![chart()]).contains("width=\"499\""));
        assert!(svg(Vec::new()).contains("<svg"));
    }

    #[test]
    fn dots_and_boxes_are_drawn_one_by_one() {
        let points = vec![Point2::new(1.0, 2.0), Point2::new(2.0, f64::NAN)];
        let dots = Dots {
            points,
            color: SERIES_LOOKS[1].0,
            fill: DotFill::Hollow,
            radius_px: 2.6,
            stem_from: Some(0.0),
        };
        let rows = [vec![1.0, 2.0, 30.0], Vec::new()].map(|values: Vec<f64>| BoxRow {
            name: "a < b".to_owned(),
            quartiles: (!values.is_empty()).then_some([1.0, 2.0, 3.0]),
            whiskers: [1.0, 3.0],
            values,
        });
        let scatter = Chart {
            dots: vec![dots],
            ..Chart::default()
        };
        let boxes = Chart {
            boxes: rows.to_vec(),
            ..Chart::default()
        };
        let grid = ChartGrid {
            charts: vec![scatter, boxes],
            n_columns: 1,
            ..ChartGrid::default()
        };
        let svg = grid.to_svg();
        assert_eq!(svg.matches("<circle").count(), 1 + 3, "{svg}");
        assert!(
            svg.contains("a &lt; b") && svg.contains("no value"),
            "{svg}"
        );
        assert!(!svg.contains("NaN"), "{svg}");
    }
}
