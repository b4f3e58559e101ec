//! Moves on grown obstacles, worked out anew where obstacles have changed.

use super::{CellRegion, DistanceField, MoveMasks};

/// Works out anew which cells obstacles block that are grown by a radius, about a rectangle in
/// which they have changed, and the moves there. A cell of the moves stands for `stride` times
/// `stride` cells of the distance field, and is blocked where the one in their middle is.
pub(crate) fn regrow(
    moves: &mut MoveMasks,
    distance: &DistanceField,
    changed: &CellRegion,
    (radius_cells, stride): (f64, usize),
) {
    let (n_cols, n_rows) = (distance.n_cols(), distance.n_rows());
    let near = changed.grown(radius_cells.ceil() as usize, n_cols, n_rows);
    // At distance 0 are the obstacles themselves.
    let limit = distance.square_within(radius_cells).unwrap_or(0);
    let [cols, rows] =
        [near.cols(), near.rows()].map(|range| range.start / stride..range.end.div_ceil(stride));
    moves.change(cols.clone(), rows.clone(), |blocked| {
        for cell in CellRegion::of_ranges(&cols, &rows).cells() {
            let col = middle_cell(cell.col as usize, stride, n_cols);
            let row = middle_cell(cell.row as usize, stride, n_rows);
            if distance.squared(col, row) <= limit {
                blocked.insert(cell);
            } else {
                blocked.remove(cell);
            }
        }
    });
}

/// The column or row in the middle of a block of `stride`, on a grid of `n`.
pub(crate) fn middle_cell(block: usize, stride: usize, n: usize) -> usize {
    (block * stride + stride / 2).min(n - 1)
}
