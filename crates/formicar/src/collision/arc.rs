//! Distance from a circular track to a straight edge.

use crate::geometry::Point2;

/// The track of a point that turns about a center by less than half a circle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Track {
    pub(super) center: Point2,
    /// From the center to the first and the last point of the track.
    pub(super) from: Point2,
    pub(super) to: Point2,
    pub(super) radius: f64,
    /// +1 counter-clockwise, -1 clockwise.
    pub(super) sense: f64,
}

impl Track {
    /// Whether a ray from the center meets the track.
    pub(super) fn spans(&self, ray: Point2) -> bool {
        self.sense * self.from.cross(ray) >= 0.0 && self.sense * ray.cross(self.to) >= 0.0
    }

    /// Distance from a point to the track's circle, where the nearest point lies on the track.
    pub(super) fn beside(&self, p: Point2) -> f64 {
        let ray = p - self.center;
        if self.spans(ray) {
            (ray.norm() - self.radius).abs()
        } else {
            f64::INFINITY
        }
    }

    /// Distance between the inner points of the track and of an edge: 0 where they cross,
    /// infinite where the nearest pair has an end point in it.
    pub(super) fn across(&self, a: Point2, b: Point2) -> f64 {
        let (d, ray) = (b - a, self.center - a);
        let length2 = d.dot(d);
        if length2 == 0.0 {
            return f64::INFINITY;
        }
        let t = ray.dot(d) / length2;
        let height2 = (ray.dot(ray) - t * t * length2).max(0.0);
        let inside2 = self.radius * self.radius - height2;
        if inside2 >= 0.0 {
            let reach = (inside2 / length2).sqrt();
            let crosses = |t: f64| (0.0..=1.0).contains(&t) && self.spans(a + d * t - self.center);
            if crosses(t - reach) || crosses(t + reach) {
                return 0.0;
            }
        }
        let foot = a + d * t - self.center;
        if (0.0..=1.0).contains(&t) && self.spans(foot) {
            return (height2.sqrt() - self.radius).abs();
        }
        f64::INFINITY
    }

    /// Lowest and highest coordinates of the track.
    pub(super) fn bounds(&self) -> (Point2, Point2) {
        let (a, b) = (self.from, self.to);
        let reach = |axis: Point2| {
            let end = a.dot(axis).max(b.dot(axis));
            if self.spans(axis) { self.radius } else { end }
        };
        let low = Point2::new(
            -reach(Point2::new(-1.0, 0.0)),
            -reach(Point2::new(0.0, -1.0)),
        );
        let high = Point2::new(reach(Point2::new(1.0, 0.0)), reach(Point2::new(0.0, 1.0)));
        (self.center + low, self.center + high)
    }
}
