//! Biarcs: two arcs with a common tangent between two points with given directions.

use super::{Arc, Point2};
use crate::numeric::golden_section;

/// The biarc over `step` between two unit tangents whose larger curvature is least; none where the
/// step does not lead ahead along both.
///
/// Biarcs between two points with directions form a family with one parameter. Where one arc joins
/// the points, both halves are that arc.
pub fn flattest_biarc(step: Point2, [t0, t1]: [Point2; 2]) -> Option<[Arc; 2]> {
    let (ahead0, ahead1) = (step.dot(t0), step.dot(t1));
    if ahead0 <= 0.0 || ahead1 <= 0.0 {
        return None;
    }
    // The control polygon p0, p0 + d0 t0, p1 - d1 t1, p1 has a middle side of d0 + d1, so that
    // (step . step) / 2 = d0 (step . t0) + d1 (step . t1) + d0 d1 (1 - t0 . t1).
    let half_square = 0.5 * step.dot(step);
    let biarc = |share: f64| {
        let d0 = share * half_square / ahead0;
        let d1 = (half_square - d0 * ahead0) / (ahead1 + d0 * (1.0 - t0.dot(t1)));
        let joint = (t0 * d0) + (step - t0 * d0 - t1 * d1) * (d0 / (d0 + d1));
        let rest = step - joint;
        let first = over(joint.norm(), t0.cross(joint).atan2(t0.dot(joint)));
        let second = over(rest.norm(), rest.cross(t1).atan2(rest.dot(t1)));
        [first, second]
    };
    let bend = |share| {
        let [first, second]: [Arc; 2] = biarc(share);
        first
            .curvature_per_m
            .abs()
            .max(second.curvature_per_m.abs())
    };
    Some(biarc(least(bend)))
}

/// The arc over a chord that leaves it by an angle (counter-clockwise from tangent to chord).
fn over(chord_m: f64, angle: f64) -> Arc {
    let sinc = if angle.abs() < 1e-6 {
        1.0 - angle * angle / 6.0
    } else {
        angle.sin() / angle
    };
    Arc::new(2.0 * angle.sin() / chord_m, chord_m / sinc)
}

/// The place in (0, 1) where a function is least: the best of a grid, then golden sections around
/// it.
fn least(value: impl Fn(f64) -> f64) -> f64 {
    const N_GRID: u32 = 16;
    const N_SECTIONS: u32 = 40;
    let at = |i: u32| f64::from(i) / f64::from(N_GRID);
    let best = (1..N_GRID)
        .min_by(|&a, &b| value(at(a)).total_cmp(&value(at(b))))
        .unwrap_or(N_GRID / 2);
    // An end of the interval is a biarc without its first or second arc.
    let (low, high) = (at(best - 1).max(1e-6), at(best + 1).min(1.0 - 1e-6));
    golden_section(value, [low, high], N_SECTIONS)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Pose2, angle_difference};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn meets_both_ends_with_their_directions(
            angles in prop::array::uniform2(-1.5_f64..1.5),
            heading in -3.0_f64..3.0,
            length_m in 0.01_f64..50.0,
        ) {
            let step = Point2::unit(heading) * length_m;
            let [from, to] = angles.map(|angle| heading + angle);
            let arcs = flattest_biarc(step, [from, to].map(Point2::unit)).unwrap();
            let end = arcs.iter().fold(Pose2::new(0.0, 0.0, from), |pose, arc| arc.end_from(pose));
            prop_assert!(end.position().distance(step) < 1e-9 * length_m);
            prop_assert!(angle_difference(end.heading, to).abs() < 1e-9);
        }
    }

    #[test]
    fn an_arc_is_its_own_biarc_and_no_curve_leads_back() {
        let end = Pose2::default().advance(0.5, 2.0);
        let tangents = [0.0, end.heading].map(Point2::unit);
        let arcs = flattest_biarc(end.position(), tangents).unwrap();
        assert!(
            arcs.iter()
                .all(|arc| (arc.curvature_per_m - 0.5).abs() < 1e-9)
        );
        let behind = [2.0, 0.0].map(Point2::unit);
        assert_eq!(flattest_biarc(Point2::new(1.0, 0.0), behind), None);
    }
}
