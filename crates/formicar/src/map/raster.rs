//! Polygons to cells.

use super::GridFrame;
use crate::geometry::{Point2, Pose2};

/// Corners farther out than this many cells cost digits near the map.
const FAR_CELLS: f64 = (1 << 20) as f64;

/// Visits the index of every cell whose closed square a polygon (inside and boundary) touches,
/// each once.
///
/// Corners are world metres in order, convex or not (even-odd rule); parts off the map are left
/// out. Fewer than three corners are a point or a line. A corner that is not finite makes the
/// polygon cover the whole map, so that no obstacle is lost. Cost is proportional to the cells
/// touched plus rows times edges.
///
/// Exact for corners given in cells with few digits; otherwise to rounding of the corners.
/// Edges with a corner more than 2^20 cells away are widened by their rounding error, so that
/// they never miss a cell.
pub(super) fn touched_cells(frame: &GridFrame, corners: &[Point2], mut visit: impl FnMut(usize)) {
    let scale = 1.0 / frame.resolution_m();
    let cells: Vec<Point2> = corners
        .iter()
        .map(|&p| frame.to_grid(Pose2::at(p, 0.0)).position() * scale)
        .collect();
    if !cells.iter().all(|p| p.is_finite()) {
        (0..frame.n_cells()).for_each(visit);
        return;
    }
    let low = cells.iter().map(|p| p.y).fold(f64::INFINITY, f64::min);
    let high = cells.iter().map(|p| p.y).fold(f64::NEG_INFINITY, f64::max);
    let mut spans = Vec::new();
    for row in closed_range(low, high, frame.n_rows()) {
        collect_spans(&cells, row as f64, &mut spans);
        spans.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut next = 0;
        for &(left, right) in &spans {
            let cols = closed_range(left, right, frame.n_cols());
            let end = cols.end;
            (cols.start.max(next)..end).for_each(|col| visit(row * frame.n_cols() + col));
            next = next.max(end);
        }
    }
}

/// The unit intervals `[i, i + 1]`, `i < n`, that meet `[low, high]`.
fn closed_range(low: f64, high: f64, n: usize) -> std::ops::Range<usize> {
    let first = (low.ceil() - 1.0).max(0.0) as usize;
    let end = (high.floor() + 1.0).clamp(0.0, n as f64) as usize;
    first..end
}

/// Where the polygon meets the band `row <= y <= row + 1`, as intervals of x that may overlap.
///
/// A cell that no edge touches lies inside or outside as a whole, so that the middle line of the
/// band decides.
fn collect_spans(corners: &[Point2], row: f64, spans: &mut Vec<(f64, f64)>) {
    spans.clear();
    let middle = row + 0.5;
    let mut crossings = Vec::new();
    for (i, &a) in corners.iter().enumerate() {
        let b = corners[(i + 1) % corners.len()];
        let (low, high) = if a.y <= b.y { (a, b) } else { (b, a) };
        if high.y < row || low.y > row + 1.0 {
            continue;
        }
        spans.push(edge_span(low, high, row));
        if (low.y > middle) != (high.y > middle) {
            crossings.push(x_at(low, high, middle));
        }
    }
    crossings.sort_by(f64::total_cmp);
    spans.extend(crossings.chunks_exact(2).map(|pair| (pair[0], pair[1])));
}

/// The x interval of the edge's part in the band.
fn edge_span(low: Point2, high: Point2, row: f64) -> (f64, f64) {
    let enter = if low.y >= row {
        low.x
    } else {
        x_at(low, high, row)
    };
    let leave = if high.y <= row + 1.0 {
        high.x
    } else {
        x_at(low, high, row + 1.0)
    };
    let far = [low.x, low.y, high.x, high.y]
        .iter()
        .fold(0.0, |far: f64, c| far.max(c.abs()));
    let slack = if far > FAR_CELLS {
        8.0 * f64::EPSILON * low.x.abs().max(high.x.abs())
    } else {
        0.0
    };
    (enter.min(leave) - slack, enter.max(leave) + slack)
}

/// The x of an edge at a height between its ends. Multiplying before dividing keeps lattice
/// points on the edge exact.
fn x_at(low: Point2, high: Point2, y: f64) -> f64 {
    let x = low.x + (y - low.y) * (high.x - low.x) / (high.y - low.y);
    let x = if x.is_finite() {
        x
    } else {
        // A difference or product overflowed.
        let t = (0.5 * y - 0.5 * low.y) / (0.5 * high.y - 0.5 * low.y);
        low.x * (1.0 - t) + high.x * t
    };
    x.clamp(low.x.min(high.x), low.x.max(high.x))
}
