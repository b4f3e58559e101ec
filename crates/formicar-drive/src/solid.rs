//! Convex bodies in the plane: gaps between them, and rays that end on them.

use formicar::geometry::ConvexPolygon;
use formicar::scenario::ObstacleShape;
use formicar::{Point2, Pose2};

/// A convex polygon or a disc at a place.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    /// Corners, counter-clockwise; of a disc, its center.
    corners: Vec<Point2>,
    radius_m: f64,
    center: Point2,
    reach_m: f64,
}

/// The nearest points of two solids.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearness {
    /// The distance, meters; 0 where they touch or overlap.
    pub gap_m: f64,
    /// The nearest point of the first.
    pub from: Point2,
    /// The nearest point of the second.
    pub to: Point2,
    /// The unit vector from the first to the second; of bodies that overlap, between their middles.
    pub along: Point2,
}

impl Solid {
    /// A shape, which has been checked, at a pose.
    pub fn placed(shape: &ObstacleShape, pose: Pose2) -> Self {
        match shape {
            ObstacleShape::Disc { radius_m } => Self::of(vec![pose.position()], *radius_m),
            ObstacleShape::Polygon(corners) => {
                let corners = corners
                    .iter()
                    .map(|&[x, y]| pose.transform(Point2::new(x, y)));
                let corners: Vec<_> = corners.collect();
                let ordered = ConvexPolygon::new(&corners).map(|p| p.corners().to_vec());
                Self::of(ordered.unwrap_or(corners), 0.0)
            }
        }
    }

    /// A convex part of a vehicle at a pose.
    pub fn part(part: &ConvexPolygon, pose: Pose2) -> Self {
        Self::of(part.placed(pose).corners().to_vec(), 0.0)
    }

    fn of(corners: Vec<Point2>, radius_m: f64) -> Self {
        let n = corners.len().max(1) as f64;
        let sum = corners.iter().fold(Point2::default(), |sum, &p| sum + p);
        let center = sum * (1.0 / n);
        let reach_m = corners.iter().map(|p| p.distance(center));
        Self {
            reach_m: reach_m.fold(0.0, f64::max) + radius_m,
            corners,
            radius_m,
            center,
        }
    }

    /// Its corners; of a disc, its center.
    pub fn corners(&self) -> &[Point2] {
        &self.corners
    }

    /// The radius of a disc, meters; 0 of a polygon.
    pub fn radius_m(&self) -> f64 {
        self.radius_m
    }

    /// The mean of its corners.
    pub fn center(&self) -> Point2 {
        self.center
    }

    /// Distance of its farthest point from the center, meters.
    pub fn reach_m(&self) -> f64 {
        self.reach_m
    }

    /// A lower bound of the gap to another, meters; may be negative.
    pub fn gap_bound_m(&self, other: &Self) -> f64 {
        self.center.distance(other.center) - self.reach_m - other.reach_m
    }

    /// The nearest points of this and another.
    pub fn nearness(&self, other: &Self) -> Nearness {
        let mut best = Nearness {
            gap_m: f64::INFINITY,
            from: self.center,
            to: other.center,
            along: Point2::default(),
        };
        for &corner in &self.corners {
            best = nearer(best, corner, other.nearest_to(corner));
        }
        for &corner in &other.corners {
            best = nearer(best, self.nearest_to(corner), corner);
        }
        if self.overlaps(other) {
            best.gap_m = 0.0;
        }
        let apart = best.gap_m > 0.0 && best.from != best.to;
        let way = if apart {
            best.to - best.from
        } else {
            other.center - self.center
        };
        let along = way * (1.0 / way.norm().max(f64::MIN_POSITIVE));
        Nearness {
            gap_m: (best.gap_m - self.radius_m - other.radius_m).max(0.0),
            from: best.from + along * self.radius_m,
            to: best.to - along * other.radius_m,
            along,
        }
    }

    /// The point of the outline without its radius that is nearest to a point; the point itself
    /// where it lies inside.
    fn nearest_to(&self, point: Point2) -> Point2 {
        if self.corners.len() > 2 && self.holds(point) {
            return point;
        }
        let feet = self.edges().map(|(a, b)| {
            let d = b - a;
            let t = d.dot(point - a) / d.dot(d).max(f64::MIN_POSITIVE);
            a.lerp(b, t.clamp(0.0, 1.0))
        });
        let feet = feet.min_by(|a, b| a.distance(point).total_cmp(&b.distance(point)));
        feet.unwrap_or(self.center)
    }

    fn holds(&self, point: Point2) -> bool {
        self.edges().all(|(a, b)| (b - a).cross(point - a) >= 0.0)
    }

    /// The edges; of a disc one without length.
    fn edges(&self) -> impl Iterator<Item = (Point2, Point2)> + '_ {
        let next = self.corners.iter().cycle().skip(1);
        self.corners.iter().copied().zip(next.copied())
    }

    /// True where polygons overlap: no edge of either parts them.
    fn overlaps(&self, other: &Self) -> bool {
        let parts = |a: &Self, b: &Self| {
            a.edges().any(|(p, q)| {
                let outside = |&c: &Point2| (q - p).cross(c - p) < 0.0;
                b.corners.iter().all(outside)
            })
        };
        let both = self.corners.len() > 2 && other.corners.len() > 2;
        both && !parts(self, other) && !parts(other, self)
    }

    /// The length of a ray, from a point along a unit vector, up to the outline.
    pub fn range_m(&self, from: Point2, along: Point2) -> Option<f64> {
        if let [center] = self.corners[..] {
            return disc_range_m(from, along, center, self.radius_m);
        }
        let hits = self.edges().filter_map(|(a, b)| hit_m(from, along, a, b));
        hits.min_by(f64::total_cmp)
    }
}

fn nearer(best: Nearness, from: Point2, to: Point2) -> Nearness {
    let gap_m = from.distance(to);
    if gap_m < best.gap_m {
        Nearness {
            gap_m,
            from,
            to,
            ..best
        }
    } else {
        best
    }
}

fn hit_m(from: Point2, along: Point2, a: Point2, b: Point2) -> Option<f64> {
    let d = b - a;
    let det = along.cross(d);
    if det == 0.0 {
        return None;
    }
    let w = a - from;
    let (range_m, share) = (w.cross(d) / det, w.cross(along) / det);
    (range_m > 0.0 && (0.0..=1.0).contains(&share)).then_some(range_m)
}

fn disc_range_m(from: Point2, along: Point2, center: Point2, radius_m: f64) -> Option<f64> {
    let d = center - from;
    let (ahead, aside) = (along.dot(d), along.cross(d));
    let depth = radius_m * radius_m - aside * aside;
    let is_outside = d.norm() > radius_m;
    (depth >= 0.0 && ahead > 0.0 && is_outside).then(|| ahead - depth.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn shape() -> impl Strategy<Value = ObstacleShape> {
        prop_oneof![
            (0.05..0.8).prop_map(|radius_m| ObstacleShape::Disc { radius_m }),
            (0.1..1.0, 0.1..1.0).prop_map(|(w, h): (f64, f64)| {
                ObstacleShape::Polygon(vec![[-w, -h], [w, -h], [w, h], [-w, h]])
            }),
        ]
    }

    fn pose() -> impl Strategy<Value = Pose2> {
        (-2.0..2.0, -2.0..2.0, -3.0..3.0).prop_map(|(x, y, heading)| Pose2::new(x, y, heading))
    }

    /// Points on an outline.
    fn outline(solid: &Solid) -> Vec<Point2> {
        if let [center] = solid.corners[..] {
            let around = (0..720).map(|i| Point2::unit(f64::from(i).to_radians() / 2.0));
            return around.map(|u| center + u * solid.radius_m).collect();
        }
        let along =
            |(a, b): (Point2, Point2)| (0..200).map(move |i| a.lerp(b, f64::from(i) / 200.0));
        solid.edges().flat_map(along).collect()
    }

    proptest! {
        #[test]
        fn gaps_are_those_of_dense_outlines(a in shape(), b in shape(), at in pose(), bt in pose()) {
            let (a, b) = (Solid::placed(&a, at), Solid::placed(&b, bt));
            let near = a.nearness(&b);
            let dense = outline(&a).into_iter().flat_map(|p| {
                outline(&b).into_iter().map(move |q| p.distance(q))
            });
            let dense = dense.fold(f64::INFINITY, f64::min);
            prop_assert!(near.gap_m <= dense + 1e-9, "{} {}", near.gap_m, dense);
            if near.gap_m > 0.0 {
                prop_assert!(dense - near.gap_m < 0.02, "{} {}", near.gap_m, dense);
                prop_assert!((near.from.distance(near.to) - near.gap_m).abs() < 1e-9);
            }
            prop_assert!(a.gap_bound_m(&b) <= near.gap_m + 1e-9);
        }

        #[test]
        fn rays_end_on_the_outline(shape in shape(), at in pose(), angle in -3.2..3.2_f64) {
            let solid = Solid::placed(&shape, at);
            let (from, along) = (Point2::new(4.0, 3.0), Point2::unit(angle));
            let on_ray = |p: &Point2| along.cross(*p - from).abs() < 0.006 && along.dot(*p - from) > 0.0;
            let dense = outline(&solid).into_iter().filter(on_ray);
            let dense = dense.map(|p| along.dot(p - from)).fold(f64::INFINITY, f64::min);
            if let Some(range_m) = solid.range_m(from, along) {
                let end = from + along * range_m;
                prop_assert!((solid.nearest_to(end).distance(end) - solid.radius_m).abs() < 1e-9);
                prop_assert!(range_m <= dense + 0.1);
            } else {
                let miss = (solid.center() - from).cross(along).abs();
                prop_assert!(dense.is_infinite() || miss > 0.0);
            }
        }
    }
}
