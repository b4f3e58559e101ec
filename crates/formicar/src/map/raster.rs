//! Polygons to cells.

use super::GridFrame;
use crate::geometry::{Point2, Pose2};

/// Visits the index of every cell whose closed square a polygon (inside and boundary) touches.
///
/// Corners are world metres in order, convex or not (even-odd rule); parts off the map are left
/// out. Cost is proportional to the cells touched plus rows times edges.
pub(super) fn touched_cells(frame: &GridFrame, corners: &[Point2], mut visit: impl FnMut(usize)) {
    let scale = 1.0 / frame.resolution_m();
    let cells: Vec<Point2> = corners
        .iter()
        .map(|&p| frame.to_grid(Pose2::at(p, 0.0)).position() * scale)
        .collect();
    let _ = (&cells, &mut visit);
    unimplemented!("rasterised by the format work")
}
