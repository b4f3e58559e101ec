//! Charts as values: lines over an axis, with ribbons, dots, boxes, bands and limits.
//!
//! `frame` draws axes, `draw` and `boxes` what stands between them, `grid` puts charts side by side.

mod boxes;
mod contents;
mod convergence;
mod draw;
mod frame;
mod grid;
mod plot;
mod ranges;
mod scale;
mod strips;

pub use contents::{
    Axis, AxisScale, Band, BoxRow, Chart, DotFill, Dots, Limit, Ribbon, SERIES_COLORS,
    SERIES_LOOKS, Series, Side,
};
pub use convergence::convergence_charts;
pub use grid::{ChartGrid, YRange};
pub use strips::{ProfilePoint, strip_charts};

pub(super) use convergence::costs_up_to;
pub(super) use strips::{both_sides, reverse_stretches, stacked};
