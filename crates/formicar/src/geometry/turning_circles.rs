//! Turning circles, common to Dubins and Reeds-Shepp words: those of the goal, seen from the
//! start, and the ways to look for the shortest word.
//!
//! A word that begins on one turning circle and ends on another depends on nothing but the vector
//! between their centers and the difference of the headings. The solutions below keep to that
//! vector's length and direction, since they then meet the goal to rounding even where the
//! lengths themselves are ill-conditioned (circles that touch, arcs near half a circle).

use super::{Curve, Point2, Pose2, wrap_angle};
use std::f64::consts::{PI, TAU};

/// A length or a square that rounding pushed below 0 by at most this still means 0.
pub(super) const SLACK: f64 = Curve::NEGLIGIBLE_RADII;

/// Vectors between the centers of the start's and the goal's turning circles, in turning radii,
/// in the start's frame.
pub(super) struct TurningCircles {
    /// The heading's change from start to goal, in `(-pi, pi]`.
    pub(super) turn: f64,
    /// From the start's left circle to the goal's left circle; the others likewise.
    pub(super) left_left: Point2,
    pub(super) left_right: Point2,
    pub(super) right_left: Point2,
    pub(super) right_right: Point2,
}

impl TurningCircles {
    /// Nothing where a number is not finite, the radius not positive, or the ends too far apart
    /// for the square of their distance to be a number.
    pub(super) fn new(from: Pose2, to: Pose2, radius_m: f64) -> Option<Self> {
        if !(radius_m > 0.0 && radius_m.is_finite()) {
            return None;
        }
        let local = from.relative(to);
        let (x, y) = (local.x / radius_m, local.y / radius_m);
        let turn = wrap_angle(local.heading);
        if !((x * x + y * y).is_finite() && turn.is_finite()) {
            return None;
        }
        let (sin, cos) = turn.sin_cos();
        Some(Self {
            turn,
            left_left: Point2::new(x - sin, y - (1.0 - cos)),
            left_right: Point2::new(x + sin, y - (1.0 + cos)),
            right_left: Point2::new(x - sin, y + (1.0 + cos)),
            right_right: Point2::new(x + sin, y + (1.0 - cos)),
        })
    }
}

/// Length of the common inner tangent of two unit circles from the square of their centers'
/// distance; 0 where they touch, not a number where they overlap.
pub(super) fn inner_tangent(squared_distance: f64) -> f64 {
    let squared = squared_distance - 4.0;
    if squared.abs() < SLACK {
        return 0.0;
    }
    squared.sqrt()
}

/// The arcs before and after a line between two circles of the same side, as angles in
/// `[-pi, pi]`, where the line has the given length and direction and the heading turns by `turn`.
///
/// Arcs that would shift the goal by rounding alone are 0: on a short line the direction is
/// ill-conditioned, and an arc that came out negative would else become a full circle.
pub(super) fn arcs_around_line(straight: f64, direction: f64, turn: f64) -> (f64, f64) {
    let is_rounding = |arc: f64| straight * arc.abs().min(1.0) < SLACK;
    let last = to_half_turn(turn - direction);
    if is_rounding(last) {
        (turn, 0.0)
    } else if is_rounding(direction) {
        (0.0, turn)
    } else {
        (direction, last)
    }
}

/// An angle in `[-3 pi, 3 pi]` brought to `(-pi, pi]`, where pi may be exceeded by rounding.
pub(super) fn to_half_turn(angle: f64) -> f64 {
    if angle > PI + SLACK {
        angle - TAU
    } else if angle < -PI + SLACK {
        angle + TAU
    } else {
        angle
    }
}

/// Takes the words of a search, each with its length in turning radii.
pub(super) trait WordSink {
    /// Words of this length or more are of no use.
    fn bound(&self) -> f64;

    /// Takes a word, shorter than the bound or not.
    fn offer(&mut self, length: f64, curve: impl FnOnce() -> Curve);
}

/// Keeps the length of the shortest word.
pub(super) struct ShortestLength(pub(super) f64);

impl WordSink for ShortestLength {
    fn bound(&self) -> f64 {
        self.0
    }

    fn offer(&mut self, length: f64, _: impl FnOnce() -> Curve) {
        if length < self.0 {
            self.0 = length;
        }
    }
}

/// Keeps the shortest word; the first of equals.
pub(super) struct Shortest {
    pub(super) length: f64,
    pub(super) curve: Option<Curve>,
}

impl WordSink for Shortest {
    fn bound(&self) -> f64 {
        self.length
    }

    fn offer(&mut self, length: f64, curve: impl FnOnce() -> Curve) {
        if length < self.length {
            self.length = length;
            self.curve = Some(curve());
        }
    }
}

/// Keeps every word.
pub(super) struct All(pub(super) Vec<Curve>);

impl All {
    /// The different curves, shortest first, equals in word order.
    pub(super) fn sorted(self) -> Vec<Curve> {
        let mut curves = self.0;
        curves.sort_by(|a, b| a.length_m().total_cmp(&b.length_m()));
        curves.dedup();
        curves
    }
}

impl WordSink for All {
    fn bound(&self) -> f64 {
        f64::INFINITY
    }

    fn offer(&mut self, _: f64, curve: impl FnOnce() -> Curve) {
        self.0.push(curve());
    }
}
