//! Convex hulls of what moves: the ground that a body covers between two poses, conservatively.

use crate::geometry::Point2;

/// A convex region with a margin: every covered point is within `bulge_m` of the hull of the
/// corners.
#[derive(Clone, Debug)]
pub(super) struct Hull {
    corners: Vec<Point2>,
    /// A box around all of it, margin counted.
    pub(super) bounds: Bounds,
    bulge_m: f64,
}

/// An axis-aligned box.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    low: Point2,
    high: Point2,
}

impl Bounds {
    /// The box of points, grown by a margin.
    fn of(points: &[Point2], margin_m: f64) -> Self {
        let nothing = Self {
            low: Point2::new(f64::INFINITY, f64::INFINITY),
            high: Point2::new(f64::NEG_INFINITY, f64::NEG_INFINITY),
        };
        let margin = Point2::new(margin_m, margin_m);
        points.iter().fold(nothing, |all, &p| {
            all.union(&Self {
                low: p - margin,
                high: p + margin,
            })
        })
    }

    pub(super) fn union(&self, other: &Self) -> Self {
        let (a, b) = (self, other);
        Self {
            low: Point2::new(a.low.x.min(b.low.x), a.low.y.min(b.low.y)),
            high: Point2::new(a.high.x.max(b.high.x), a.high.y.max(b.high.y)),
        }
    }

    /// True if both come within a distance along each axis.
    pub(super) fn is_near(&self, other: &Self, distance_m: f64) -> bool {
        let near = |low: f64, high: f64, other_low: f64, other_high: f64| {
            low <= other_high + distance_m && other_low <= high + distance_m
        };
        let (a, b) = (self, other);
        near(a.low.x, a.high.x, b.low.x, b.high.x) && near(a.low.y, a.high.y, b.low.y, b.high.y)
    }
}

impl Hull {
    /// The hull of points, grown by a margin; Andrew's monotone chain.
    pub(super) fn new(mut points: Vec<Point2>, bulge_m: f64) -> Self {
        let bounds = Bounds::of(&points, bulge_m);
        points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        points.dedup();
        if points.len() > 2 {
            let mut corners = chain(points.iter().copied());
            corners.extend(chain(points.iter().rev().copied()));
            points = corners;
        }
        Self {
            corners: points,
            bounds,
            bulge_m,
        }
    }

    /// True if the two come within a distance, margins counted: at least then, since margins grow
    /// them.
    pub(super) fn is_within(&self, other: &Self, distance_m: f64) -> bool {
        let reach_m = distance_m + self.bulge_m + other.bulge_m;
        self.bounds.is_near(&other.bounds, distance_m) && self.distance_m(other) <= reach_m
    }

    /// Euclidean distance of the two hulls without margins; 0 where they overlap.
    fn distance_m(&self, other: &Self) -> f64 {
        let (a, b) = (&self.corners, &other.corners);
        if !is_separated(a, b) {
            return 0.0;
        }
        // Apart, a corner of one of them is in a nearest pair.
        let one = |points: &[Point2], ring: &[Point2]| {
            let pairs = points
                .iter()
                .flat_map(|&p| edges(ring).map(move |edge| squared_to_segment(p, edge)));
            pairs.fold(f64::INFINITY, f64::min)
        };
        one(a, b).min(one(b, a)).sqrt()
    }
}

/// Half of a hull, its last point left to the other half.
fn chain(points: impl Iterator<Item = Point2>) -> Vec<Point2> {
    let mut corners: Vec<Point2> = Vec::new();
    for point in points {
        while let [.., a, b] = corners[..]
            && (b - a).cross(point - b) <= 0.0
        {
            corners.pop();
        }
        corners.push(point);
    }
    corners.pop();
    corners
}

fn edges(ring: &[Point2]) -> impl Iterator<Item = (Point2, Point2)> + '_ {
    let n = ring.len();
    (0..n).map(move |i| (ring[i], ring[(i + 1) % n]))
}

/// True if a line along or across some edge separates two convex rings, which may be points or
/// segments.
fn is_separated(a: &[Point2], b: &[Point2]) -> bool {
    let range = |ring: &[Point2], axis: Point2| {
        ring.iter()
            .map(|p| p.dot(axis))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
                (low.min(x), high.max(x))
            })
    };
    let separates = |axis: Point2| {
        let ((a_low, a_high), (b_low, b_high)) = (range(a, axis), range(b, axis));
        a_high < b_low || b_high < a_low
    };
    if let ([p], [q]) = (a, b) {
        return p != q;
    }
    edges(a)
        .chain(edges(b))
        .map(|(from, to)| to - from)
        .any(|along| separates(along.perpendicular()) || separates(along))
}

fn squared_to_segment(p: Point2, (a, b): (Point2, Point2)) -> f64 {
    let (along, ray) = (b - a, p - a);
    let length2 = along.dot(along);
    let share = if length2 > 0.0 {
        (ray.dot(along) / length2).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let apart = ray - along * share;
    apart.dot(apart)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hull(points: &[[f64; 2]]) -> Hull {
        Hull::new(
            points.iter().map(|&[x, y]| Point2::new(x, y)).collect(),
            0.0,
        )
    }

    #[test]
    fn distances_of_polygons_segments_and_points() {
        let square = hull(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.5, 0.5]]);
        assert_eq!(square.corners.len(), 4);
        let distance = |points: &[[f64; 2]]| square.distance_m(&hull(points));
        assert_eq!(distance(&[[2.0, 0.5]]), 1.0);
        assert_eq!(distance(&[[4.0, 5.0]]), 5.0);
        assert_eq!(distance(&[[0.5, 0.5]]), 0.0);
        assert_eq!(distance(&[[-1.0, 3.0], [3.0, 3.0]]), 2.0);
        // A cross: no corner of one is in the other.
        assert_eq!(
            distance(&[[-1.0, 0.4], [2.0, 0.4], [2.0, 0.6], [-1.0, 0.6]]),
            0.0
        );
        let line = hull(&[[0.0, 0.0], [1.0, 0.0]]);
        assert_eq!(line.distance_m(&hull(&[[3.0, 0.0], [4.0, 0.0]])), 2.0);
        assert_eq!(line.distance_m(&hull(&[[0.5, -1.0], [0.5, 1.0]])), 0.0);
    }

    #[test]
    fn margins_count() {
        let a = Hull::new(vec![Point2::default()], 0.1);
        let b = Hull::new(vec![Point2::new(1.0, 0.0)], 0.2);
        assert!(a.is_within(&b, 0.71) && !a.is_within(&b, 0.69));
    }
}
