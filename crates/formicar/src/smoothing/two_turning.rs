//! A corner rounded by two arcs of the turning radius (Lei & Zheng 2020, sec. III.B).

use crate::geometry::{Arc, Point2};
use std::f64::consts::PI;

/// The order of the two turns.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TurnOrder {
    /// The collision-avoidance turn by alpha, then the resuming turn by beta, as in the paper.
    #[default]
    AvoidFirst,
    /// The same seen from the other end: swings out by beta, then turns by alpha.
    SwingFirst,
}

/// A corner of a polyline rounded by two arcs of one radius with opposite turns.
///
/// Lei 2020, sec. III.B and Fig. 8: the first arc is tangent to the segment before the corner at
/// `S1`, the second to the first at `S2` and to the segment after the corner at `S3`. The turns
/// are alpha towards the corner's side and beta back, alpha - beta = g, the corner's angle. The
/// paper draws one such pair; all of them form a family with beta as its parameter, of which
/// beta = 0 is the plain fillet. Larger beta keeps nearer to the corner and overshoots the segment
/// after it (or, swinging out first, the one before it).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoTurning {
    /// The order of the turns.
    pub order: TurnOrder,
    /// The corner's angle, positive left, in (-pi, pi) without 0.
    pub turn_rad: f64,
    /// Radius of both arcs, meters.
    pub radius_m: f64,
    /// The turn towards the corner's side, at least the corner's angle; it may exceed pi.
    pub alpha_rad: f64,
    /// The turn back, from 0 to [`Self::max_beta_rad`].
    pub beta_rad: f64,
    /// From `S1` to the corner, meters.
    pub before_m: f64,
    /// From the corner to `S3`, meters.
    pub after_m: f64,
}

impl TwoTurning {
    /// The member with a resuming turn of `beta_rad` at a corner that turns by `turn_rad`
    /// (positive left).
    ///
    /// There is none if the path goes straight on or straight back, if the radius is not positive
    /// and finite, or if beta is not between 0 and [`Self::max_beta_rad`].
    pub fn new(turn_rad: f64, radius_m: f64, order: TurnOrder, beta_rad: f64) -> Option<Self> {
        let g = turn_rad.abs();
        let is_corner = g > 0.0 && g < PI && radius_m > 0.0 && radius_m.is_finite();
        if !is_corner || !(0.0..=Self::max_beta_rad(turn_rad)).contains(&beta_rad) {
            return None;
        }
        // a = R (2 cos beta - 1 - cos g) / sin g, in half angles, which lose no digits.
        let sagitta = (0.5 * beta_rad).sin().powi(2);
        let a = (radius_m * ((0.5 * g).tan() - 4.0 * sagitta / g.sin())).max(0.0);
        let b = radius_m * (g.sin() + 2.0 * beta_rad.sin()) - a * g.cos();
        let (before_m, after_m) = match order {
            TurnOrder::AvoidFirst => (a, b),
            TurnOrder::SwingFirst => (b, a),
        };
        Some(Self {
            order,
            turn_rad,
            radius_m,
            alpha_rad: g + beta_rad,
            beta_rad,
            before_m,
            after_m,
        })
    }

    /// The largest beta: the turn begins (or ends) at the corner itself.
    pub fn max_beta_rad(turn_rad: f64) -> f64 {
        (0.5 * (1.0 + turn_rad.cos())).clamp(0.0, 1.0).acos()
    }

    /// The beta of the member that stays nearest to the polyline: there the distance by which the
    /// corner is missed equals the one by which the segment is overshot.
    pub fn least_deviation_beta_rad(turn_rad: f64) -> f64 {
        // With c = cos beta, k = cos g, p = 1 + k, and R = 1:
        // (a^2 + 1) = (3 - 2c)^2 becomes 4 k^2 c^2 + 4 p (5 - 3p) c + p (9p - 16) = 0.
        let k = turn_rad.cos();
        let p = 1.0 + k;
        let (first, middle, last) = (4.0 * k * k, 4.0 * p * (5.0 - 3.0 * p), p * (9.0 * p - 16.0));
        let root = (middle * middle - 4.0 * first * last).max(0.0).sqrt();
        let cos = if middle > 0.0 {
            -2.0 * last / (middle + root)
        } else {
            (root - middle) / (2.0 * first)
        };
        let beta_rad = cos.clamp(0.0, 1.0).acos();
        beta_rad.min(Self::max_beta_rad(turn_rad))
    }

    /// Members of both orders: the two of least deviation, then `n_members` of each order spread
    /// evenly over beta from the plain fillet on, which stands among them once.
    pub fn family(turn_rad: f64, radius_m: f64, n_members: u32) -> Vec<Self> {
        let nearest = Self::least_deviation_beta_rad(turn_rad);
        let max_rad = Self::max_beta_rad(turn_rad);
        let step_rad = max_rad / f64::from(n_members.max(2) - 1);
        let spread = (0..n_members).map(|i| (step_rad * f64::from(i)).min(max_rad));
        let orders = [TurnOrder::AvoidFirst, TurnOrder::SwingFirst];
        std::iter::once(nearest)
            .chain(spread)
            .flat_map(|beta| orders.map(|order| (order, beta)))
            .filter(|&(order, beta)| beta > 0.0 || order == TurnOrder::AvoidFirst)
            .filter_map(|(order, beta)| Self::new(turn_rad, radius_m, order, beta))
            .collect()
    }

    /// The two arcs as they are driven forward from `S1`.
    pub fn arcs(&self) -> [Arc; 2] {
        let curvature = self.turn_rad.signum() / self.radius_m;
        let avoid = Arc::new(curvature, self.alpha_rad * self.radius_m);
        let resume = Arc::new(-curvature, self.beta_rad * self.radius_m);
        match self.order {
            TurnOrder::AvoidFirst => [avoid, resume],
            TurnOrder::SwingFirst => [resume, avoid],
        }
    }

    /// The centers of the arcs, with the corner at the origin, arriving along +x.
    pub fn centers(&self) -> [Point2; 2] {
        let out = Point2::unit(self.turn_rad);
        // The side of the first arc; the second has the other.
        let side = match self.order {
            TurnOrder::AvoidFirst => self.turn_rad.signum(),
            TurnOrder::SwingFirst => -self.turn_rad.signum(),
        };
        let first = Point2::new(-self.before_m, side * self.radius_m);
        let last = out * self.after_m - out.perpendicular() * (side * self.radius_m);
        [first, last]
    }

    /// Driven length, meters.
    pub fn length_m(&self) -> f64 {
        (self.alpha_rad + self.beta_rad) * self.radius_m
    }

    /// The Hausdorff distance between the arcs and the two segments that they replace, meters:
    /// the larger of the distance by which they miss the corner and the one by which they
    /// overshoot a segment.
    pub fn deviation_m(&self) -> f64 {
        let a = self.before_m.min(self.after_m);
        let missed = a * a / (a.hypot(self.radius_m) + self.radius_m);
        let overshot = 4.0 * self.radius_m * (0.5 * self.beta_rad).sin().powi(2);
        missed.max(overshot)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Pose2, angle_difference};
    use proptest::prelude::*;

    const ORDERS: [TurnOrder; 2] = [TurnOrder::AvoidFirst, TurnOrder::SwingFirst];

    fn first_pose(turning: &TwoTurning) -> Pose2 {
        Pose2::new(-turning.before_m, 0.0, 0.0)
    }

    /// Points along the arcs.
    fn driven(turning: &TwoTurning, n: u32) -> Vec<Point2> {
        let mut pose = first_pose(turning);
        let mut points = vec![pose.position()];
        for arc in turning.arcs() {
            let share = |i: u32| arc.signed_length_m * f64::from(i) / f64::from(n);
            points.extend((1..=n).map(|i| pose.advance(arc.curvature_per_m, share(i)).position()));
            pose = arc.end_from(pose);
        }
        points
    }

    /// Points along the segments that the arcs replace.
    fn replaced(turning: &TwoTurning, n: u32) -> Vec<Point2> {
        let corner = Point2::default();
        let ends = [
            Point2::new(-turning.before_m, 0.0),
            Point2::unit(turning.turn_rad) * turning.after_m,
        ];
        let on = |end: Point2| (0..=n).map(move |i| corner.lerp(end, f64::from(i) / f64::from(n)));
        ends.into_iter().flat_map(on).collect()
    }

    /// The largest distance from any of some points to the nearest of others.
    fn one_sided(from: &[Point2], to: &[Point2]) -> f64 {
        let nearest = |p: &Point2| to.iter().map(|q| p.distance(*q)).fold(f64::MAX, f64::min);
        from.iter().map(nearest).fold(0.0, f64::max)
    }

    proptest! {
        #[test]
        fn joins_both_segments_smoothly(
            g in 1e-4_f64..3.1,
            side in prop::bool::ANY,
            share in 0.0_f64..=1.0,
            radius_m in 0.2_f64..20.0,
            which in 0_usize..2,
        ) {
            let turn = if side { g } else { -g };
            let beta = share * TwoTurning::max_beta_rad(turn);
            let turning = TwoTurning::new(turn, radius_m, ORDERS[which], beta).unwrap();
            let close = 1e-9 * (radius_m + turning.before_m + turning.after_m);
            prop_assert!(turning.before_m >= 0.0 && turning.after_m >= 0.0);
            prop_assert!((turning.alpha_rad - turning.beta_rad - g).abs() < 1e-12);

            let [first, last] = turning.arcs();
            let s1 = first_pose(&turning);
            let s2 = first.end_from(s1);
            let s3 = last.end_from(s2);
            let out = Point2::unit(turn);
            prop_assert!(s3.position().distance(out * turning.after_m) < close);
            prop_assert!(angle_difference(s3.heading, turn).abs() < 1e-12);

            // Circles that touch have centers two radii apart and their common point midway.
            let [o1, o2] = turning.centers();
            prop_assert!((o1.distance(o2) - 2.0 * radius_m).abs() < close);
            prop_assert!(s2.position().distance(o1.lerp(o2, 0.5)) < close);
            for (center, pose) in [(o1, s1), (o2, s3), (o1, s2)] {
                let spoke = pose.position() - center;
                prop_assert!((spoke.norm() - radius_m).abs() < close);
                prop_assert!(spoke.dot(Point2::unit(pose.heading)).abs() < close);
            }
        }

        #[test]
        fn obeys_the_papers_lengths(g in 0.01_f64..3.1, share in 0.0_f64..=1.0, r in 0.2_f64..20.0) {
            let beta = share * TwoTurning::max_beta_rad(g);
            let turning = TwoTurning::new(g, r, TurnOrder::AvoidFirst, beta).unwrap();
            let a = r * (2.0 * beta.cos() - 1.0 - g.cos()) / g.sin();
            prop_assert!((turning.before_m - a).abs() < 1e-9 * (r + a));
            let b = r * g.sin() - a * g.cos() + 2.0 * r * beta.sin();
            prop_assert!((turning.after_m - b).abs() < 1e-9 * (r + a));
        }

        #[test]
        fn deviation_is_the_hausdorff_distance(g in 0.05_f64..2.8, share in 0.0_f64..=1.0, which in 0_usize..2) {
            let beta = share * TwoTurning::max_beta_rad(g);
            let turning = TwoTurning::new(-g, 1.0, ORDERS[which], beta).unwrap();
            let (arcs, segments) = (driven(&turning, 400), replaced(&turning, 400));
            let sampled = one_sided(&arcs, &segments).max(one_sided(&segments, &arcs));
            let spacing = (turning.length_m() + turning.before_m + turning.after_m) / 400.0;
            prop_assert!((turning.deviation_m() - sampled).abs() < spacing, "{} {sampled}", turning.deviation_m());
        }

        #[test]
        fn no_member_stays_nearer_than_the_first(g in 1e-3_f64..3.1, n in 1_u32..40) {
            let family = TwoTurning::family(g, 2.0, n);
            let least = family[0].deviation_m();
            prop_assert!(family.iter().all(|m| m.deviation_m() >= least - 1e-9), "{least}");
            prop_assert_eq!(family.iter().filter(|m| m.beta_rad == 0.0).count(), 1);
            prop_assert_eq!(family.len(), 2 * n as usize + 1);
        }
    }

    #[test]
    fn the_nearest_at_a_right_angle_is_not_the_fillet() {
        let radius_m = 2.0 / 40_f64.to_radians().tan();
        let family = TwoTurning::family(0.5 * PI, radius_m, 1);
        assert!((family[0].beta_rad.cos() - 0.875).abs() < 1e-12);
        assert!((family[0].deviation_m() - 0.25 * radius_m).abs() < 1e-12);
        let fillet = family[2];
        assert!((fillet.before_m - radius_m).abs() < 1e-12);
        assert!((fillet.after_m - radius_m).abs() < 1e-12);
        assert!((fillet.deviation_m() - 0.987_281).abs() < 1e-5);
    }

    #[test]
    fn refuses_what_is_no_corner() {
        let new = |turn, radius, beta| TwoTurning::new(turn, radius, TurnOrder::AvoidFirst, beta);
        for turn in [0.0, PI, -PI, f64::NAN, 4.0] {
            assert_eq!(new(turn, 1.0, 0.0), None);
        }
        for (radius, beta) in [(0.0, 0.0), (f64::INFINITY, 0.0), (1.0, -0.1), (1.0, 1.3)] {
            assert_eq!(new(1.0, radius, beta), None);
        }
    }
}
