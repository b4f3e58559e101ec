//! Clamped uniform cubic B-splines, and the arcs that they become.

use super::{Arc, Point2, Pose2, flattest_biarc};

/// A B-spline of third order over control points: it begins at the first along the first leg, ends
/// at the last along the last leg, and stays within the hull of any four consecutive ones.
///
/// Cubic, with simple knots at whole numbers between fourfold ones at both ends (de Boor 1978);
/// of fewer than four control points, of as high a degree as these allow.
///
/// ```
/// use formicar::geometry::{BSpline, Point2};
///
/// let corners = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [8.0, 4.0]].map(|[x, y]| Point2::new(x, y));
/// let spline = BSpline::new(corners.to_vec()).unwrap();
/// assert_eq!(spline.at(0.0), corners[0]);
/// assert_eq!(spline.at(spline.n_pieces() as f64), corners[3]);
/// assert!(!spline.arcs(0.01).is_empty());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct BSpline {
    points: Vec<Point2>,
}

/// Degree where there are control points enough.
const DEGREE: usize = 3;

/// Most halvings of a piece of the spline before it becomes a biarc.
const MAX_HALVINGS: u32 = 16;

/// Places on a piece at which its distance from a biarc is measured.
const N_CHECKS: u32 = 16;

/// Share of a tolerance that the checked places may be off, as others are off by more.
const CHECKED_SHARE: f64 = 0.8;

/// A tangent shorter than this share of a typical leg tells no direction.
const LEAST_SPEED: f64 = 1e-9;

impl BSpline {
    /// The spline over control points; none without points.
    pub fn new(points: Vec<Point2>) -> Option<Self> {
        (!points.is_empty()).then_some(Self { points })
    }

    /// The control points.
    pub fn points(&self) -> &[Point2] {
        &self.points
    }

    /// Number of polynomial pieces: parameters run from 0 to this.
    pub fn n_pieces(&self) -> usize {
        self.points.len() - self.degree()
    }

    fn degree(&self) -> usize {
        DEGREE.min(self.points.len() - 1)
    }

    /// The knot of an index, of which the first and the last ones lie on the ends.
    fn knot(&self, index: usize) -> f64 {
        index.saturating_sub(self.degree()).min(self.n_pieces()) as f64
    }

    /// The piece that a parameter lies in.
    fn piece(&self, u: f64) -> usize {
        (u.max(0.0) as usize).min(self.n_pieces().max(1) - 1)
    }

    /// The point at a parameter.
    pub fn at(&self, u: f64) -> Point2 {
        self.de_boor(&self.points, self.degree(), u)
    }

    /// The derivative by the parameter.
    pub fn derivative(&self, u: f64) -> Point2 {
        let degree = self.degree();
        let leg = |(i, w): (usize, &[Point2])| {
            let knots = self.knot(i + degree + 1) - self.knot(i + 1);
            (w[1] - w[0]) * (degree as f64 / knots)
        };
        if degree == 0 {
            return Point2::default();
        }
        let legs: Vec<Point2> = self.points.windows(2).enumerate().map(leg).collect();
        self.de_boor(&legs, degree - 1, u)
    }

    /// De Boor's algorithm on control points of this spline or of its derivative, whose knots are
    /// the same but for the first and the last.
    fn de_boor(&self, points: &[Point2], degree: usize, u: f64) -> Point2 {
        let (piece, skipped) = (self.piece(u), self.degree() - degree);
        let knot = |index: usize| self.knot(index + skipped);
        let mut local: [Point2; DEGREE + 1] = std::array::from_fn(|k| {
            let last = piece + degree;
            points[(piece + k).min(last)]
        });
        for level in 1..=degree {
            for k in (level..=degree).rev() {
                let (low, high) = (knot(piece + k), knot(piece + k + degree + 1 - level));
                let share = (u - low) / (high - low);
                local[k] = local[k - 1].lerp(local[k], share);
            }
        }
        local[degree]
    }

    /// The direction of the spline at a parameter; at an end where legs of no length leave none,
    /// and at a cusp, that of a chord beside it.
    fn direction(&self, u: f64) -> Option<Point2> {
        let n_pieces = self.n_pieces() as f64;
        let legs = self.points.windows(2).map(|w| w[0].distance(w[1]));
        let least = LEAST_SPEED * legs.fold(0.0, f64::max);
        let tangent = self.derivative(u);
        if tangent.norm() > least {
            return Some(tangent * (1.0 / tangent.norm()));
        }
        let near = |side: f64| self.at((u + side).clamp(0.0, n_pieces));
        let chord = near(1e-3) - near(-1e-3);
        (chord.norm() > 0.0).then(|| chord * (1.0 / chord.norm()))
    }

    /// Arcs from the spline's start to its end, each with the pose where it begins, that stay
    /// within `tolerance_m` of it; none of a spline that stays on one point.
    ///
    /// Biarcs between points of the spline, halved until they are near enough: they pass into each
    /// other without a kink. Only where the spline itself has a cusp no biarc serves; a straight
    /// line takes its place, with kinks at its ends.
    pub fn arcs(&self, tolerance_m: f64) -> Vec<(Pose2, Arc)> {
        let mut arcs = Vec::new();
        for piece in 0..self.n_pieces() {
            let ends = [piece as f64, piece as f64 + 1.0];
            self.add_arcs(ends, tolerance_m, MAX_HALVINGS, &mut arcs);
        }
        arcs
    }

    fn add_arcs(
        &self,
        [from, to]: [f64; 2],
        tolerance_m: f64,
        n_left: u32,
        arcs: &mut Vec<(Pose2, Arc)>,
    ) {
        let (start, step) = (self.at(from), self.at(to) - self.at(from));
        let tangents = self.direction(from).zip(self.direction(to));
        let biarc = tangents.and_then(|(a, b)| {
            let [first, second] = flattest_biarc(step, [a, b])?;
            let start = Pose2::at(start, a.angle());
            Some([(start, first), (first.end_from(start), second)])
        });
        let biarc = biarc.filter(|biarc| self.is_near(biarc, [from, to], tolerance_m));
        if let Some(biarc) = biarc {
            arcs.extend(biarc);
        } else if n_left > 0 {
            let middle = 0.5 * (from + to);
            self.add_arcs([from, middle], tolerance_m, n_left - 1, arcs);
            self.add_arcs([middle, to], tolerance_m, n_left - 1, arcs);
        } else if step.norm() > 0.0 {
            let line = Arc::new(0.0, step.norm());
            arcs.push((Pose2::at(start, step.angle()), line));
        }
    }

    /// True if the spline between two parameters stays near arcs.
    fn is_near(&self, arcs: &[(Pose2, Arc)], [from, to]: [f64; 2], tolerance_m: f64) -> bool {
        (1..N_CHECKS).all(|i| {
            let share = f64::from(i) / f64::from(N_CHECKS);
            let point = self.at(from + share * (to - from));
            let off_m = |(start, arc): &(Pose2, Arc)| {
                arc.nearest_from(*start, point).position().distance(point)
            };
            let nearest_m = arcs.iter().map(off_m).fold(f64::INFINITY, f64::min);
            nearest_m <= CHECKED_SHARE * tolerance_m
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::angle_difference;
    use proptest::prelude::*;

    fn points(n: std::ops::Range<usize>) -> impl Strategy<Value = Vec<Point2>> {
        let point = (-20.0..20.0, -20.0..20.0).prop_map(|(x, y)| Point2::new(x, y));
        prop::collection::vec(point, n)
    }

    /// The value of the basis function of each control point, by the recursion of Cox and de Boor.
    fn basis(spline: &BSpline, u: f64) -> Vec<f64> {
        let (n, degree) = (spline.points.len(), spline.degree());
        let knot = |i: usize| spline.knot(i);
        let piece = spline.piece(u) + degree;
        let mut values: Vec<f64> = (0..n + degree)
            .map(|i| f64::from(u8::from(i == piece)))
            .collect();
        let share = |u: f64, low: f64, high: f64| {
            if high > low {
                (u - low) / (high - low)
            } else {
                0.0
            }
        };
        for level in 1..=degree {
            values = (0..n + degree - level)
                .map(|i| {
                    let rises = share(u, knot(i), knot(i + level));
                    let falls = 1.0 - share(u, knot(i + 1), knot(i + level + 1));
                    values[i] * rises + values[i + 1] * falls
                })
                .collect();
        }
        values
    }

    proptest! {
        #[test]
        fn weights_of_control_points_are_positive_and_add_up_to_one(
            points in points(1..9),
            share in 0.0..1.0,
        ) {
            let spline = BSpline::new(points).unwrap();
            let u = share * spline.n_pieces() as f64;
            let weights = basis(&spline, u);
            prop_assert_eq!(weights.len(), spline.points.len());
            prop_assert!(weights.iter().all(|&w| (-1e-12..1.0 + 1e-12).contains(&w)));
            prop_assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-12);
            let weighed = spline.points.iter().zip(&weights).map(|(&p, &w)| p * w);
            let point = weighed.fold(Point2::default(), |sum, p| sum + p);
            prop_assert!(point.distance(spline.at(u)) < 1e-9);
        }

        #[test]
        fn begins_and_ends_with_the_first_and_the_last_leg(points in points(2..9)) {
            let spline = BSpline::new(points.clone()).unwrap();
            let (first, last) = (0.0, spline.n_pieces() as f64);
            let n = points.len();
            prop_assert!(spline.at(first).distance(points[0]) < 1e-12);
            prop_assert!(spline.at(last).distance(points[n - 1]) < 1e-12);
            let degree = spline.degree() as f64;
            let legs = [points[1] - points[0], points[n - 1] - points[n - 2]];
            for (leg, u) in legs.into_iter().zip([first, last]) {
                prop_assert!(spline.derivative(u).distance(leg * degree) < 1e-9);
            }
        }

        #[test]
        fn stays_within_the_bounds_of_four_points_and_its_derivative_is_its_slope(
            points in points(4..9),
            share in 0.01..0.99,
            heading in -3.0..3.0,
        ) {
            let spline = BSpline::new(points.clone()).unwrap();
            let u = share * spline.n_pieces() as f64;
            // In any direction the spline reaches no farther than the four points do.
            let (piece, along) = (spline.piece(u), Point2::unit(heading));
            let reach = points[piece..piece + 4].iter().map(|p| p.dot(along));
            prop_assert!(spline.at(u).dot(along) <= reach.fold(f64::NEG_INFINITY, f64::max) + 1e-9);
            let h = 1e-6;
            let slope = (spline.at(u + h) - spline.at(u - h)) * (0.5 / h);
            prop_assert!(slope.distance(spline.derivative(u)) < 1e-3);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(ProptestConfig::default().cases / 5))]

        #[test]
        fn its_arcs_join_without_kinks_and_stay_within_the_tolerance(
            turns in prop::collection::vec((-1.5..1.5, 0.5..15.0), 2..9),
        ) {
            let mut at = Pose2::default();
            let mut points = vec![at.position()];
            for (turn, length_m) in turns {
                at = Pose2 { heading: at.heading + turn, ..at }.advance(0.0, length_m);
                points.push(at.position());
            }
            let spline = BSpline::new(points.clone()).unwrap();
            let arcs = spline.arcs(1e-3);
            for w in arcs.windows(2) {
                let (end, next) = (w[0].1.end_from(w[0].0), w[1].0);
                prop_assert!(end.position().distance(next.position()) < 1e-9);
                prop_assert!(angle_difference(end.heading, next.heading).abs() < 1e-6);
            }
            let (start, (last, arc)) = (arcs[0].0, arcs[arcs.len() - 1]);
            prop_assert!(start.position().distance(points[0]) < 1e-9);
            prop_assert!(angle_difference(start.heading, (points[1] - points[0]).angle()).abs() < 1e-9);
            prop_assert!(arc.end_from(last).position().distance(points[points.len() - 1]) < 1e-9);
            for i in 0..=2000 {
                let point = spline.at(f64::from(i) / 2000.0 * spline.n_pieces() as f64);
                let off_m = arcs.iter().map(|(start, arc)| {
                    arc.nearest_from(*start, point).position().distance(point)
                });
                prop_assert!(off_m.fold(f64::INFINITY, f64::min) <= 1e-3);
            }
        }
    }

    #[test]
    fn few_points_and_points_on_a_line_are_no_trouble() {
        assert_eq!(BSpline::new(Vec::new()), None);
        let at = |xs: &[f64]| {
            let points = xs.iter().map(|&x| Point2::new(x, 0.0)).collect();
            BSpline::new(points).unwrap().arcs(1e-3)
        };
        assert_eq!(at(&[1.0]), []);
        assert_eq!(at(&[1.0, 1.0, 1.0, 1.0]), []);
        for xs in [
            &[0.0, 3.0][..],
            &[0.0, 1.0, 3.0],
            &[0.0, 0.0, 1.0, 1.0, 2.0, 3.0],
        ] {
            let length_m: f64 = at(xs).iter().map(|(_, arc)| arc.length_m()).sum();
            assert!((length_m - 3.0).abs() < 1e-9, "{xs:?}: {length_m}");
        }
        // There and back: the spline turns around at a cusp.
        let arcs = at(&[0.0, 4.0, 4.0, 0.0]);
        assert!(
            arcs.iter()
                .all(|(start, arc)| start.is_finite() && arc.length_m().is_finite())
        );
    }
}
