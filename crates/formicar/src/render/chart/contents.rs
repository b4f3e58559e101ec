//! What a chart shows: axes, and lines, ribbons, dots and boxes over them.

use crate::geometry::Point2;
use crate::render::palette::{self, Color};
use crate::render::style::Dash;

/// Spacing of values along an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum AxisScale {
    /// Equal differences are equally far apart.
    #[default]
    Linear,
    /// Equal ratios are equally far apart; values of 0 and below are left out.
    Log,
}

/// An axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Axis {
    /// Quantity and unit; an x axis without one shows no numbers (for charts in a stack).
    pub label: String,
    /// Lowest and highest value; taken from the data where `None`.
    pub range: Option<(f64, f64)>,
    /// Spacing of its values.
    pub scale: AxisScale,
}

impl Axis {
    /// A linear axis whose range comes from the data.
    pub fn named(label: &str) -> Self {
        Self {
            label: label.to_owned(),
            ..Self::default()
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
    /// Its dashes.
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

/// A scatter of dots against the left axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Dots {
    /// Their places.
    pub points: Vec<Point2>,
    /// Their color.
    pub color: Color,
    /// Their inside.
    pub fill: DotFill,
    /// The radius of a dot.
    pub radius_px: f64,
    /// A value of the left axis from which a thin line leads to each dot.
    pub stem_from: Option<f64>,
}

/// The inside of a dot.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DotFill {
    /// In the dot's color.
    #[default]
    Solid,
    /// In the page's color: a ring.
    Hollow,
}

/// A stretch of the x axis with a meaning of its own: shaded.
#[derive(Clone, Debug, PartialEq)]
pub struct Band {
    /// Its name in the legend; empty to stay out of it.
    pub label: String,
    /// Its beginning.
    pub from: f64,
    /// Its end.
    pub to: f64,
}

/// A value that is marked by a line across the chart: a limit or a reference.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    /// The words beside its line.
    pub label: String,
    /// The value.
    pub value: f64,
}

/// A chart with one x axis and one or two y axes, or with rows of boxes over an x axis.
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
    /// Dots, above the lines.
    pub dots: Vec<Dots>,
    /// Rows of boxes from above down; their names take the place of the left axis.
    pub boxes: Vec<BoxRow>,
    /// Values of the left axis that must not be passed.
    pub limits: Vec<Limit>,
    /// A value of the x axis to compare with.
    pub reference: Option<Limit>,
    /// A point of the left axis to be ringed, and the words beside it.
    pub ringed: Option<(Point2, String)>,
    /// Height of the plot area in pixels of a picture about 1200 wide; 0 for the usual one.
    pub height_px: f64,
}

/// Colors for the series of one chart, in turn; vary the dash too, for grayscale.
pub const SERIES_COLORS: [Color; 4] = [
    palette::FORWARD,
    palette::REVERSE,
    palette::START,
    palette::GOAL,
];

/// Colors and dashes for up to seven series of one chart, in turn; no two look alike in grayscale
/// and in color.
pub const SERIES_LOOKS: [(Color, Dash); 7] = [
    (palette::FORWARD, Dash::Solid),
    (palette::REVERSE, Dash::Dashed),
    (palette::START, Dash::Dotted),
    (palette::GOAL, Dash::DashDotted),
    (palette::WAYPOINTS, Dash::Dashed),
    (palette::INK, Dash::Dotted),
    (palette::LIMIT, Dash::Solid),
];

/// A row of a chart of boxes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BoxRow {
    /// Its name, left of the axis.
    pub name: String,
    /// Lower quartile, median and upper quartile; `None` without values.
    pub quartiles: Option<[f64; 3]>,
    /// The ends of the whiskers.
    pub whiskers: [f64; 2],
    /// Every value, as a dot.
    pub values: Vec<f64>,
}
