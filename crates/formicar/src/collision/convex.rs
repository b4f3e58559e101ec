//! Distance between a convex polygon and a cell square.

use crate::geometry::Point2;

/// A closed axis-aligned square.
#[derive(Clone, Copy, Debug)]
pub(super) struct Square {
    pub(super) center: Point2,
    pub(super) half: f64,
}

impl Square {
    pub(super) fn corners(&self) -> [Point2; 4] {
        let Self { center: c, half: h } = *self;
        [(-h, -h), (h, -h), (h, h), (-h, h)].map(|(x, y)| Point2::new(c.x + x, c.y + y))
    }

    pub(super) fn squared_distance(&self, p: Point2) -> f64 {
        let dx = ((p.x - self.center.x).abs() - self.half).max(0.0);
        let dy = ((p.y - self.center.y).abs() - self.half).max(0.0);
        dx * dx + dy * dy
    }
}

/// The edges of a closed ring of corners.
pub(super) fn edges(corners: &[Point2]) -> impl Iterator<Item = (Point2, Point2)> + '_ {
    let n = corners.len();
    (0..n).map(move |i| (corners[i], corners[(i + 1) % n]))
}

/// Squared distance from a point to a segment, which may be a single point.
fn squared_point_segment(p: Point2, a: Point2, b: Point2) -> f64 {
    let (d, ray) = (b - a, p - a);
    let length2 = d.dot(d);
    let t = if length2 > 0.0 {
        (ray.dot(d) / length2).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let apart = ray - d * t;
    apart.dot(apart)
}

/// Distance from a point to a segment, which may be a single point.
pub(super) fn point_segment(p: Point2, a: Point2, b: Point2) -> f64 {
    squared_point_segment(p, a, b).sqrt()
}

/// Euclidean distance between a convex polygon (counter-clockwise) and a square; 0 when they
/// touch or overlap. Where they are apart, a corner of one of them is in a nearest pair.
pub(super) fn polygon_square(corners: &[Point2], square: &Square) -> f64 {
    if let Some(distance) = beside_edge(corners, square) {
        return distance;
    }
    if penetration(corners, square) >= 0.0 {
        return 0.0;
    }
    let own = corners.iter().fold(f64::INFINITY, |least, &p| {
        square.squared_distance(p).min(least)
    });
    let theirs = |least: f64, &q: &Point2| squared_point_boundary(q, corners).min(least);
    square.corners().iter().fold(own, theirs).sqrt()
}

/// Distance to a square of which a corner is nearest and lies beside an edge, as most do.
fn beside_edge(corners: &[Point2], square: &Square) -> Option<f64> {
    let Square { center, half } = *square;
    edges(corners).find_map(|(a, b)| {
        let d = b - a;
        let outward = Point2::new(d.y, -d.x);
        let toward = Point2::new(half.copysign(outward.x), half.copysign(outward.y));
        let ray = center - toward - a;
        let (off, along) = (ray.dot(outward), ray.dot(d));
        let is_beside = off > 0.0 && along >= 0.0 && along <= d.dot(d);
        is_beside.then(|| off / d.norm())
    })
}

/// Distance from a point outside to the boundary of a polygon.
pub(super) fn point_boundary(p: Point2, corners: &[Point2]) -> f64 {
    squared_point_boundary(p, corners).sqrt()
}

fn squared_point_boundary(p: Point2, corners: &[Point2]) -> f64 {
    edges(corners).fold(f64::INFINITY, |least, (a, b)| {
        squared_point_segment(p, a, b).min(least)
    })
}

/// Depth of the overlap by separating axes: the distance to move one of them free; negative where
/// an axis separates the two, 0 where they touch.
pub(super) fn penetration(corners: &[Point2], square: &Square) -> f64 {
    let Square { center: c, half } = *square;
    let mut low = corners[0];
    let mut high = corners[0];
    for p in corners {
        low = Point2::new(low.x.min(p.x), low.y.min(p.y));
        high = Point2::new(high.x.max(p.x), high.y.max(p.y));
    }
    let across = (high.x - c.x)
        .min(c.x - low.x)
        .min(high.y - c.y)
        .min(c.y - low.y)
        + half;
    edges(corners).fold(across, |depth, (a, b)| {
        let d = b - a;
        let length = d.norm();
        if length == 0.0 {
            return depth;
        }
        let inside = d.cross(c - a) + half * (d.x.abs() + d.y.abs());
        depth.min(inside / length)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{ConvexPolygon, Pose2};
    use proptest::prelude::*;

    const UNIT: Square = Square {
        center: Point2::new(0.0, 0.0),
        half: 0.5,
    };

    #[test]
    fn corner_edge_and_overlap() {
        let body = ConvexPolygon::rectangle(Point2::new(-1.0, -0.5), Point2::new(1.0, 0.5));
        let at = |x, y, h| polygon_square(body.placed(Pose2::new(x, y, h)).corners(), &UNIT);
        assert!((at(3.0, 0.2, 0.0) - 1.5).abs() < 1e-12);
        assert!((at(4.5, 5.0, 0.0) - 5.0).abs() < 1e-12);
        assert_eq!(at(1.0, 0.3, 0.7), 0.0);
        let diagonal = at(3.0, 0.0, std::f64::consts::FRAC_PI_4);
        assert!(
            (diagonal - (2.5 - 1.5 * 0.5_f64.sqrt())).abs() < 1e-12,
            "{diagonal}"
        );
    }

    #[test]
    fn a_point_is_a_polygon_of_one_corner() {
        assert_eq!(polygon_square(&[Point2::new(0.2, 0.2)], &UNIT), 0.0);
        assert!((polygon_square(&[Point2::new(1.5, 0.2)], &UNIT) - 1.0).abs() < 1e-12);
        assert!((polygon_square(&[Point2::new(3.5, 4.5)], &UNIT) - 5.0).abs() < 1e-12);
    }

    proptest! {
        #[test]
        fn equals_the_least_distance_of_dense_samples(x in -3.0..3.0, y in -3.0..3.0, h in 0.0..7.0) {
            let body = ConvexPolygon::rectangle(Point2::new(-0.4, -0.5), Point2::new(1.3, 0.5));
            let placed = body.placed(Pose2::new(x, y, h));
            let exact = polygon_square(placed.corners(), &UNIT);
            let sampled = placed
                .edges()
                .flat_map(|(a, b)| (0..=200).map(move |i| a.lerp(b, f64::from(i) / 200.0)))
                .map(|p| UNIT.squared_distance(p).sqrt())
                .fold(f64::INFINITY, f64::min);
            let inside = placed.contains(Point2::default());
            let sampled = if inside { 0.0 } else { sampled };
            prop_assert!(exact <= sampled + 1e-12 && sampled - exact < 0.01, "{exact} {sampled}");
        }
    }
}
