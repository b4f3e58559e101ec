//! From world meters to picture pixels: the one place where north turns up.

use crate::geometry::{Point2, Pose2};
use crate::map::GridFrame;
use std::ops::Range;

/// A window on the world: pixels count right and down from its upper left corner.
#[derive(Clone, Debug)]
pub(super) struct View {
    low: Point2,
    px_per_m: f64,
    size_px: Point2,
}

/// A panel is never thinner than this, whatever its map.
const MIN_SIDE_PX: f64 = 60.0;

impl View {
    /// The view of a world rectangle, as large as fits.
    pub(super) fn fit(low: Point2, high: Point2, max_px: Point2) -> Self {
        let extent = high - low;
        let px_per_m = (max_px.x / extent.x).min(max_px.y / extent.y);
        // An extent beyond all numbers shows nothing, in a panel of the largest size.
        let side = |extent: f64, most: f64| match extent * px_per_m {
            px if px.is_finite() => px.clamp(MIN_SIDE_PX, most),
            _ => most,
        };
        let size_px = Point2::new(side(extent.x, max_px.x), side(extent.y, max_px.y));
        let center = low.lerp(high, 0.5);
        Self {
            low: center - size_px * (0.5 / px_per_m),
            px_per_m,
            size_px,
        }
    }

    pub(super) fn size_px(&self) -> Point2 {
        self.size_px
    }

    pub(super) fn px_per_m(&self) -> f64 {
        self.px_per_m
    }

    /// Lowest and highest world coordinates in view.
    pub(super) fn bounds(&self) -> (Point2, Point2) {
        (self.low, self.low + self.size_px * (1.0 / self.px_per_m))
    }

    pub(super) fn to_px(&self, world: Point2) -> Point2 {
        let d = (world - self.low) * self.px_per_m;
        Point2::new(d.x, self.size_px.y - d.y)
    }

    /// A direction in the world as a unit vector on the page.
    pub(super) fn direction(heading_rad: f64) -> Point2 {
        let unit = Point2::unit(heading_rad);
        Point2::new(unit.x, -unit.y)
    }

    /// True if a point on the page lies in the panel.
    pub(super) fn shows(&self, px: Point2) -> bool {
        (0.0..=self.size_px.x).contains(&px.x) && (0.0..=self.size_px.y).contains(&px.y)
    }

    /// The columns and rows of a grid that may be seen.
    pub(super) fn cells_in_view(&self, frame: &GridFrame) -> (Range<usize>, Range<usize>) {
        let (low, high) = self.bounds();
        let corners = [
            low,
            high,
            Point2::new(low.x, high.y),
            Point2::new(high.x, low.y),
        ];
        let scale = 1.0 / frame.resolution_m();
        let local = corners.map(|p| frame.to_grid(Pose2::at(p, 0.0)).position() * scale);
        let range = |along: fn(&Point2) -> f64, n: usize| {
            let low = local.iter().map(along).fold(f64::INFINITY, f64::min);
            let high = local.iter().map(along).fold(f64::NEG_INFINITY, f64::max);
            let end = (high.ceil().max(0.0) as usize).min(n);
            (low.floor().max(0.0) as usize).min(end)..end
        };
        (
            range(|p| p.x, frame.n_cols()),
            range(|p| p.y, frame.n_rows()),
        )
    }
}

/// Lowest and highest world coordinates of a grid, turned by its yaw.
pub(super) fn frame_bounds(frame: &GridFrame) -> (Point2, Point2) {
    let corners = frame_corners(frame);
    corners
        .iter()
        .fold((corners[0], corners[0]), |(low, high), p| {
            (
                Point2::new(low.x.min(p.x), low.y.min(p.y)),
                Point2::new(high.x.max(p.x), high.y.max(p.y)),
            )
        })
}

/// The corners of a grid in the world, counter-clockwise from its origin.
pub(super) fn frame_corners(frame: &GridFrame) -> [Point2; 4] {
    let Point2 { x, y } = frame.extent_m();
    [(0.0, 0.0), (x, 0.0), (x, y), (0.0, y)]
        .map(|(x, y)| frame.origin().transform(Point2::new(x, y)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn north_is_up() {
        let view = View::fit(
            Point2::new(0.0, 0.0),
            Point2::new(20.0, 10.0),
            Point2::new(200.0, 200.0),
        );
        assert_eq!(view.size_px(), Point2::new(200.0, 100.0));
        assert_eq!(view.to_px(Point2::new(1.0, 9.0)), Point2::new(10.0, 10.0));
    }

    #[test]
    fn a_detail_sees_its_cells_only() {
        let frame = GridFrame::new(100, 50, 0.5, Pose2::new(10.0, 0.0, 0.0)).unwrap();
        let view = View::fit(
            Point2::new(12.0, -3.0),
            Point2::new(15.0, 1.1),
            Point2::new(100.0, 100.0),
        );
        assert_eq!(view.cells_in_view(&frame), (4..10, 0..3));
    }
}
