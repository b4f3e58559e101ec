//! Ground that another map closes.

use super::raster::touched_cells;
use super::{GridFrame, OCCUPIED, OccupancyGrid};
use crate::geometry::{Point2, Pose2};

/// Squares that overlap by less than this share of a cell count as neighbors: corners are rounded.
const OVERLAP_CELLS: f64 = 1e-6;

impl OccupancyGrid {
    /// Occupies every cell on which an occupied cell of `mask` lies, and returns the number of
    /// cells that the mask covers.
    ///
    /// Both maps lie in one world frame; their origins, yaws, sizes and resolutions may differ.
    /// Graded and unknown cells of the mask close nothing. A cell counts as covered where the
    /// squares share ground, by more than a millionth of a cell; so a mask of this map's frame
    /// closes its own cells only. Cost is proportional to the cells of the mask and those covered.
    ///
    /// ```
    /// use formicar::{OccupancyGrid, Pose2};
    /// use formicar::map::{Cell, GridFrame};
    ///
    /// let mut map = OccupancyGrid::from_rows(&["....", "...."], 1.0)?;
    /// let mut mask = OccupancyGrid::free(GridFrame::new(3, 3, 0.25, Pose2::new(0.875, 0.5, 0.0))?);
    /// mask.set(Cell::new(0, 0), 100);
    /// // Its only occupied cell lies on two cells of the map.
    /// assert_eq!(map.close_under(&mask), 2);
    /// assert!(map.is_lethal(Cell::new(0, 0)) && map.is_lethal(Cell::new(1, 0)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn close_under(&mut self, mask: &OccupancyGrid) -> usize {
        let frame = *self.frame();
        let mut covered = vec![false; frame.n_cells()];
        let is_closed = |value: i8| value == OCCUPIED;
        for (row, values) in mask.values().chunks(mask.frame().n_cols()).enumerate() {
            let mut col = 0;
            for run in values.chunk_by(|&a, &b| is_closed(a) == is_closed(b)) {
                let cols = col..col + run.len();
                col = cols.end;
                if is_closed(run[0]) {
                    let corners = corners(mask.frame(), row, cols, frame.resolution_m());
                    touched_cells(&frame, &corners, |i| covered[i] = true);
                }
            }
        }
        let cells = (0..covered.len()).filter(|&i| covered[i]);
        cells.map(|i| self.set(frame.cell(i), OCCUPIED)).count()
    }
}

/// The corners of a run of cells, in the world, drawn in by the overlap that does not count.
fn corners(
    frame: &GridFrame,
    row: usize,
    cols: std::ops::Range<usize>,
    other_resolution_m: f64,
) -> [Point2; 4] {
    let resolution_m = frame.resolution_m();
    let inward_m = OVERLAP_CELLS * resolution_m.min(other_resolution_m);
    let [left, right] = [cols.start, cols.end].map(|col| col as f64 * resolution_m);
    let [low, high] = [row, row + 1].map(|row| row as f64 * resolution_m);
    let (left, right) = (left + inward_m, right - inward_m);
    let (low, high) = (low + inward_m, high - inward_m);
    [(left, low), (right, low), (right, high), (left, high)]
        .map(|(x, y)| frame.to_world(Pose2::new(x, y, 0.0)).position())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::Cell;
    use proptest::prelude::*;

    fn frame(n: [usize; 2], resolution_m: f64, origin: Pose2) -> GridFrame {
        GridFrame::new(n[0], n[1], resolution_m, origin).unwrap()
    }

    /// The squares of two cells are apart along an axis of either.
    fn overlap_m(a: (&GridFrame, Cell), b: (&GridFrame, Cell)) -> f64 {
        let corners = |(frame, cell): (&GridFrame, Cell)| {
            let side = frame.resolution_m();
            let (x, y) = (f64::from(cell.col) * side, f64::from(cell.row) * side);
            [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)]
                .map(|(dx, dy)| frame.to_world(Pose2::new(x + dx, y + dy, 0.0)).position())
        };
        let (p, q) = (corners(a), corners(b));
        let axes = [a.0, b.0].map(|frame| frame.origin().heading);
        let axes = axes
            .iter()
            .flat_map(|yaw| [yaw.sin_cos(), (-yaw).sin_cos()]);
        let mut least = f64::INFINITY;
        for (i, (sin, cos)) in axes.enumerate() {
            let (x, y) = if i % 2 == 0 { (cos, sin) } else { (sin, cos) };
            let span = |points: &[Point2; 4]| {
                let along = points.map(|p| p.x * x + p.y * y);
                let low = along.iter().copied().fold(f64::INFINITY, f64::min);
                let high = along.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                [low, high]
            };
            let (p, q) = (span(&p), span(&q));
            least = least.min(p[1].min(q[1]) - p[0].max(q[0]));
        }
        least
    }

    proptest! {
        #[test]
        fn closes_what_brute_force_closes(
            occupied in prop::collection::vec(any::<bool>(), 30),
            sides in (0.05..2.0_f64, 0.05..2.0_f64),
            at in (-3.0..3.0_f64, -3.0..3.0_f64, -4.0..4.0_f64),
            yaw in -4.0..4.0_f64,
        ) {
            let own = frame([9, 7], sides.0, Pose2::new(-1.0, 0.5, yaw));
            let foreign = frame([6, 5], sides.1, Pose2::new(at.0, at.1, at.2));
            let values = occupied.iter().map(|&is| if is { OCCUPIED } else { -1 });
            let mask = OccupancyGrid::new(foreign, values.collect()).unwrap();
            let mut map = OccupancyGrid::free(own);
            let n = map.close_under(&mask);
            prop_assert_eq!(map.values().iter().filter(|value| **value == OCCUPIED).count(), n);
            for i in 0..own.n_cells() {
                let cell = own.cell(i);
                let closed = (0..foreign.n_cells()).filter(|&j| occupied[j]);
                let deepest = closed
                    .map(|j| overlap_m((&own, cell), (&foreign, foreign.cell(j))))
                    .fold(f64::NEG_INFINITY, f64::max);
                // Between the two, the tolerance decides.
                if !(-1e-9..=1e-5).contains(&deepest) {
                    prop_assert_eq!(map.is_lethal(cell), deepest > 0.0, "{:?} {}", cell, deepest);
                }
            }
        }
    }

    #[test]
    fn a_mask_of_the_same_frame_closes_its_own_cells_only() {
        for (resolution_m, yaw) in [(0.05, 0.0), (0.1, 0.7), (1.0 / 3.0, -2.5)] {
            let same = frame([40, 30], resolution_m, Pose2::new(-12.3, 45.6, yaw));
            let mut mask = OccupancyGrid::free(same);
            for i in (0..same.n_cells()).step_by(3) {
                mask.set(same.cell(i), OCCUPIED);
            }
            let mut map = OccupancyGrid::free(same);
            map.close_under(&mask);
            assert_eq!(map, mask);
        }
    }

    #[test]
    fn a_mask_beside_the_map_closes_nothing() {
        let mut map = OccupancyGrid::from_rows(&["...", "..."], 1.0).unwrap();
        let mut mask = OccupancyGrid::free(frame([2, 2], 1.0, Pose2::new(3.0, 0.0, 0.0)));
        mask.fill_polygon(&[Point2::new(3.5, 0.5), Point2::new(4.5, 1.5)], OCCUPIED);
        assert_eq!(map.close_under(&mask), 0);
    }
}
