//! Shortest curves of bounded curvature, forward only.
//!
//! L. E. Dubins, "On curves of minimal length with a constraint on average curvature, and with
//! prescribed initial and terminal positions and tangents", American Journal of Mathematics 79,
//! 1957: the shortest one is among the words LSL, RSR, LSR, RSL, LRL and RLR, where the middle arc
//! of the last two is longer than half a circle.

use super::turning_circles::{
    All, SLACK, Shortest, ShortestLength, TurningCircles, WordSink, arcs_around_line, inner_tangent,
};
use super::{Curve, Point2, Pose2};
use std::f64::consts::{PI, TAU};

/// The shortest curve, or nothing where a number is not finite or the radius not positive.
///
/// Its end meets `to` within 1e-9 of the largest of 1, the coordinates and the radius.
///
/// ```
/// use formicar::Pose2;
/// use formicar::geometry::dubins;
///
/// let (from, to) = (Pose2::new(0.0, 0.0, 0.0), Pose2::new(10.0, 0.0, 0.0));
/// assert_eq!(dubins::shortest(from, to, 2.0).unwrap().length_m(), 10.0);
/// assert!(dubins::distance(to, from, 2.0).unwrap() > 20.0);
/// ```
pub fn shortest(from: Pose2, to: Pose2, radius_m: f64) -> Option<Curve> {
    let circles = TurningCircles::new(from, to, radius_m)?;
    let mut sink = Shortest {
        length: f64::INFINITY,
        curve: None,
    };
    search(&circles, radius_m, &mut sink);
    sink.curve
}

/// The curves of all words that reach the goal, shortest first; none on bad numbers.
pub fn candidates(from: Pose2, to: Pose2, radius_m: f64) -> Vec<Curve> {
    let mut sink = All(Vec::new());
    if let Some(circles) = TurningCircles::new(from, to, radius_m) {
        search(&circles, radius_m, &mut sink);
    }
    sink.sorted()
}

/// The length of the shortest curve in meters; nothing on bad numbers.
pub fn distance(from: Pose2, to: Pose2, radius_m: f64) -> Option<f64> {
    let circles = TurningCircles::new(from, to, radius_m)?;
    let mut sink = ShortestLength(f64::INFINITY);
    search(&circles, radius_m, &mut sink);
    Some(sink.0 * radius_m)
}

fn search(circles: &TurningCircles, radius_m: f64, sink: &mut impl WordSink) {
    // Mirrored on the start's heading, words that begin to the right begin to the left.
    let mirrored = |v: Point2| Point2::new(v.x, -v.y);
    let left = View {
        radius_m,
        side: 1.0,
        turn: circles.turn,
        same: circles.left_left,
        other: circles.left_right,
    };
    let right = View {
        radius_m,
        side: -1.0,
        turn: -circles.turn,
        same: mirrored(circles.right_right),
        other: mirrored(circles.right_left),
    };
    left.lsl(sink);
    right.lsl(sink);
    left.lsr(sink);
    right.lsr(sink);
    left.lrl(sink);
    right.lrl(sink);
}

/// The goal seen so that the word begins to the left.
struct View {
    radius_m: f64,
    /// +1 as it is, -1 mirrored.
    side: f64,
    turn: f64,
    /// From the first left circle to the last left circle.
    same: Point2,
    /// From the first left circle to the last right circle.
    other: Point2,
}

impl View {
    fn offer(&self, word: [(f64, f64); 3], sink: &mut impl WordSink) {
        let length = word[0].1 + word[1].1 + word[2].1;
        let steps = word.map(|(side, length)| (side * self.side, length));
        sink.offer(length, || Curve::of_word(self.radius_m, steps.into_iter()));
    }

    fn lsl(&self, sink: &mut impl WordSink) {
        let straight = self.same.dot(self.same).sqrt();
        let whole_turn = to_full_turn(self.turn);
        if straight + whole_turn >= sink.bound() {
            return;
        }
        let (first, last) = arcs_around_line(straight, self.same.angle(), self.turn);
        let (first, last) = (to_full_turn(first), to_full_turn(last));
        self.offer([(1.0, first), (0.0, straight), (1.0, last)], sink);
    }

    fn lsr(&self, sink: &mut impl WordSink) {
        let straight = inner_tangent(self.other.dot(self.other));
        if straight.is_nan() || straight + self.turn.abs() >= sink.bound() {
            return;
        }
        let first = to_full_turn(self.other.angle() + 2_f64.atan2(straight));
        let last = to_full_turn(first - self.turn);
        self.offer([(1.0, first), (0.0, straight), (-1.0, last)], sink);
    }

    /// The centers lie 4 sin(middle / 2) apart, in the direction first - middle / 2.
    fn lrl(&self, sink: &mut impl WordSink) {
        let distance = self.same.dot(self.same).sqrt();
        // On one and the same circle the middle arc would be a full circle.
        let meets = (SLACK..=4.0 + SLACK).contains(&distance);
        if !meets || PI >= sink.bound() {
            return;
        }
        let middle = TAU - 2.0 * (0.25 * distance).min(1.0).asin();
        if middle >= sink.bound() {
            return;
        }
        let first = to_full_turn(self.same.angle() + 0.5 * middle);
        let last = to_full_turn(self.turn - first + middle);
        self.offer([(1.0, first), (-1.0, middle), (1.0, last)], sink);
    }
}

/// An angle in `[-4 pi, 4 pi]` brought to `[0, 2 pi)`; what rounding put just below 2 pi is 0.
pub(super) fn to_full_turn(angle: f64) -> f64 {
    let mut angle = angle;
    while angle < -SLACK {
        angle += TAU;
    }
    while angle > TAU - SLACK {
        angle -= TAU;
    }
    angle.max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lengths(curve: &Curve) -> Vec<f64> {
        curve.arcs().iter().map(|a| a.signed_length_m).collect()
    }

    #[test]
    fn equal_poses_need_no_motion() {
        let pose = Pose2::new(3.0, -2.0, 7.5);
        let curve = shortest(pose, pose, 1.3).unwrap();
        assert!(curve.arcs().is_empty(), "{curve:?}");
        assert_eq!(distance(pose, pose, 1.3), Some(0.0));
    }

    #[test]
    fn a_line_is_one_arc_in_every_direction() {
        for i in 0..100 {
            let from = Pose2::new(0.3, -7.0, 0.1 * f64::from(i));
            let to = from.advance(0.0, 12.5);
            let curve = shortest(from, to, 2.0).unwrap();
            assert_eq!(curve.arcs().len(), 1, "{curve:?}");
            assert!((lengths(&curve)[0] - 12.5).abs() < 1e-11);
        }
    }

    #[test]
    fn touching_circles_need_no_line() {
        let from = Pose2::default();
        let to = from.advance(1.0, 2.0).advance(-1.0, 1.0);
        let curve = shortest(from, to, 1.0).unwrap();
        assert!((curve.length_m() - 3.0).abs() < 1e-9, "{curve:?}");
    }

    #[test]
    fn bad_numbers_give_nothing() {
        let bad = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
        for x in bad {
            let origin = Pose2::default();
            assert_eq!(shortest(Pose2::new(x, 0.0, 0.0), origin, 1.0), None);
            assert_eq!(shortest(origin, Pose2::new(0.0, 0.0, x), 1.0), None);
            assert_eq!(distance(origin, origin, x), None);
            assert!(candidates(origin, Pose2::new(0.0, x, 0.0), 1.0).is_empty());
        }
        assert_eq!(distance(Pose2::default(), Pose2::default(), 0.0), None);
    }
}
