//! The plot area of a chart.

use super::Chart;
use super::scale::Scale;
use crate::geometry::Point2;

/// The plot area of a chart on the page, with its axes.
pub(super) struct Plot<'a> {
    pub(super) chart: &'a Chart,
    pub(super) corner: Point2,
    pub(super) size: Point2,
    pub(super) x: Scale,
    pub(super) left: Scale,
    pub(super) right: Scale,
}

impl Plot<'_> {
    /// A value of the x axis on the page.
    pub(super) fn x_px(&self, value: f64) -> f64 {
        self.corner.x + self.x.share(value) * self.size.x
    }

    pub(super) fn y_px(&self, value: f64, y: &Scale) -> f64 {
        self.corner.y + (1.0 - y.share(value)) * self.size.y
    }
}
