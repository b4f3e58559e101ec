//! Shortest curves of bounded curvature, forward and in reverse.
//!
//! J. A. Reeds and L. A. Shepp, "Optimal paths for a car that goes both forwards and backwards",
//! Pacific Journal of Mathematics 145, 1990: the shortest one is among 48 words. Each is one of
//! nine base words, sec. 8 (8.1) to (8.11), under time flip (gears swapped), mirroring (sides
//! swapped) and, where that is another word, reversal (order swapped). The equations here are
//! written for the vector between the centers of the first and the last turning circle: all
//! symmetric words share the vector's length, and hence its square roots and arc cosines.

mod view;
mod words;

use super::turning_circles::{
    All, Shortest, ShortestLength, TurningCircles, WordSink, to_half_turn,
};
use super::{Curve, Pose2};
use view::{Link, View};

/// The shortest curve, or nothing where a number is not finite or the radius not positive.
///
/// Its end meets `to` within 1e-9 of the largest of 1, the coordinates and the radius.
///
/// ```
/// use formicar::Pose2;
/// use formicar::geometry::reeds_shepp;
///
/// let (from, to) = (Pose2::new(10.0, 0.0, 0.0), Pose2::new(0.0, 0.0, 0.0));
/// let curve = reeds_shepp::shortest(from, to, 2.0).unwrap();
/// assert_eq!(curve.length_m(), 10.0);
/// assert_eq!(curve.arcs()[0].signed_length_m, -10.0);
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
    let [ll, rr] = [circles.left_left, circles.right_right].map(Link::between);
    let [lr, rl] = [circles.left_right, circles.right_left].map(Link::between);
    let left = View {
        radius_m,
        side: 1.0,
        gear: 1.0,
        turn: circles.turn,
        same: ll,
        other: lr,
        back: rl,
    };
    let right = View {
        side: -1.0,
        turn: to_half_turn(-circles.turn),
        same: rr.mirrored(),
        other: rl.mirrored(),
        back: lr.mirrored(),
        ..left
    };
    let pairs = [left, right].map(|view| [view, view.time_flipped()]);
    // The commonest winners come first: they spare the others their arc tangents.
    for views in &pairs {
        words::lsl(views, sink);
    }
    for views in &pairs {
        words::lsr(views, sink);
    }
    for views in &pairs {
        words::lrl(views, sink);
        words::lrlr(views, sink);
        words::lrsl(views, sink);
        words::lrsr(views, sink);
        words::lrslr(views, sink);
    }
}
