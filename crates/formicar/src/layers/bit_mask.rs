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
        let bounds = polygons.iter().map(ConvexPolygon::bounds);
        let (low, high) = bounds
            .reduce(|(a, b), (c, d)| {
                let low = Point2::new(a.x.min(c.x), a.y.min(c.y));
                (low, Point2::new(b.x.max(d.x), b.y.max(d.y)))
            })
            .expect("a sweep has pieces");
        let first = |v: f64| (v - reach).floor() as i32;
        let last = |v: f64| (v + reach).floor() as i32;
        let corner = (first(low.x + at.x), first(low.y + at.y));
        let n_cols = (last(high.x + at.x) - corner.0 + 1) as usize;
        let n_rows = (last(high.y + at.y) - corner.1 + 1) as usize;
        let words_per_row = n_cols.div_ceil(64);
        let mut words = vec![0; words_per_row * n_rows];
        let shift = at - Point2::new(f64::from(corner.0), f64::from(corner.1));
        for polygon in polygons {
            let rows = rows_touched(polygon, shift, reach, n_rows);
            for (words, (low, high)) in words.chunks_mut(words_per_row).zip(rows) {
                if low <= high {
                    let cols = (low - reach).floor() as usize..=(high + reach).floor() as usize;
                    set_bits(words, cols);
                }
            }
        }
        Self {
            low: corner,
            n_cols,
            words_per_row,
            words,
        }
    }
}

/// For each row of cells, grown by `reach`, the columns between which a shifted polygon lies.
fn rows_touched(
    polygon: &ConvexPolygon,
    shift: Point2,
    reach: f64,
    n_rows: usize,
) -> Vec<(f64, f64)> {
    let mut rows = vec![(f64::INFINITY, f64::NEG_INFINITY); n_rows];
    for (a, b) in polygon.edges() {
        let (a, b) = if a.y <= b.y { (a, b) } else { (b, a) };
        let (a, b) = (a + shift, b + shift);
        let slope = if b.y > a.y {
            (b.x - a.x) / (b.y - a.y)
        } else {
            0.0
        };
        let first = (a.y - reach).floor().max(0.0) as usize;
        let last = ((b.y + reach).floor() as usize).min(n_rows - 1);
        for (i, row) in rows.iter_mut().enumerate().take(last + 1).skip(first) {
            let band = (i as f64 - reach, i as f64 + 1.0 + reach);
            let at = |y: f64| a.x + slope * (y - a.y);
            let (from, to) = (
                if a.y < band.0 { at(band.0) } else { a.x },
                if b.y > band.1 { at(band.1) } else { b.x },
            );
            *row = (row.0.min(from.min(to)), row.1.max(from.max(to)));
        }
    }
    rows
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
