//! Change over a run: medians and quartiles over many runs.

use crate::analysis::statistics::quartiles;
use formicar::geometry::Point2;
use formicar::render::{
    Axis, AxisScale, Chart, ChartGrid, Color, Dash, DotFill, Dots, Ribbon, SERIES_LOOKS, Series,
    YRange,
};
use serde::Serialize;

const HEIGHT_PX: f64 = 220.0;
/// Trends over less than this share of the axis are drawn as a dot: a line could not be seen.
const LEAST_LINE: f64 = 0.02;
/// Places along x at which the runs are compared.
const N_PLACES: usize = 240;

/// A median with its quartiles along an axis.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Trend {
    /// Its name.
    pub name: String,
    /// `[x, lower quartile, median, upper quartile]`, x ascending.
    pub points: Vec<[f64; 4]>,
}

impl Trend {
    /// Median and quartiles over runs that each hold their last value until the next: `[x,
    /// value]`, x ascending. A trend begins where three quarters of the runs have a value, those
    /// without one counting as worse than all others, and ends where the last run ends.
    pub fn of_runs(name: &str, runs: &[Vec<[f64; 2]>], scale: AxisScale) -> Self {
        let [first, last] = ends(runs.iter().flatten().map(|point| point[0]));
        let point = |x: f64| {
            let value = |run: &Vec<[f64; 2]>| {
                let n_before = run.partition_point(|point| point[0] <= x);
                n_before.checked_sub(1).map_or(f64::INFINITY, |i| run[i][1])
            };
            let [low, median, high] = quartiles(&runs.iter().map(value).collect::<Vec<_>>())?;
            high.is_finite().then_some([x, low, median, high])
        };
        let places = places([first, last], scale).into_iter();
        Self {
            name: name.to_owned(),
            points: places.filter_map(point).collect(),
        }
    }

    /// Adds the quartiles to a chart, and the median as a line.
    fn add_line(&self, chart: &mut Chart, color: Color, dash: Dash) {
        let edges = self.points.iter().map(|&[x, low, _, high]| [x, low, high]);
        chart.ribbons.push(Ribbon {
            label: String::new(),
            points: edges.collect(),
            color,
        });
        let medians = self
            .points
            .iter()
            .map(|&[x, _, median, _]| Point2::new(x, median));
        chart.series.push(Series {
            dash,
            ..Series::new(&self.name, medians.collect(), color)
        });
    }

    /// Adds the last median to a chart as a dot, with a bar between its quartiles.
    fn add_dot(&self, chart: &mut Chart, color: Color) {
        let Some(&[x, low, median, high]) = self.points.last() else {
            return;
        };
        let bar = vec![Point2::new(x, low), Point2::new(x, high)];
        chart.series.push(Series::new(&self.name, bar, color));
        chart.dots.push(Dots {
            points: vec![Point2::new(x, median)],
            color,
            fill: DotFill::Solid,
            radius_px: 4.5,
            stem_from: None,
        });
    }
}

/// Lowest and highest of some values; infinite without any.
fn ends(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| {
        [low.min(x), high.max(x)]
    })
}

fn places([first, last]: [f64; 2], scale: AxisScale) -> Vec<f64> {
    if !first.is_finite() || !last.is_finite() {
        return Vec::new();
    }
    if first == last {
        return vec![first];
    }
    let is_log = scale == AxisScale::Log && first > 0.0;
    let at = |i: usize| {
        let share = i as f64 / N_PLACES as f64;
        if is_log {
            first * (last / first).powf(share)
        } else {
            first + share * (last - first)
        }
    };
    // The last place is the last value itself, not one that rounding left just before it.
    (0..N_PLACES).map(at).chain([last]).collect()
}

/// Trends over one x axis.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct TrendPanel {
    /// The quantity of x, with its unit.
    pub x: String,
    /// Its scale.
    pub x_scale: AxisScale,
    /// The trends; a trend has the same look in all panels by its place.
    #[serde(rename = "courses")]
    pub trends: Vec<Trend>,
}

impl TrendPanel {
    fn chart(&self) -> Chart {
        let mut chart = Chart {
            x: Axis {
                scale: self.x_scale,
                ..Axis::named(&self.x)
            },
            height_px: HEIGHT_PX,
            ..Chart::default()
        };
        let [low, high] = ends(self.trends.iter().flat_map(|trend| self.positions(trend)));
        for (trend, (color, dash)) in self.trends.iter().zip(SERIES_LOOKS.into_iter().cycle()) {
            let [first, last] = ends(self.positions(trend));
            if last - first > LEAST_LINE * (high - low) {
                trend.add_line(&mut chart, color, dash);
            } else {
                trend.add_dot(&mut chart, color);
            }
        }
        chart
    }

    /// Positions of a trend along the axis, in units of its scale.
    fn positions<'a>(&self, trend: &'a Trend) -> impl Iterator<Item = f64> + use<'a> {
        let is_log = self.x_scale == AxisScale::Log;
        let xs = trend.points.iter().map(|point| point[0]);
        xs.map(move |x| if is_log { x.ln() } else { x })
    }
}

/// Panels side by side over one y axis: medians as lines, quartiles as bands.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Trends {
    /// The caption below the picture.
    pub caption: String,
    /// Quantity and unit.
    pub quantity: String,
    /// Its scale.
    pub y_scale: AxisScale,
    /// The panels from left to right.
    pub panels: Vec<TrendPanel>,
}

impl Trends {
    /// The picture.
    pub fn to_svg(&self) -> String {
        let mut charts: Vec<Chart> = self.panels.iter().map(TrendPanel::chart).collect();
        for chart in &mut charts {
            chart.y.scale = self.y_scale;
        }
        if let Some(first) = charts.first_mut() {
            first.title.clone_from(&self.quantity);
        }
        let grid = ChartGrid {
            title: format!("Trend: {}", self.quantity),
            charts,
            n_columns: self.panels.len(),
            y_range: YRange::Shared,
        };
        grid.to_svg()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_hold_their_values_and_late_ones_count_as_worse() {
        let runs = [
            vec![[1.0, 9.0], [3.0, 5.0]],
            vec![[2.0, 7.0]],
            vec![[1.0, 8.0]],
            vec![[1.0, 6.0]],
        ];
        let trend = Trend::of_runs("ants", &runs, AxisScale::Linear);
        // The second has nothing before 2: the upper quartile is between 9 and nothing.
        assert_eq!(trend.points[0][0], 2.0);
        assert_eq!(trend.points[0], [2.0, 6.75, 7.5, 8.25]);
        // 5, 6, 7, 8.
        assert_eq!(trend.points.last(), Some(&[3.0, 5.75, 6.5, 7.25]));
        assert!(Trend::of_runs("", &[], AxisScale::Log).points.is_empty());
        assert!(
            Trend::of_runs("", &[Vec::new()], AxisScale::Linear)
                .points
                .is_empty()
        );
    }

    #[test]
    fn a_trend_of_one_place_is_a_point_with_its_quartiles() {
        let runs = [vec![[1.0, 2.0]], vec![[1.0, 4.0]], vec![[1.0, 3.0]]];
        let trend = Trend::of_runs("ants", &runs, AxisScale::Linear);
        assert_eq!(trend.points, [[1.0, 2.5, 3.0, 3.5]]);
        let trends = Trends {
            panels: vec![TrendPanel {
                trends: vec![trend],
                ..TrendPanel::default()
            }],
            ..Trends::default()
        };
        let svg = trends.to_svg();
        assert_eq!(svg.matches("<circle").count(), 1, "{svg}");
        assert!(!svg.contains("NaN"), "{svg}");
    }

    #[test]
    fn a_line_and_a_band_are_drawn_per_trend() {
        let trend = Trend {
            name: "ants".to_owned(),
            points: vec![[1.0, 1.0, 2.0, 3.0], [2.0, 1.0, 1.5, 2.0]],
        };
        let panel = TrendPanel {
            x: "iteration".to_owned(),
            trends: vec![trend.clone(), trend],
            ..TrendPanel::default()
        };
        let trends = Trends {
            quantity: "length".to_owned(),
            panels: vec![panel.clone(), panel],
            ..Trends::default()
        };
        let svg = trends.to_svg();
        assert_eq!(svg.matches("fill-opacity=\"0.22\"").count(), 4);
        assert_eq!(svg.matches(">ants</text>").count(), 1);
        assert!(!svg.contains("NaN"), "{svg}");
    }
}
