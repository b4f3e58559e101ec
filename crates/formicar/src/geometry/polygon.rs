//! Convex polygons: the shape of vehicles.

use super::{Point2, Pose2};
use thiserror::Error;

/// A list of points that is no convex polygon.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum PolygonError {
    /// Fewer than three points.
    #[error(
        "a polygon needs at least 3 points, got {n_points}; do not repeat the first point at the end"
    )]
    TooFewPoints {
        /// Points given.
        n_points: usize,
    },
    /// A coordinate is not a finite number.
    #[error("polygon point {index} is not finite: ({x}, {y})")]
    NotFinite {
        /// Place in the list.
        index: usize,
        /// Its x coordinate.
        x: f64,
        /// Its y coordinate.
        y: f64,
    },
    /// The boundary turns both ways, crosses itself, or encloses no area.
    #[error(
        "the polygon is not convex at point {index} ({x}, {y}); hint: give the corners in order, or use their convex hull"
    )]
    NotConvex {
        /// Place in the list.
        index: usize,
        /// Its x coordinate.
        x: f64,
        /// Its y coordinate.
        y: f64,
    },
}

/// A convex polygon with counter-clockwise corners; collinear corners are dropped.
///
/// ```
/// use formicar::geometry::{ConvexPolygon, Point2};
///
/// let body = ConvexPolygon::rectangle(Point2::new(-1.0, -0.5), Point2::new(3.0, 0.5));
/// assert_eq!(body.area(), 4.0);
/// assert!(body.contains(Point2::new(2.9, 0.4)));
/// assert_eq!(body.grown(0.25).bounds().1, Point2::new(3.25, 0.75));
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(transparent))]
pub struct ConvexPolygon {
    corners: Vec<Point2>,
}

impl ConvexPolygon {
    /// The polygon with these corners, in either order.
    ///
    /// # Errors
    /// Fewer than three corners, numbers that are not finite, or a boundary that is not convex.
    pub fn new(points: &[Point2]) -> Result<Self, PolygonError> {
        let n_points = points.len();
        if n_points < 3 {
            return Err(PolygonError::TooFewPoints { n_points });
        }
        if let Some(index) = points.iter().position(|p| !p.is_finite()) {
            let Point2 { x, y } = points[index];
            return Err(PolygonError::NotFinite { index, x, y });
        }
        let mut corners = points.to_vec();
        if signed_area(&corners) < 0.0 {
            corners.reverse();
        }
        let corners = without_collinear(&corners);
        match first_reflex(&corners) {
            None => Ok(Self { corners }),
            Some(index) => {
                let Point2 { x, y } = corners.get(index).copied().unwrap_or(points[0]);
                Err(PolygonError::NotConvex { index, x, y })
            }
        }
    }

    /// The smallest convex polygon around the points (Andrew's monotone chain).
    ///
    /// # Errors
    /// Fewer than three points, numbers that are not finite, or points on one line.
    pub fn hull(points: &[Point2]) -> Result<Self, PolygonError> {
        let mut sorted = points.to_vec();
        sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        let mut corners = half_hull(sorted.iter().copied());
        corners.extend(half_hull(sorted.iter().rev().copied()));
        Self::new(&corners)
    }

    /// The axis-aligned rectangle between two opposite corners.
    pub fn rectangle(low: Point2, high: Point2) -> Self {
        let corner = Point2::new;
        Self {
            corners: vec![low, corner(high.x, low.y), high, corner(low.x, high.y)],
        }
    }

    /// The corners, counter-clockwise.
    pub fn corners(&self) -> &[Point2] {
        &self.corners
    }

    /// The directed edges, counter-clockwise: the inside lies to their left.
    pub fn edges(&self) -> impl Iterator<Item = (Point2, Point2)> + '_ {
        let n = self.corners.len();
        (0..n).map(move |i| (self.corners[i], self.corners[(i + 1) % n]))
    }

    /// The polygon with every side moved outwards by a margin.
    #[must_use]
    pub fn grown(&self, margin: f64) -> Self {
        let n = self.corners.len();
        let normal = |i: usize| {
            let edge = self.corners[(i + 1) % n] - self.corners[i % n];
            -edge.perpendicular() * (1.0 / edge.norm())
        };
        let corners = (0..n)
            .map(|i| {
                let (before, after) = (normal(i + n - 1), normal(i));
                let mitre = (before + after) * (1.0 / (1.0 + before.dot(after)));
                self.corners[i] + mitre * margin
            })
            .collect();
        Self { corners }
    }

    /// The corners of the polygon carried to a pose.
    pub fn placed(&self, pose: Pose2) -> Self {
        let (sin, cos) = pose.heading.sin_cos();
        let corners = self
            .corners
            .iter()
            .map(|p| {
                Point2::new(
                    pose.x + cos * p.x - sin * p.y,
                    pose.y + sin * p.x + cos * p.y,
                )
            })
            .collect();
        Self { corners }
    }

    /// True if a point lies inside or on the boundary.
    pub fn contains(&self, point: Point2) -> bool {
        self.edges().all(|(a, b)| (b - a).cross(point - a) >= 0.0)
    }

    /// Area in square units.
    pub fn area(&self) -> f64 {
        signed_area(&self.corners)
    }

    /// Lowest and highest coordinates.
    pub fn bounds(&self) -> (Point2, Point2) {
        let start = (self.corners[0], self.corners[0]);
        self.corners.iter().fold(start, |(low, high), p| {
            (
                Point2::new(low.x.min(p.x), low.y.min(p.y)),
                Point2::new(high.x.max(p.x), high.y.max(p.y)),
            )
        })
    }

    /// The largest distance of a corner from the origin.
    pub fn circumradius(&self) -> f64 {
        self.corners.iter().fold(0.0, |r, p| p.norm().max(r))
    }

    /// The largest radius of a disc about the origin that stays inside; negative when outside.
    ///
    /// A polygon without an inside, like the footprint of a point vehicle, holds no disc.
    pub fn inradius(&self) -> f64 {
        let sides = self.edges().filter(|(a, b)| a != b);
        let least = sides
            .map(|(a, b)| (b - a).cross(-a) / (b - a).norm())
            .reduce(f64::min);
        least.unwrap_or_else(|| -self.circumradius())
    }
}

fn signed_area(corners: &[Point2]) -> f64 {
    let n = corners.len();
    0.5 * (0..n)
        .map(|i| corners[i].cross(corners[(i + 1) % n]))
        .sum::<f64>()
}

fn turn(corners: &[Point2], i: usize) -> (f64, f64) {
    let n = corners.len();
    let (a, b, c) = (corners[(i + n - 1) % n], corners[i], corners[(i + 1) % n]);
    ((b - a).cross(c - b), (b - a).norm() * (c - b).norm())
}

fn without_collinear(corners: &[Point2]) -> Vec<Point2> {
    (0..corners.len())
        .filter(|&i| {
            let (cross, scale) = turn(corners, i);
            cross.abs() > 1e-12 * scale
        })
        .map(|i| corners[i])
        .collect()
}

/// The first corner where the boundary turns right, or winds more than once.
fn first_reflex(corners: &[Point2]) -> Option<usize> {
    let n = corners.len();
    if n < 3 {
        return Some(0);
    }
    let mut winding = 0.0;
    for i in 0..n {
        let (before, after) = (
            corners[i] - corners[(i + n - 1) % n],
            corners[(i + 1) % n] - corners[i],
        );
        if before.cross(after) <= 0.0 {
            return Some(i);
        }
        winding += before.cross(after).atan2(before.dot(after));
    }
    (winding > 1.5 * std::f64::consts::TAU).then_some(0)
}

fn half_hull(points: impl Iterator<Item = Point2>) -> Vec<Point2> {
    let mut chain: Vec<Point2> = Vec::new();
    for point in points {
        while let [.., a, b] = chain[..]
            && (b - a).cross(point - b) <= 0.0
        {
            chain.pop();
        }
        chain.push(point);
    }
    chain.pop();
    chain
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(list: &[(f64, f64)]) -> Vec<Point2> {
        list.iter().map(|&(x, y)| Point2::new(x, y)).collect()
    }

    #[test]
    fn accepts_either_order_and_drops_collinear_corners() {
        let square = points(&[(0., 0.), (0., 2.), (2., 2.), (2., 1.), (2., 0.)]);
        let polygon = ConvexPolygon::new(&square).unwrap();
        assert_eq!(polygon.corners().len(), 4);
        assert!((polygon.area() - 4.0).abs() < 1e-12);
    }

    #[test]
    fn refuses_what_is_not_convex() {
        let dart = points(&[(0., 0.), (4., 0.), (1., 1.), (0., 4.)]);
        assert!(matches!(
            ConvexPolygon::new(&dart),
            Err(PolygonError::NotConvex { .. })
        ));
        let star: Vec<_> = (0..5)
            .map(|i| Point2::unit(f64::from(i) * 144_f64.to_radians()))
            .collect();
        assert!(ConvexPolygon::new(&star).is_err());
        let line = points(&[(0., 0.), (1., 0.), (2., 0.)]);
        assert!(ConvexPolygon::new(&line).is_err());
        assert!(ConvexPolygon::new(&points(&[(0., 0.), (1., f64::NAN), (2., 0.)])).is_err());
    }

    #[test]
    fn hull_keeps_the_outside() {
        let cloud = points(&[
            (0., 0.),
            (1., 1.),
            (4., 0.),
            (2., 0.),
            (4., 3.),
            (0., 3.),
            (2., 2.),
        ]);
        let hull = ConvexPolygon::hull(&cloud).unwrap();
        assert_eq!(hull.corners().len(), 4);
        assert!(cloud.iter().all(|&p| hull.contains(p)));
    }

    #[test]
    fn growing_moves_every_side() {
        let grown = ConvexPolygon::rectangle(Point2::new(-1., -1.), Point2::new(3., 1.)).grown(0.5);
        assert_eq!(
            grown.bounds(),
            (Point2::new(-1.5, -1.5), Point2::new(3.5, 1.5))
        );
        assert!((grown.inradius() - 1.5).abs() < 1e-12);
        let point = ConvexPolygon::rectangle(Point2::default(), Point2::default());
        assert_eq!(point.inradius(), 0.0);
        let elsewhere = Point2::new(3.0, 4.0);
        let point = ConvexPolygon::rectangle(elsewhere, elsewhere);
        assert_eq!(point.inradius(), -5.0);
    }
}
