//! Line charts: series over an axis, with bands, ribbons and limits.

use super::palette::{self, Color};
use super::style::Dash;
use crate::geometry::Point2;

/// An axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Axis {
    /// Quantity and unit; an x axis without one shows no numbers (for charts in a stack).
    pub label: String,
    /// Lowest and highest value; taken from the data where `None`.
    pub range: Option<(f64, f64)>,
}

impl Axis {
    /// An axis whose range comes from the data.
    pub fn named(label: &str) -> Self {
        Self {
            label: label.to_owned(),
            range: None,
        }
    }
}

/// The axis that a series is read against.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Side {
    /// [`Chart::y`].
    #[default]
    Left,
    /// [`Chart::y_right`].
    Right,
}

/// A line; points that are not finite interrupt it.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Its name in the legend; empty to stay out of it.
    pub label: String,
    /// Its points, x ascending.
    pub points: Vec<Point2>,
    /// Its color.
    pub color: Color,
    /// How it is broken.
    pub dash: Dash,
    /// Its axis.
    pub side: Side,
}

impl Series {
    /// A solid line against the left axis.
    pub fn new(label: &str, points: Vec<Point2>, color: Color) -> Self {
        Self {
            label: label.to_owned(),
            points,
            color,
            dash: Dash::Solid,
            side: Side::Left,
        }
    }
}

/// The ground between two lines over the same x: quartiles around a median.
#[derive(Clone, Debug, PartialEq)]
pub struct Ribbon {
    /// Its name in the legend; empty to stay out of it.
    pub label: String,
    /// `[x, low, high]`, x ascending.
    pub points: Vec<[f64; 3]>,
    /// Its color.
    pub color: Color,
}

/// A stretch of the x axis with a meaning of its own: shaded.
#[derive(Clone, Debug, PartialEq)]
pub struct Band {
    /// Its name in the legend; empty to stay out of it.
    pub label: String,
    /// Where it begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
}

/// A value of the left axis that must not be passed.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    /// What is written beside its line.
    pub label: String,
    /// The value.
    pub value: f64,
}

/// A chart with one x axis and one or two y axes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Chart {
    /// Heading; empty for none.
    pub title: String,
    /// The axis below.
    pub x: Axis,
    /// The axis on the left.
    pub y: Axis,
    /// The axis on the right.
    pub y_right: Option<Axis>,
    /// Shaded stretches.
    pub bands: Vec<Band>,
    /// Shaded ground between lines, against the left axis.
    pub ribbons: Vec<Ribbon>,
    /// Lines.
    pub series: Vec<Series>,
    /// Limit lines.
    pub limits: Vec<Limit>,
    /// A point of the left axis to be ringed, and what is written beside it.
    pub ringed: Option<(Point2, String)>,
    /// Height of the plot area in pixels of a picture about 1200 wide; 0 for the usual one.
    pub height_px: f64,
}

/// Colors for the series of one chart, in turn; vary the dash too, for greyscale.
pub const SERIES_COLORS: [Color; 4] = [
    palette::FORWARD,
    palette::REVERSE,
    palette::START,
    palette::GOAL,
];

impl Chart {
    /// Lowest and highest x.
    pub(super) fn x_range(&self) -> (f64, f64) {
        let lines = self
            .series
            .iter()
            .flat_map(|s| s.points.iter().map(|p| p.x));
        let ribbons = self
            .ribbons
            .iter()
            .flat_map(|r| r.points.iter().map(|p| p[0]));
        self.x.range.unwrap_or_else(|| span(lines.chain(ribbons)))
    }

    /// Lowest and highest y of a side, with a little air.
    pub(super) fn y_range(&self, side: Side) -> (f64, f64) {
        let lines = self.series.iter().filter(|s| s.side == side);
        let lines = lines.flat_map(|s| s.points.iter().map(|p| p.y));
        let (axis, others) = match side {
            Side::Right => (self.y_right.as_ref(), Vec::new()),
            Side::Left => {
                let ribbons = self.ribbons.iter().flat_map(|r| &r.points);
                let limits = self.limits.iter().map(|l| l.value);
                let edges = ribbons.flat_map(|p| [p[1], p[2]]);
                (Some(&self.y), edges.chain(limits).collect())
            }
        };
        axis.and_then(|a| a.range).unwrap_or_else(|| {
            let (low, high) = span(lines.chain(others));
            // Limits at an end are named beyond their line.
            let limit_at = |end: f64| self.limits.iter().any(|l| l.value == end);
            let air = |end| match side {
                Side::Left if limit_at(end) => 0.22 * (high - low),
                _ if end == 0.0 => 0.0,
                _ => 0.08 * (high - low),
            };
            (low - air(low), high + air(high))
        })
    }
}

/// Lowest and highest of the finite values below 1e15; never empty.
fn span(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let drawable = values.filter(|v| v.abs() < 1e15);
    let (low, high) = drawable.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
        (low.min(v), high.max(v))
    });
    if low > high {
        return (0.0, 1.0);
    }
    if high - low > 1e-9 * high.abs() {
        return (low, high);
    }
    let half = (0.5 * low.abs()).max(0.5);
    (low - half, high + half)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_cover_lines_and_limits_and_pass_over_what_is_no_number() {
        let points = [(0.0, 1.0), (4.0, f64::NAN), (5.0, 3.0)].map(|(x, y)| Point2::new(x, y));
        let limit = Limit {
            label: String::new(),
            value: 11.0,
        };
        let chart = Chart {
            series: vec![Series::new("", points.to_vec(), palette::INK)],
            limits: vec![limit],
            ..Chart::default()
        };
        assert_eq!(chart.x_range(), (0.0, 5.0));
        let (low, high) = chart.y_range(Side::Left);
        assert!((low - 0.2).abs() < 1e-12 && (high - 13.2).abs() < 1e-12);
        assert_eq!(Chart::default().y_range(Side::Right), (0.0, 1.08));
    }
}
