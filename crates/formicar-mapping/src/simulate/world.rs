//! Buildings of wall segments, and exact rays through them.

use formicar::Point2;

/// A straight piece of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// One end.
    pub a: Point2,
    /// The other end.
    pub b: Point2,
}

impl Segment {
    /// Distance of a point to the segment, meters.
    pub fn distance_m(&self, point: Point2) -> f64 {
        let d = self.b - self.a;
        let t = d.dot(point - self.a) / d.dot(d).max(f64::MIN_POSITIVE);
        point.distance(self.a.lerp(self.b, t.clamp(0.0, 1.0)))
    }

    /// The length of a ray, from a point along a unit vector, up to the segment.
    fn hit(&self, from: Point2, along: Point2) -> Option<f64> {
        let d = self.b - self.a;
        let det = along.cross(d);
        if det == 0.0 {
            return None;
        }
        let w = self.a - from;
        let (range, share) = (w.cross(d) / det, w.cross(along) / det);
        (range > 0.0 && (0.0..=1.0).contains(&share)).then_some(range)
    }
}

/// Segments with an index for rays.
#[derive(Clone, Debug)]
pub struct World {
    segments: Vec<Segment>,
    low: Point2,
    n_cols: i32,
    n_rows: i32,
    /// Segments whose box meets each cell of the index.
    cells: Vec<Vec<u32>>,
}

/// Side of a cell of the index, meters.
const CELL_M: f64 = 1.0;

impl World {
    /// A world of segments.
    pub fn new(segments: Vec<Segment>) -> Self {
        let ends = || segments.iter().flat_map(|s| [s.a, s.b]);
        let fold = |of: fn(Point2) -> f64| {
            let start = (f64::INFINITY, f64::NEG_INFINITY);
            ends().map(of).fold(start, |(l, h), v| (l.min(v), h.max(v)))
        };
        let ((x0, x1), (y0, y1)) = (fold(|p| p.x), fold(|p| p.y));
        let low = Point2::new(x0.floor(), y0.floor());
        let (n_cols, n_rows) = if segments.is_empty() {
            (0, 0)
        } else {
            (
                ((x1 - low.x) / CELL_M) as i32 + 1,
                ((y1 - low.y) / CELL_M) as i32 + 1,
            )
        };
        let mut cells = vec![Vec::new(); (n_cols * n_rows) as usize];
        for (i, s) in segments.iter().enumerate() {
            let range = |a: f64, b: f64, low: f64| {
                let index = |v: f64| ((v - low) / CELL_M).floor() as i32;
                index(a.min(b))..=index(a.max(b))
            };
            for row in range(s.a.y, s.b.y, low.y) {
                for col in range(s.a.x, s.b.x, low.x) {
                    cells[(row * n_cols + col) as usize].push(i as u32);
                }
            }
        }
        Self {
            segments,
            low,
            n_cols,
            n_rows,
            cells,
        }
    }

    /// The segments.
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// The exact range of a ray along a unit vector; none where nothing is hit within `max_m`.
    pub fn range_m(&self, from: Point2, along: Point2, max_m: f64) -> Option<f64> {
        if self.segments.is_empty() {
            return None;
        }
        let mut cell = (
            ((from.x - self.low.x) / CELL_M).floor() as i32,
            ((from.y - self.low.y) / CELL_M).floor() as i32,
        );
        let step = (
            if along.x >= 0.0 { 1 } else { -1 },
            if along.y >= 0.0 { 1 } else { -1 },
        );
        let next = |cell: i32, step: i32, low: f64, from: f64, along: f64| {
            let edge = low + f64::from(cell + i32::from(step > 0)) * CELL_M;
            if along == 0.0 {
                f64::INFINITY
            } else {
                (edge - from) / along
            }
        };
        let mut reach = (
            next(cell.0, step.0, self.low.x, from.x, along.x),
            next(cell.1, step.1, self.low.y, from.y, along.y),
        );
        let stride = (CELL_M / along.x.abs(), CELL_M / along.y.abs());
        let mut best = f64::INFINITY;
        let mut entered = 0.0;
        while entered <= max_m.min(best) {
            best = best.min(self.nearest_in(cell, from, along));
            if reach.0 < reach.1 {
                entered = reach.0;
                reach.0 += stride.0;
                cell.0 += step.0;
            } else {
                entered = reach.1;
                reach.1 += stride.1;
                cell.1 += step.1;
            }
        }
        (best <= max_m).then_some(best)
    }

    /// The shortest range to the segments of a cell of the index; infinite where there is none.
    fn nearest_in(&self, cell: (i32, i32), from: Point2, along: Point2) -> f64 {
        if !(0..self.n_cols).contains(&cell.0) || !(0..self.n_rows).contains(&cell.1) {
            return f64::INFINITY;
        }
        let segments = self.cells[(cell.1 * self.n_cols + cell.0) as usize].iter();
        let ranges = segments.filter_map(|&i| self.segments[i as usize].hit(from, along));
        ranges.fold(f64::INFINITY, f64::min)
    }

    /// Distance of a point to the nearest surface, meters; infinite in an empty world.
    pub fn distance_m(&self, point: Point2) -> f64 {
        let distances = self.segments.iter().map(|s| s.distance_m(point));
        distances.fold(f64::INFINITY, f64::min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn an_empty_world_has_nothing_to_hit() {
        let (from, along) = (Point2::new(1.0, 2.0), Point2::unit(0.3));
        assert_eq!(World::new(Vec::new()).range_m(from, along, 30.0), None);
    }

    proptest! {
        #[test]
        fn a_ray_ends_where_brute_force_says(
            ends in prop::collection::vec((-9.0..9.0_f64, -9.0..9.0_f64, -9.0..9.0_f64, -9.0..9.0_f64), 1..12),
            x in -12.0..12.0_f64, y in -12.0..12.0_f64, angle in -4.0..4.0_f64,
        ) {
            let segments: Vec<Segment> = ends
                .into_iter()
                .map(|(a, b, c, d)| Segment { a: Point2::new(a, b), b: Point2::new(c, d) })
                .collect();
            let world = World::new(segments.clone());
            let (from, along) = (Point2::new(x, y), Point2::unit(angle));
            let brute = segments.iter().filter_map(|s| s.hit(from, along)).fold(f64::INFINITY, f64::min);
            let found = world.range_m(from, along, 30.0);
            prop_assert_eq!(found, (brute <= 30.0).then_some(brute));
        }
    }
}
