//! Polygons to cells.

use super::GridFrame;
use crate::geometry::{Point2, Pose2};

/// Corners farther out than this many cells cost digits near the map.
const FAR_CELLS: f64 = (1 << 20) as f64;

/// Visits the index of every cell whose closed square a polygon (inside and boundary) touches,
/// each once.
///
/// Corners are world meters in order, convex or not (even-odd rule); parts off the map are left
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

/// The intersection of the polygon with the band `row <= y <= row + 1`, as intervals of x that may
/// overlap.
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

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const COLS: usize = 9;
    const ROWS: usize = 7;
    /// Corners are drawn on a lattice of this many points per cell.
    const PER_CELL: i128 = 4;

    fn touched(corners: &[(i64, i64)]) -> Vec<bool> {
        let frame = GridFrame::new(COLS, ROWS, 1.0, Pose2::default()).unwrap();
        let scaled = |v: i64| v as f64 / PER_CELL as f64;
        let corners: Vec<Point2> = corners
            .iter()
            .map(|&(x, y)| Point2::new(scaled(x), scaled(y)))
            .collect();
        let mut cells = vec![false; frame.n_cells()];
        touched_cells(&frame, &corners, |i| {
            assert!(!cells[i], "cell {i} visited twice");
            cells[i] = true;
        });
        cells
    }

    /// By whole numbers: an edge meets the closed square, or the square's center is inside.
    fn brute_force(corners: &[(i64, i64)]) -> Vec<bool> {
        let corners: Vec<(i128, i128)> = corners
            .iter()
            .map(|&(x, y)| (i128::from(x), i128::from(y)))
            .collect();
        let n = corners.len();
        let edges: Vec<_> = (0..n).map(|i| (corners[i], corners[(i + 1) % n])).collect();
        let cell = |i: usize| {
            let x = (i % COLS) as i128 * PER_CELL;
            let y = (i / COLS) as i128 * PER_CELL;
            edges.iter().any(|&(a, b)| edge_meets_square(a, b, (x, y)))
                || is_inside(&edges, (x + PER_CELL / 2, y + PER_CELL / 2))
        };
        (0..COLS * ROWS).map(cell).collect()
    }

    type Lattice = (i128, i128);

    fn edge_meets_square(a: Lattice, b: Lattice, low: Lattice) -> bool {
        let high = (low.0 + PER_CELL, low.1 + PER_CELL);
        let apart = a.0.max(b.0) < low.0
            || a.0.min(b.0) > high.0
            || a.1.max(b.1) < low.1
            || a.1.min(b.1) > high.1;
        let side = |x: i128, y: i128| ((b.0 - a.0) * (y - a.1) - (b.1 - a.1) * (x - a.0)).signum();
        let sides = [
            side(low.0, low.1),
            side(high.0, low.1),
            side(low.0, high.1),
            side(high.0, high.1),
        ];
        !(apart || sides == [1; 4] || sides == [-1; 4])
    }

    fn is_inside(edges: &[(Lattice, Lattice)], p: Lattice) -> bool {
        let crossed = edges.iter().filter(|(a, b)| {
            let (low, high) = if a.1 < b.1 { (a, b) } else { (b, a) };
            let side = (high.0 - low.0) * (p.1 - low.1) - (high.1 - low.1) * (p.0 - low.0);
            low.1 <= p.1 && p.1 < high.1 && side > 0
        });
        crossed.count() % 2 == 1
    }

    fn corners(reach: i64, n: std::ops::Range<usize>) -> impl Strategy<Value = Vec<(i64, i64)>> {
        prop::collection::vec((-reach..reach, -reach..reach), n)
    }

    proptest! {
        #[test]
        fn equals_brute_force(corners in corners(48, 1..9)) {
            prop_assert_eq!(touched(&corners), brute_force(&corners));
        }

        #[test]
        fn far_corners_miss_no_cell(corners in corners(1 << 40, 1..6), near in corners(48, 0..3)) {
            let all: Vec<_> = corners.into_iter().chain(near).collect();
            let (cells, truth) = (touched(&all), brute_force(&all));
            prop_assert!(cells.iter().zip(&truth).all(|(&cell, &true_cell)| cell || !true_cell));
        }

        #[test]
        fn any_number_is_survived(corners in prop::collection::vec(any::<(f64, f64)>(), 0..6)) {
            let frame = GridFrame::new(5, 4, 0.3, Pose2::new(1.0, -2.0, 0.7)).unwrap();
            let corners: Vec<Point2> = corners.iter().map(|&(x, y)| Point2::new(x, y)).collect();
            touched_cells(&frame, &corners, |i| assert!(i < 20));
        }
    }

    #[test]
    fn a_polygon_around_the_map_covers_it() {
        let far = 1_i64 << 50;
        assert!(
            touched(&[(-far, -far), (far, -far), (far, far), (-far, far)])
                .iter()
                .all(|&c| c)
        );
    }
}
