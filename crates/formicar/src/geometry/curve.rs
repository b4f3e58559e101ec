//! Short chains of lines and arcs, as Dubins and Reeds-Shepp curves are.

use super::{Point2, Pose2};
use std::iter;

/// A line or arc by its curvature and its signed length.
///
/// ```
/// use formicar::Pose2;
/// use formicar::geometry::Arc;
///
/// let back = Arc::new(0.0, -3.0);
/// assert_eq!(back.length_m(), 3.0);
/// assert_eq!(back.end_from(Pose2::new(5.0, 1.0, 0.0)), Pose2::new(2.0, 1.0, 0.0));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Arc {
    /// Curvature, positive to the left; 0 on a line.
    pub curvature_per_m: f64,
    /// Length in meters; negative when driven in reverse.
    pub signed_length_m: f64,
}

impl Arc {
    /// The arc with a curvature (positive left) and a signed length.
    pub const fn new(curvature_per_m: f64, signed_length_m: f64) -> Self {
        Self {
            curvature_per_m,
            signed_length_m,
        }
    }

    /// Driven length in meters, at least 0.
    pub fn length_m(self) -> f64 {
        self.signed_length_m.abs()
    }

    /// The pose at the arc's end.
    pub fn end_from(self, start: Pose2) -> Pose2 {
        start.advance(self.curvature_per_m, self.signed_length_m)
    }

    /// Positions and unit headings after equal pieces, `n_pieces` of them, by turning the last one
    /// on: exact to rounding, without a sine per piece.
    pub fn waypoints(
        self,
        start: Pose2,
        n_pieces: usize,
    ) -> impl Iterator<Item = (Point2, Point2)> {
        let piece_m = self.signed_length_m / n_pieces as f64;
        let step = Pose2::default().advance(self.curvature_per_m, piece_m);
        let (turn, moved) = (Point2::unit(step.heading), step.position());
        let first = (start.position(), Point2::unit(start.heading));
        let places = iter::successors(Some(first), move |&(position, along)| {
            let left = along.perpendicular();
            Some((
                position + along * moved.x + left * moved.y,
                along * turn.x + left * turn.y,
            ))
        });
        places.skip(1).take(n_pieces)
    }

    /// The pose on an arc from `start` that is nearest to a point, for less than half a turn.
    pub fn nearest_from(self, start: Pose2, point: Point2) -> Pose2 {
        let local = start.relative(Pose2::at(point, 0.0)).position();
        let bend = self.curvature_per_m;
        let along_m = if bend.abs() < 1e-9 {
            local.x
        } else {
            // The center lies at (0, 1 / curvature).
            (local.x * bend).atan2(1.0 - local.y * bend) / bend
        };
        let end_m = self.signed_length_m;
        start.advance(bend, along_m.clamp(end_m.min(0.0), end_m.max(0.0)))
    }

    /// True if driving the other after this one continues the same motion.
    pub fn continues_in(self, next: Self) -> bool {
        self.curvature_per_m == next.curvature_per_m
            && (self.signed_length_m > 0.0) == (next.signed_length_m > 0.0)
    }
}

/// Up to five arcs, one after the other, without heap memory.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Curve {
    arcs: [Arc; Self::MAX_ARCS],
    n_arcs: usize,
}

impl Curve {
    /// The longest Reeds-Shepp word has five arcs.
    pub const MAX_ARCS: usize = 5;

    /// Steps of a word below this share of the turning radius are rounding, and left out.
    pub(super) const NEGLIGIBLE_RADII: f64 = 1e-12;

    /// The arcs in driving order; empty where the ends are one pose.
    pub fn arcs(&self) -> &[Arc] {
        &self.arcs[..self.n_arcs]
    }

    /// Driven length in meters, both gears counted positive.
    pub fn length_m(&self) -> f64 {
        self.arcs().iter().map(|arc| arc.length_m()).sum()
    }

    /// The pose at the curve's end.
    pub fn end_from(&self, start: Pose2) -> Pose2 {
        self.arcs()
            .iter()
            .fold(start, |pose, arc| arc.end_from(pose))
    }

    /// The start poses of the arcs, each with its arc.
    pub fn placed_arcs(&self, start: Pose2) -> impl Iterator<Item = (Pose2, Arc)> + '_ {
        let mut arcs = self.arcs().iter();
        let mut pose = start;
        iter::from_fn(move || {
            let &arc = arcs.next()?;
            let arc_start = pose;
            pose = arc.end_from(pose);
            Some((arc_start, arc))
        })
    }

    /// The curve of a word: steps are (side, signed length in turning radii), where the side is
    /// +1 for left, 0 for straight and -1 for right.
    pub(super) fn of_word(radius_m: f64, word: impl Iterator<Item = (f64, f64)>) -> Self {
        let mut curve = Self::default();
        for (side, length) in word.filter(|w| w.1.abs() >= Self::NEGLIGIBLE_RADII) {
            curve.push(Arc::new(side / radius_m, length * radius_m));
        }
        curve
    }

    /// The curve of at most five arcs; those without length are left out.
    pub(super) fn of_arcs(arcs: impl IntoIterator<Item = Arc>) -> Self {
        let mut curve = Self::default();
        for arc in arcs.into_iter().filter(|arc| arc.signed_length_m != 0.0) {
            curve.push(arc);
        }
        curve
    }

    /// The same ground driven the other way: from its end to its start, in the other gear.
    #[must_use]
    pub fn driven_back(&self) -> Self {
        let back = |arc: &Arc| Arc::new(arc.curvature_per_m, -arc.signed_length_m);
        Self::of_arcs(self.arcs().iter().rev().map(back))
    }

    fn push(&mut self, arc: Arc) {
        match self.arcs[..self.n_arcs].last_mut() {
            Some(last) if last.continues_in(arc) => last.signed_length_m += arc.signed_length_m,
            _ => {
                self.arcs[self.n_arcs] = arc;
                self.n_arcs += 1;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    #[test]
    fn words_lose_negligible_steps_and_merge_what_goes_on() {
        let word = [(1.0, 1.0), (0.0, 1e-13), (1.0, 0.5), (1.0, -0.25)];
        let curve = Curve::of_word(2.0, word.into_iter());
        assert_eq!(curve.arcs(), [Arc::new(0.5, 3.0), Arc::new(0.5, -0.5)]);
        assert_eq!(curve.length_m(), 3.5);
    }

    #[test]
    fn waypoints_are_the_poses_along() {
        for arc in [Arc::new(0.3, 4.0), Arc::new(-0.7, -2.5), Arc::new(0.0, 3.0)] {
            let start = Pose2::new(1.0, -2.0, 0.4);
            let piece = |i: usize| arc.signed_length_m * (i + 1) as f64 / 50.0;
            let waypoints: Vec<_> = arc.waypoints(start, 50).collect();
            assert_eq!(waypoints.len(), 50);
            for (i, (position, along)) in waypoints.into_iter().enumerate() {
                let pose = start.advance(arc.curvature_per_m, piece(i));
                assert!(position.distance(pose.position()) < 1e-12);
                assert!(along.distance(Point2::unit(pose.heading)) < 1e-13);
            }
        }
    }

    #[test]
    fn drives_from_arc_to_arc() {
        let word = [(1.0, FRAC_PI_2), (0.0, 1.0), (-1.0, -FRAC_PI_2)];
        let curve = Curve::of_word(1.0, word.into_iter());
        let end = curve.end_from(Pose2::default());
        assert!((end.x - 2.0).abs() < 1e-12 && (end.y - 1.0).abs() < 1e-12);
        assert!((end.heading - PI).abs() < 1e-12);
        let (last_start, last) = curve.placed_arcs(Pose2::default()).last().unwrap();
        assert_eq!(last.end_from(last_start), end);
    }
}
