//! A vehicle's footprint prepared for distance queries.

use super::convex::point_boundary;
use crate::geometry::{ConvexPolygon, Point2};
use crate::vehicle::{Motion, Vehicle};

/// A footprint with its bounds: a box, covering discs, and points that certainly lie in it.
///
/// A body that is not convex has parts: corners and bounds are those of its hull, and distances
/// those of the nearest part.
#[derive(Clone, Debug)]
pub struct Body {
    /// The convex parts; none of a convex body.
    pub(super) parts: Vec<Body>,
    /// Corners around the rear axle, counter-clockwise.
    pub(super) corners: Vec<Point2>,
    /// Middle of the bounding box.
    pub(super) middle: Point2,
    /// Half the size of the bounding box.
    pub(super) half: Point2,
    /// Centers of equal discs that cover the bounding box, along its longer side.
    pub(super) discs: Vec<Point2>,
    /// Their radius.
    pub(super) disc_radius: f64,
    /// Radius of the largest disc about the inner center that stays inside.
    pub(super) inner_radius: f64,
    /// The corner mean; of a body in parts, that of the part with the largest such disc.
    pub(super) inner_center: Point2,
    /// Inset of cell squares before a touch counts: a point may touch, a body may not.
    pub(super) inset: f64,
}

impl Body {
    /// The body of a vehicle with its safety margin.
    pub fn new(vehicle: &Vehicle) -> Self {
        match vehicle.motion() {
            Motion::Car => Self::of_parts(vehicle),
            Motion::Point => Self::of(vec![Point2::default()], 2.0 * super::MIN_CLEARANCE_M),
        }
    }

    fn of_parts(vehicle: &Vehicle) -> Self {
        let convex = |polygon: &ConvexPolygon| Self::of(polygon.corners().to_vec(), 0.0);
        let whole = convex(vehicle.footprint());
        let [_, _, ..] = vehicle.parts() else {
            return whole;
        };
        let parts: Vec<_> = vehicle.parts().iter().map(convex).collect();
        let by_radius = |a: &&Self, b: &&Self| a.inner_radius.total_cmp(&b.inner_radius);
        let widest = parts.iter().max_by(by_radius).expect("two parts at least");
        Self {
            inner_radius: widest.inner_radius,
            inner_center: widest.inner_center,
            parts,
            ..whole
        }
    }

    /// Its convex parts; itself where it is convex.
    pub(super) fn convex_parts(&self) -> &[Self] {
        if self.parts.is_empty() {
            std::slice::from_ref(self)
        } else {
            &self.parts
        }
    }

    fn of(corners: Vec<Point2>, inset: f64) -> Self {
        let mut low = corners[0];
        let mut high = corners[0];
        for p in &corners {
            low = Point2::new(low.x.min(p.x), low.y.min(p.y));
            high = Point2::new(high.x.max(p.x), high.y.max(p.y));
        }
        let (middle, half) = (low.lerp(high, 0.5), (high - low) * 0.5);
        let (discs, disc_radius) = covering_discs(middle, half);
        let inner_center = corners.iter().fold(Point2::default(), |sum, &p| sum + p)
            * (1.0 / corners.len() as f64);
        let inner_radius = match corners.len() {
            1 => 0.0,
            _ => about(&corners, inner_center).inradius(),
        };
        Self {
            parts: Vec::new(),
            corners,
            middle,
            half,
            discs,
            disc_radius,
            inner_radius,
            inner_center,
            inset,
        }
    }

    /// Radius of the largest disc about a corner mean that stays inside the body, meters.
    pub fn inner_radius_m(&self) -> f64 {
        self.inner_radius
    }

    /// Width of the ring that the body sweeps when the rear-axle center drives a circle, meters.
    pub fn swept_width_m(&self, radius_m: f64) -> f64 {
        let center = Point2::new(0.0, radius_m);
        let outer = self
            .corners
            .iter()
            .fold(0.0, |r: f64, p| p.distance(center).max(r));
        let parts = self.convex_parts().iter();
        let inner = parts.map(|part| point_boundary(center, &part.corners));
        outer - inner.fold(f64::INFINITY, f64::min)
    }

    /// Largest distance by which the covering discs exceed the sides of the bounding box, meters.
    pub fn discs_stand_out_m(&self) -> f64 {
        let parts = self.convex_parts().iter();
        let out_m = parts.map(|part| part.disc_radius - part.half.x.min(part.half.y));
        out_m.fold(0.0, f64::max)
    }

    /// The largest distance of the body from the rear-axle center, meters.
    pub fn reach_m(&self) -> f64 {
        self.corners.iter().fold(0.0, |r, p| p.norm().max(r))
    }
}

fn about(corners: &[Point2], center: Point2) -> ConvexPolygon {
    let shifted: Vec<_> = corners.iter().map(|&p| p - center).collect();
    ConvexPolygon::new(&shifted).expect("a footprint stays convex when moved")
}

/// The number of discs: each covers a piece about half as long as the box is wide.
fn covering_discs(middle: Point2, half: Point2) -> (Vec<Point2>, f64) {
    const MAX_DISCS: f64 = 16.0;
    let (long, short) = if half.x >= half.y {
        (half.x, half.y)
    } else {
        (half.y, half.x)
    };
    let along = if half.x >= half.y {
        Point2::new(long, 0.0)
    } else {
        Point2::new(0.0, long)
    };
    let n_discs = if short > 0.0 {
        (2.0 * long / short).ceil().min(MAX_DISCS)
    } else {
        1.0
    };
    let piece = long / n_discs;
    let discs = (0..n_discs as usize)
        .map(|i| middle + along * ((2.0 * i as f64 + 1.0) / n_discs - 1.0))
        .collect();
    (discs, piece.hypot(short))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn discs_cover_the_box() {
        for vehicle in [Vehicle::lei2020(), Vehicle::f1tenth(), Vehicle::sedan()] {
            let body = Body::new(&vehicle);
            for p in vehicle.footprint().corners() {
                for q in vehicle.footprint().corners() {
                    let on_edge = p.lerp(*q, 0.37);
                    assert!(
                        body.discs
                            .iter()
                            .any(|d| d.distance(on_edge) <= body.disc_radius + 1e-12)
                    );
                }
            }
        }
    }

    #[test]
    fn a_point_has_no_extent() {
        let body = Body::new(&Vehicle::point());
        assert_eq!(
            (body.reach_m(), body.inner_radius, body.disc_radius),
            (0.0, 0.0, 0.0)
        );
        assert!(body.inset > 0.0);
    }
}
