//! Maps drawn from axis-aligned rectangles in meters.

use super::{FREE, GridFrame, MapError, OCCUPIED, OccupancyGrid};
use crate::geometry::Pose2;

/// A rectangle in grid coordinates, meters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rect {
    pub(super) x0: f64,
    pub(super) y0: f64,
    pub(super) x1: f64,
    pub(super) y1: f64,
}

impl Rect {
    /// From the lower left to the upper right corner.
    pub(super) const fn new(x0: f64, y0: f64, x1: f64, y1: f64) -> Self {
        Self { x0, y0, x1, y1 }
    }

    /// From the lower left corner, with a width and a height.
    pub(super) const fn sized(x: f64, y: f64, [width, height]: [f64; 2]) -> Self {
        Self::new(x, y, x + width, y + height)
    }

    pub(super) fn width(&self) -> f64 {
        self.x1 - self.x0
    }

    pub(super) fn height(&self) -> f64 {
        self.y1 - self.y0
    }

    /// The rectangle with x and y exchanged.
    pub(super) fn transposed(self) -> Self {
        Self::new(self.y0, self.x0, self.y1, self.x1)
    }

    /// The rectangle with every side moved inwards.
    pub(super) fn inset(self, by: f64) -> Self {
        Self::new(self.x0 + by, self.y0 + by, self.x1 - by, self.y1 - by)
    }
}

/// A map in the making; parts of a rectangle that lie off the map are left out.
#[derive(Debug)]
pub(super) struct Sketch {
    frame: GridFrame,
    values: Vec<i8>,
}

/// A rectangle must reach this far into a cell, in cells, to count as touching it, so that
/// measures that are whole cells stay whole cells in spite of rounding.
const ALIGNMENT: f64 = 1e-6;

impl Sketch {
    /// A map whose cells all hold one value.
    pub(super) fn new(frame: GridFrame, value: i8) -> Self {
        let values = vec![value; frame.n_cells()];
        Self { frame, values }
    }

    /// Free ground of a built-in size, meters.
    pub(super) fn room([width, height]: [f64; 2], resolution_m: f64) -> Self {
        let n = |length: f64| (length / resolution_m).round() as usize;
        let frame = GridFrame::new(n(width), n(height), resolution_m, Pose2::default())
            .expect("built-in sizes are in range");
        Self::new(frame, FREE)
    }

    /// Solid ground of a built-in size, meters.
    pub(super) fn solid(size: [f64; 2], resolution_m: f64) -> Self {
        let mut sketch = Self::room(size, resolution_m);
        sketch.values.fill(OCCUPIED);
        sketch
    }

    /// Occupies every cell that a rectangle reaches into.
    pub(super) fn fill(&mut self, rect: Rect) {
        self.paint(rect, OCCUPIED);
    }

    /// Frees every cell that a rectangle reaches into.
    pub(super) fn clear(&mut self, rect: Rect) {
        self.paint(rect, FREE);
    }

    /// A wall along the map's border.
    pub(super) fn wall(&mut self, thickness_m: f64) {
        let size = self.frame.extent_m();
        self.fill(Rect::new(0.0, 0.0, size.x, thickness_m));
        self.fill(Rect::new(0.0, size.y - thickness_m, size.x, size.y));
        self.fill(Rect::new(0.0, 0.0, thickness_m, size.y));
        self.fill(Rect::new(size.x - thickness_m, 0.0, size.x, size.y));
    }

    /// True if a rectangle lies on the map and every cell that it reaches into holds `value`.
    pub(super) fn is_all(&self, rect: Rect, value: i8) -> bool {
        let size = self.frame.extent_m();
        let on_map = rect.x0 >= 0.0 && rect.y0 >= 0.0 && rect.x1 <= size.x && rect.y1 <= size.y;
        let (cols, mut rows) = self.cells(rect);
        on_map && rows.all(|row| self.row(row)[cols.clone()].iter().all(|&v| v == value))
    }

    /// The finished map.
    pub(super) fn finish(self) -> OccupancyGrid {
        OccupancyGrid::new(self.frame, self.values).expect("as many values as cells, all in range")
    }

    fn paint(&mut self, rect: Rect, value: i8) {
        let (cols, rows) = self.cells(rect);
        let n_cols = self.frame.n_cols();
        for row in rows {
            self.values[row * n_cols..][cols.clone()].fill(value);
        }
    }

    fn row(&self, row: usize) -> &[i8] {
        &self.values[row * self.frame.n_cols()..][..self.frame.n_cols()]
    }

    fn cells(&self, rect: Rect) -> (std::ops::Range<usize>, std::ops::Range<usize>) {
        let span = |low: f64, high: f64, n: usize| {
            let first = (low / self.frame.resolution_m() + ALIGNMENT).floor();
            let end = (high / self.frame.resolution_m() - ALIGNMENT).ceil();
            let end = (end.max(0.0) as usize).min(n);
            (first.max(0.0) as usize).min(end)..end
        };
        (
            span(rect.x0, rect.x1, self.frame.n_cols()),
            span(rect.y0, rect.y1, self.frame.n_rows()),
        )
    }
}

/// A frame at the origin.
pub(super) fn frame_at_origin(
    n_cols: usize,
    n_rows: usize,
    resolution_m: f64,
) -> Result<GridFrame, MapError> {
    GridFrame::new(n_cols, n_rows, resolution_m, Pose2::default())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_cells_stay_whole_and_parts_count() {
        let mut sketch = Sketch::room([1.0, 0.2], 0.1);
        sketch.fill(Rect::new(0.3, 0.0, 0.6, 0.1));
        sketch.fill(Rect::new(0.85, 0.15, 7.0, 7.0));
        assert!(sketch.is_all(Rect::new(0.3, 0.0, 0.6, 0.1), OCCUPIED));
        let map = sketch.finish();
        let expected = OccupancyGrid::from_rows(&["........##", "...###...."], 0.1).unwrap();
        assert_eq!(map.values(), expected.values());
    }
}
