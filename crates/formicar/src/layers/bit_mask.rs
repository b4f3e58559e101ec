//! The cells that convex polygons touch, as bits.

use crate::geometry::{ConvexPolygon, Point2};
use std::ops::RangeInclusive;

/// Contact within this counts, in cells: more than coordinates lose when they are turned.
pub(super) const ROUNDING: f64 = 1e-9;

/// Cells around the cell (0, 0), whose corner is the origin; rows of words, lowest columns first.
#[derive(Clone, Debug)]
pub(super) struct BitMask {
    /// The lower left cell.
    pub(super) low: (i32, i32),
    pub(super) n_cols: usize,
    pub(super) words_per_row: usize,
    pub(super) words: Vec<u64>,
}

impl BitMask {
    /// The cells whose squares, grown by `reach`, touch any of some polygons that are moved by
    /// `at`; all in cells.
    pub(super) fn of(polygons: &[ConvexPolygon], at: Point2, reach: f64) -> Self {
        let spans = RowSpans::of(polygons, at.y, reach);
        let cols = spans.cols(at.x);
        let n_cols = cols.clone().count();
        let mut words = Vec::new();
        spans.add_bits(at.x, &mut words);
        Self {
            low: (*cols.start(), spans.first_row),
            n_cols,
            words_per_row: n_cols.div_ceil(64),
            words,
        }
    }
}

/// The columns between which convex polygons lie in each row of cells: what masks at several
/// places along a row have in common. All in cells.
#[derive(Debug)]
pub(super) struct RowSpans {
    /// The lowest row.
    pub(super) first_row: i32,
    n_rows: usize,
    /// Lowest and highest x of all polygons.
    bounds: (f64, f64),
    reach: f64,
    /// Lowest and highest x row by row, polygon after polygon; the wrong way round where a polygon
    /// has no point.
    spans: Vec<(f64, f64)>,
}

impl RowSpans {
    /// The spans of polygons that are moved up by `y`, in rows grown by `reach` on both sides.
    pub(super) fn of(polygons: &[ConvexPolygon], y: f64, reach: f64) -> Self {
        let bounds = polygons.iter().map(ConvexPolygon::bounds);
        let (low, high) = bounds
            .reduce(|(a, b), (c, d)| {
                let low = Point2::new(a.x.min(c.x), a.y.min(c.y));
                (low, Point2::new(b.x.max(d.x), b.y.max(d.y)))
            })
            .expect("a sweep has pieces");
        let first_row = (low.y + y - reach).floor() as i32;
        let n_rows = ((high.y + y + reach).floor() as i32 - first_row + 1) as usize;
        let mut spans = vec![(f64::INFINITY, f64::NEG_INFINITY); polygons.len() * n_rows];
        let up = y - f64::from(first_row);
        for (polygon, rows) in polygons.iter().zip(spans.chunks_exact_mut(n_rows)) {
            widen(rows, polygon, up, reach);
        }
        Self {
            first_row,
            n_rows,
            bounds: (low.x, high.x),
            reach,
            spans,
        }
    }

    /// The columns of a mask for polygons that are moved along the rows by `x`.
    pub(super) fn cols(&self, x: f64) -> RangeInclusive<i32> {
        let first = (self.bounds.0 + x - self.reach).floor() as i32;
        first..=(self.bounds.1 + x + self.reach).floor() as i32
    }

    /// Appends the rows of this mask, as words.
    pub(super) fn add_bits(&self, x: f64, words: &mut Vec<u64>) {
        let cols = self.cols(x);
        let words_per_row = cols.clone().count().div_ceil(64);
        let begin = words.len();
        words.resize(begin + words_per_row * self.n_rows, 0);
        let right = x - f64::from(*cols.start());
        for rows in self.spans.chunks_exact(self.n_rows) {
            let words = words[begin..].chunks_exact_mut(words_per_row);
            for (words, &(low, high)) in words.zip(rows) {
                if low <= high {
                    // Columns count from the first one on: truncated is rounded down.
                    let col = |v: f64| v as u32 as usize;
                    let cols = col(low + right - self.reach)..=col(high + right + self.reach);
                    set_bits(words, cols);
                }
            }
        }
    }
}

/// Widens the span of each row by a polygon that is moved up by `up`. Its left sides go down, and
/// its right sides go up.
fn widen(rows: &mut [(f64, f64)], polygon: &ConvexPolygon, up: f64, reach: f64) {
    for (a, b) in polygon.edges() {
        let (is_left, low, high) = match a.y.total_cmp(&b.y) {
            std::cmp::Ordering::Less => (false, a, b),
            std::cmp::Ordering::Greater => (true, b, a),
            std::cmp::Ordering::Equal => continue,
        };
        let slope = (high.x - low.x) / (high.y - low.y);
        let (from_y, to_y) = (low.y + up, high.y + up);
        let first = (from_y - reach) as u32 as usize;
        let last = ((to_y + reach) as u32 as usize).min(rows.len() - 1);
        for (i, row) in rows.iter_mut().enumerate().take(last + 1).skip(first) {
            // The row, grown; and the side's ends within it.
            let (bottom, top) = (i as f64 - reach, i as f64 + 1.0 + reach);
            let from = if from_y < bottom {
                low.x + slope * (bottom - from_y)
            } else {
                low.x
            };
            let to = if to_y > top {
                low.x + slope * (top - from_y)
            } else {
                high.x
            };
            if is_left {
                row.0 = row.0.min(from.min(to));
            } else {
                row.1 = row.1.max(from.max(to));
            }
        }
    }
}

/// Sets a range of bits in a row of words.
fn set_bits(words: &mut [u64], cols: RangeInclusive<usize>) {
    let (first, last) = (*cols.start(), *cols.end());
    for (w, word) in words
        .iter_mut()
        .enumerate()
        .take(last / 64 + 1)
        .skip(first / 64)
    {
        let from = first.saturating_sub(w * 64).min(63);
        let to = (last - w * 64).min(63);
        *word |= u64::MAX >> (63 - (to - from)) << from;
    }
}
