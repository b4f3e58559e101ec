//! The region that a body sweeps while it drives a line or an arc.

use super::Body;
use super::arc::Track;
use super::convex::{Square, edges, penetration, point_segment, polygon_square};
use crate::geometry::{Point2, Pose2};
use std::cell::OnceCell;
use std::f64::consts::{FRAC_PI_2, SQRT_2};

/// A motion along a line or an arc, grid coordinates. A length of 0 is a pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// The first pose.
    pub start: Pose2,
    /// Curvature, positive left.
    pub curvature_per_m: f64,
    /// Driven length, negative in reverse.
    pub signed_length_m: f64,
}

impl Drive {
    /// Standing at a pose.
    pub fn at(start: Pose2) -> Self {
        Self {
            start,
            curvature_per_m: 0.0,
            signed_length_m: 0.0,
        }
    }

    /// The pose after a fraction of the drive.
    pub fn pose_at(&self, fraction: f64) -> Pose2 {
        self.start
            .advance(self.curvature_per_m, fraction * self.signed_length_m)
    }

    /// The part between two fractions of the drive.
    #[must_use]
    pub fn between(&self, from: f64, to: f64) -> Self {
        Self {
            start: self.pose_at(from),
            signed_length_m: (to - from) * self.signed_length_m,
            ..*self
        }
    }

    /// The drive cut into `n` equal pieces.
    pub fn pieces(&self, n: usize) -> impl Iterator<Item = Self> + '_ {
        let signed_length_m = self.signed_length_m / n as f64;
        (0..n).map(move |i| Self {
            start: self.pose_at(i as f64 / n as f64),
            signed_length_m,
            ..*self
        })
    }

    /// Whether the turn is too slight for its center to be computed with.
    fn is_straight(&self) -> bool {
        self.curvature_per_m.abs() < 1e-6
    }

    /// Largest distance of a body from the straight sweep along the start heading.
    fn deviation(&self, body: &Body) -> f64 {
        (self.curvature_per_m * self.signed_length_m).abs()
            * (self.signed_length_m.abs() + body.reach_m())
    }

    /// Largest distances of body points from their positions halfway, along and across the heading
    /// there.
    fn spread(&self, body: &Body) -> Point2 {
        if self.is_straight() {
            let deviation = self.deviation(body);
            return Point2::new(0.5 * self.signed_length_m.abs() + deviation, deviation);
        }
        let half_turn = 0.5 * (self.curvature_per_m * self.signed_length_m).abs();
        let (sin, cos) = half_turn.sin_cos();
        let lever = Point2::new(
            body.middle.x.abs() + body.half.x,
            (body.middle.y - 1.0 / self.curvature_per_m).abs() + body.half.y,
        );
        Point2::new(
            lever.y * sin + lever.x * (1.0 - cos),
            lever.x * sin + lever.y * (1.0 - cos),
        )
    }

    /// Best number of pieces of a body's sweep: each turns by less than a quarter circle and moves by
    /// about half of the body.
    pub fn n_pieces(&self, body: &Body) -> usize {
        let turn = (self.curvature_per_m * self.signed_length_m).abs();
        let by_length = self.signed_length_m.abs() / body.half.x.max(body.half.y).max(0.5);
        by_length.max(turn / (0.99 * FRAC_PI_2)).ceil().max(1.0) as usize
    }
}

/// A swept region with its bounds; the exact shape is computed when a square comes near.
pub(super) struct Sweep<'a> {
    body: &'a Body,
    drive: Drive,
    /// Middle, direction and half size of a box around the region.
    middle: Point2,
    along: Point2,
    half: Point2,
    /// Largest distance of the centers of the covering discs from their positions halfway.
    disc_shift: f64,
    shape: OnceCell<Shape>,
}

enum Shape {
    /// A convex polygon, and the distance by which the true region may exceed it.
    Convex(Vec<Point2>, f64),
    Turning(Turning),
}

/// A body that turns about a center.
struct Turning {
    first: Vec<Point2>,
    last: Vec<Point2>,
    center: Point2,
    /// The whole turn, as a rotation.
    rotation: Point2,
    sense: f64,
    /// The ring about the center in which the body stays, and those of its edges.
    ring: Ring,
    edge_rings: Vec<Ring>,
}

/// Distances from the center of a turn.
struct Ring {
    inner: f64,
    outer: f64,
}

impl<'a> Sweep<'a> {
    /// The sweep of a drive that needs one piece only.
    pub(super) fn new(body: &'a Body, drive: Drive) -> Self {
        let mid = drive.pose_at(0.5);
        let along = Point2::unit(mid.heading);
        let middle = mid.position() + along * body.middle.x + along.perpendicular() * body.middle.y;
        let spread = drive.spread(body);
        Self {
            body,
            drive,
            middle,
            along,
            half: body.half + spread,
            disc_shift: spread.norm(),
            shape: OnceCell::new(),
        }
    }

    /// The axis-aligned box around the region.
    pub(super) fn window(&self) -> (Point2, Point2) {
        let (c, s) = (self.along.x.abs(), self.along.y.abs());
        let reach = Point2::new(
            c * self.half.x + s * self.half.y,
            s * self.half.x + c * self.half.y,
        );
        (self.middle - reach, self.middle + reach)
    }

    /// No point of the region is nearer to a square than this: the distance between the box and
    /// one in its directions around the square, exact where a side of the box is nearest.
    pub(super) fn at_least(&self, square: &Square) -> f64 {
        let d = square.center - self.middle;
        let around = square.half * (self.along.x.abs() + self.along.y.abs());
        let dx = (d.dot(self.along).abs() - self.half.x - around).max(0.0);
        let dy = (d.cross(self.along).abs() - self.half.y - around).max(0.0);
        (dx * dx + dy * dy).sqrt()
    }

    /// Centers and radius of discs that cover the region.
    pub(super) fn discs(&self) -> (impl Iterator<Item = Point2> + '_, f64) {
        let (left, body) = (self.along.perpendicular(), self.body);
        let centers = body.discs.iter().map(move |&d| {
            self.middle + self.along * (d.x - body.middle.x) + left * (d.y - body.middle.y)
        });
        (centers, body.disc_radius + self.disc_shift)
    }

    /// The body's corner mean halfway.
    pub(super) fn inner_center(&self) -> Point2 {
        let d = self.body.inner_center - self.body.middle;
        self.middle + self.along * d.x + self.along.perpendicular() * d.y
    }

    /// A point that the region certainly holds: a corner of the body at the start.
    pub(super) fn witness(&self) -> Point2 {
        self.drive.start.transform(self.body.corners[0])
    }

    /// Distance to a square, 0 when touching: exact where it is below `limit`.
    pub(super) fn distance(&self, square: &Square, limit: f64) -> f64 {
        match self.shape() {
            Shape::Convex(corners, deviation) => {
                (polygon_square(corners, square) - deviation).max(0.0)
            }
            Shape::Turning(turning) => turning.distance(square, limit),
        }
    }

    /// Exact bounds of the region.
    pub(super) fn bounds(&self) -> (Point2, Point2) {
        match self.shape() {
            Shape::Convex(corners, deviation) => {
                let margin = Point2::new(*deviation, *deviation);
                corners.iter().fold((corners[0], corners[0]), |b, &p| {
                    widen(b, p - margin, p + margin)
                })
            }
            Shape::Turning(turning) => turning
                .tracks()
                .map(|track| track.bounds())
                .reduce(|all, (low, high)| widen(all, low, high))
                .expect("a body has corners"),
        }
    }

    fn shape(&self) -> &Shape {
        self.shape.get_or_init(|| {
            if self.drive.is_straight() {
                let corners = swept_straight(&self.body.corners, self.drive.signed_length_m);
                let placed = placed(&corners, self.drive.start);
                return Shape::Convex(placed, self.drive.deviation(self.body));
            }
            Shape::Turning(Turning::new(self.body, &self.drive))
        })
    }
}

impl Turning {
    fn new(body: &Body, drive: &Drive) -> Self {
        let turn = drive.curvature_per_m * drive.signed_length_m;
        let center = drive
            .start
            .transform(Point2::new(0.0, 1.0 / drive.curvature_per_m));
        let first = placed(&body.corners, drive.start);
        let edge_rings: Vec<Ring> = edges(&first)
            .map(|(a, b)| Ring {
                inner: point_segment(center, a, b),
                outer: a.distance(center).max(b.distance(center)),
            })
            .collect();
        let around_center = penetration(&first, &Square { center, half: 0.0 }) >= 0.0;
        let inner = edge_rings
            .iter()
            .fold(f64::INFINITY, |r, ring| ring.inner.min(r));
        let outer = edge_rings.iter().fold(0.0, |r, ring| ring.outer.max(r));
        Self {
            ring: Ring {
                inner: if around_center { 0.0 } else { inner },
                outer,
            },
            edge_rings,
            last: placed(&body.corners, drive.pose_at(1.0)),
            first,
            center,
            rotation: Point2::unit(turn),
            sense: turn.signum(),
        }
    }

    /// Exact distance to a square: the ends, corners of the body past edges of the square, and
    /// corners of the square, seen from the body, past edges of the body.
    fn distance(&self, square: &Square, limit: f64) -> f64 {
        let (away, around) = (square.center.distance(self.center), square.half * SQRT_2);
        let off_ring = (away - around - self.ring.outer).max(self.ring.inner - away - around);
        if off_ring >= limit {
            return limit;
        }
        let ends = polygon_square(&self.first, square).min(polygon_square(&self.last, square));
        if ends == 0.0 {
            return 0.0;
        }
        let least = ends.min(limit);
        let corners = square.corners();
        let passes = |track: &Track| (away - track.radius).abs() - around < least;
        let outward = self.tracks().filter(passes).fold(least, |least, track| {
            edges(&corners).fold(least, |least, edge| nearest(&track, edge, least))
        });
        corners.iter().fold(outward, |least, &q| {
            let track = self.seen_from_body(q);
            let near = |ring: &Ring| {
                ring.inner - least < track.radius && track.radius < ring.outer + least
            };
            let edges = edges(&self.first)
                .zip(&self.edge_rings)
                .filter(|(_, ring)| near(ring));
            edges.fold(least, |least, (edge, _)| nearest(&track, edge, least))
        })
    }

    fn tracks(&self) -> impl Iterator<Item = Track> + '_ {
        self.first
            .iter()
            .zip(&self.last)
            .map(|(&a, &b)| self.track(a - self.center, b - self.center, self.sense))
    }

    /// A fixed point turns the other way round when seen from the body.
    fn seen_from_body(&self, q: Point2) -> Track {
        let (ray, r) = (q - self.center, self.rotation);
        let back = Point2::new(r.x * ray.x + r.y * ray.y, r.x * ray.y - r.y * ray.x);
        self.track(ray, back, -self.sense)
    }

    fn track(&self, from: Point2, to: Point2, sense: f64) -> Track {
        Track {
            center: self.center,
            from,
            to,
            radius: from.norm(),
            sense,
        }
    }
}

/// The lesser of a distance and that from a track's inner points to an edge; the caller checks the
/// track's ends.
fn nearest(track: &Track, (a, b): (Point2, Point2), least: f64) -> f64 {
    least.min(track.beside(a)).min(track.across(a, b))
}

fn placed(corners: &[Point2], pose: Pose2) -> Vec<Point2> {
    let along = Point2::unit(pose.heading);
    let left = along.perpendicular();
    corners
        .iter()
        .map(|p| pose.position() + along * p.x + left * p.y)
        .collect()
}

/// The convex region that a convex body sweeps along its own x axis.
fn swept_straight(corners: &[Point2], length: f64) -> Vec<Point2> {
    if length == 0.0 {
        return corners.to_vec();
    }
    let n = corners.len();
    let shift = Point2::new(length, 0.0);
    // An edge leads where its outward normal points along the motion.
    let leads = |i: usize| (corners[(i + 1) % n].y - corners[i % n].y) * length > 0.0;
    if n == 1 {
        return vec![corners[0], corners[0] + shift];
    }
    let mut swept = Vec::with_capacity(n + 2);
    for (i, &corner) in corners.iter().enumerate() {
        match (leads(i + n - 1), leads(i)) {
            (false, false) => swept.push(corner),
            (true, true) => swept.push(corner + shift),
            (false, true) => swept.extend([corner, corner + shift]),
            (true, false) => swept.extend([corner + shift, corner]),
        }
    }
    swept
}

fn widen((low, high): (Point2, Point2), other_low: Point2, other_high: Point2) -> (Point2, Point2) {
    (
        Point2::new(low.x.min(other_low.x), low.y.min(other_low.y)),
        Point2::new(high.x.max(other_high.x), high.y.max(other_high.y)),
    )
}
