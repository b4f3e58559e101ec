//! Curves between two poses whose arcs need not have one and the same radius.
//!
//! Dubins words are shortest at the least radius; where there is room, wider arcs change the
//! curvature by less.

use super::dubins::to_full_turn;
use super::{Arc, Curve, Point2, Pose2, angle_difference};

/// Headings that differ by less have no corner between them, radians.
const LEAST_CORNER_RAD: f64 = 1e-6;

/// Arc, line, arc between two poses: along a common tangent of a circle at each.
///
/// With a signed radius `r1`, positive to the left, the first circle's center is
/// `c1 = p1 + r1 n(h1)`. A tangent with heading h leads from `c1 - r1 n(h)` to `c2 - r2 n(h)`, so
/// that `c2 - c1 = length u(h) + (r2 - r1) n(h)`, whatever the sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tangents {
    /// The second pose's position in the frame of the first, and its left normal there.
    local: Point2,
    normal: Point2,
    turn_rad: f64,
}

impl Tangents {
    /// Looks at two poses.
    pub fn between(from: Pose2, to: Pose2) -> Self {
        let turn_rad = angle_difference(to.heading, from.heading);
        Self {
            local: from.relative(to).position(),
            normal: Point2::unit(turn_rad).perpendicular(),
            turn_rad,
        }
    }

    /// The curve with two signed radii in meters. None where the circles have no such tangent, or
    /// on bad numbers.
    pub fn curve(&self, [r1, r2]: [f64; 2]) -> Option<Curve> {
        let between = self.local + self.normal * r2 - Point2::new(0.0, r1);
        let apart = r2 - r1;
        let length2 = between.dot(between) - apart * apart;
        if !(length2 >= 0.0 && length2.is_finite() && r1 != 0.0 && r2 != 0.0) {
            return None;
        }
        let length_m = length2.sqrt();
        // The angle of (length, apart) turned into that of `between`, with one arc tangent.
        let along = length_m * between.x + apart * between.y;
        let across = length_m * between.y - apart * between.x;
        let heading_rad = across.atan2(along);
        let begin_rad = to_full_turn(r1.signum() * heading_rad);
        let end_rad = to_full_turn(r2.signum() * (self.turn_rad - heading_rad));
        Some(Curve::of_arcs([
            Arc::new(1.0 / r1, r1.abs() * begin_rad),
            Arc::new(0.0, length_m),
            Arc::new(1.0 / r2, r2.abs() * end_rad),
        ]))
    }
}

/// Line, arc, line: the corner where the poses' lines meet ahead of the first and behind the
/// second, rounded by an arc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// From the first pose to the corner, and from there to the second, meters.
    legs_m: [f64; 2],
    turn_rad: f64,
}

impl Corner {
    /// None where the lines meet elsewhere or not at all.
    pub fn between(from: Pose2, to: Pose2) -> Option<Self> {
        let local = from.relative(to);
        let turn_rad = angle_difference(to.heading, from.heading);
        let (sin, cos) = turn_rad.sin_cos();
        let second_m = local.y / sin;
        let first_m = local.x - second_m * cos;
        let is_ahead = turn_rad.abs() > LEAST_CORNER_RAD && first_m >= 0.0 && second_m >= 0.0;
        let is_number = first_m.is_finite() && second_m.is_finite();
        (is_ahead && is_number).then_some(Self {
            legs_m: [first_m, second_m],
            turn_rad,
        })
    }

    /// The radius of the widest arc that fits, meters: it leaves no line before or none behind.
    pub fn widest_m(&self) -> f64 {
        let [first_m, second_m] = self.legs_m;
        first_m.min(second_m) / (0.5 * self.turn_rad).tan().abs()
    }

    /// The corner with an arc of a radius in meters, which must be positive and at most
    /// [`Self::widest_m`].
    pub fn rounded(&self, radius_m: f64) -> Curve {
        let tangent_m = radius_m * (0.5 * self.turn_rad).tan().abs();
        let [first_m, second_m] = self.legs_m.map(|leg_m| (leg_m - tangent_m).max(0.0));
        let curvature_per_m = self.turn_rad.signum() / radius_m;
        Curve::of_arcs([
            Arc::new(0.0, first_m),
            Arc::new(curvature_per_m, radius_m * self.turn_rad.abs()),
            Arc::new(0.0, second_m),
        ])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::dubins;
    use proptest::prelude::*;

    fn pose() -> impl Strategy<Value = Pose2> {
        (-30.0..30.0, -30.0..30.0, -4.0..4.0).prop_map(|(x, y, h)| Pose2::new(x, y, h))
    }

    fn meets(curve: &Curve, from: Pose2, to: Pose2) -> bool {
        let end = curve.end_from(from);
        end.position().distance(to.position()) < 1e-9
            && angle_difference(end.heading, to.heading).abs() < 1e-9
            && curve.arcs().iter().all(|arc| arc.signed_length_m > 0.0)
    }

    proptest! {
        #[test]
        fn tangents_meet_the_goal(
            from in pose(),
            to in pose(),
            radii in prop::array::uniform2(0.5..20.0),
            sides in prop::array::uniform2(prop_oneof![Just(-1.0), Just(1.0)]),
        ) {
            let signed = [radii[0] * sides[0], radii[1] * sides[1]];
            if let Some(curve) = Tangents::between(from, to).curve(signed) {
                prop_assert!(meets(&curve, from, to), "{curve:?}");
            }
        }

        #[test]
        fn with_one_radius_they_are_words_of_dubins(from in pose(), to in pose()) {
            let words = dubins::candidates(from, to, 2.0);
            for signed in [[2.0, 2.0], [2.0, -2.0], [-2.0, 2.0], [-2.0, -2.0]] {
                if let Some(curve) = Tangents::between(from, to).curve(signed) {
                    let length_m = curve.length_m();
                    prop_assert!(words.iter().any(|w| (w.length_m() - length_m).abs() < 1e-9));
                }
            }
        }

        #[test]
        fn corners_meet_the_goal(from in pose(), to in pose(), share in 0.01..1.0) {
            if let Some(corner) = Corner::between(from, to) {
                let widest_m = corner.widest_m();
                prop_assert!(widest_m >= 0.0);
                if widest_m > 1e-3 {
                    prop_assert!(meets(&corner.rounded(share * widest_m), from, to));
                    prop_assert!(corner.rounded(widest_m).arcs().len() <= 2 || widest_m > 1e6
                        || corner.rounded(widest_m).arcs().iter().any(|a| a.length_m() < 1e-9));
                }
            }
        }
    }

    #[test]
    fn what_has_no_tangent_or_corner_gives_nothing() {
        let (from, near) = (Pose2::default(), Pose2::new(1.0, 0.0, 0.0));
        // Circles to the left of one and to the right of the other overlap.
        let beside = Pose2::new(1.0, 1.0, 0.0);
        assert_eq!(Tangents::between(from, beside).curve([2.0, -2.0]), None);
        assert_eq!(Tangents::between(from, near).curve([0.0, 1.0]), None);
        assert_eq!(
            Tangents::between(from, Pose2::new(f64::NAN, 0.0, 0.0)).curve([1.0, 1.0]),
            None
        );
        assert_eq!(Corner::between(from, near), None);
        assert_eq!(Corner::between(from, Pose2::new(3.0, -1.0, 1.0)), None);
        let corner = Corner::between(from, Pose2::new(3.0, 1.0, 1.5)).unwrap();
        assert!((corner.widest_m() - corner.legs_m[1] / 0.75_f64.tan()).abs() < 1e-12);
    }
}
