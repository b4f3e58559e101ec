//! Foreign paths: from bare poses or points back to arcs and gears, so that the judge can rule.
//!
//! The judge rules on lines and arcs; other planners hand out samples. This is how the curve
//! between the samples is read:
//!
//! *Poses with headings.* Between two consecutive poses the vehicle moves forward if the step
//! points along its headings (`step . (h0 + h1) >= 0`), else in reverse. The motion is a biarc:
//! two arcs with a common tangent that leave the first pose and meet the second exactly. Biarcs
//! between two poses form a family with one parameter; the one whose larger curvature is least is
//! taken, so that a path of lines and arcs is never read as more curved than it is. Where one arc
//! joins the poses, both halves are that arc. A step that no such curve joins (the vehicle moves
//! sideways, or turns by a right angle within a step) becomes a straight line along the step:
//! its joints are then discontinuous, which the judge reports. A turn on the spot likewise stays
//! a jump of the heading between two segments.
//!
//! *Points without headings.* A turn of more than 90 degrees between two steps is a cusp: there the
//! gear changes; the first gear is the caller's to say. Between cusps the direction of motion at a
//! point is the tangent of the circle through three consecutive points. Of the circles in which the
//! point comes last, in the middle or first, the one whose curvature agrees best with its
//! neighbors counts: beside a joint of two arcs this picks the circle that lies on one arc. Where
//! none of the three agrees (arcs shorter than three steps, noise), directions are chosen that keep
//! the biarcs around them as flat as they can be. At a cusp the headings before and after it are
//! averaged.
//!
//! *Rounded files.* Samples printed with few decimals zigzag by half a unit of the last one, and
//! an exact curve through them would be curved beyond any steering limit. So a biarc reaches over
//! as many samples as it passes within that rounding, half a unit of the last decimal.

use super::tangents::{run_end, tangents};
use crate::geometry::{Arc, Point2, Pose2, angle_difference, flattest_biarc, wrap_angle};
use crate::path::{CurvePath, CurveSegment, Direction};
use std::f64::consts::{PI, SQRT_2};

/// Share by which the curvature of a reconstructed path may exceed the vehicle's limit: samples
/// do not tell the curvature between them exactly.
pub const FOREIGN_CURVATURE_SLACK: f64 = 0.05;

/// The arcs and gears through poses with headings; empty without poses.
///
/// ```
/// use formicar::Pose2;
/// use formicar::validation::path_through_poses;
///
/// // Samples of a circle of radius 5 m become arcs again.
/// let samples: Vec<_> = (0..20).map(|i| Pose2::default().advance(0.2, 0.3 * f64::from(i))).collect();
/// let path = path_through_poses(&samples, 0.0).unwrap();
/// assert!((path.segments()[0].curvature_per_m - 0.2).abs() < 1e-6);
/// ```
pub fn path_through_poses(poses: &[Pose2], rounding_m: f64) -> Option<CurvePath> {
    let gears: Vec<_> = poses.windows(2).map(|w| gear(w[0], w[1])).collect();
    path_through(poses, &gears, rounding_m)
}

/// The arcs and gears through points without headings, which do not tell the first gear.
pub fn path_through_points(
    points: &[Point2],
    first_gear: Direction,
    rounding_m: f64,
) -> Option<CurvePath> {
    let mut points = points.to_vec();
    points.dedup();
    let n_steps = points.len().checked_sub(1)?;
    if n_steps == 0 {
        return Some(CurvePath::new(Pose2::at(points[0], 0.0)));
    }
    let mut headings = vec![0.0; points.len()];
    let mut gears = vec![Direction::Forward; n_steps];
    let mut direction = first_gear;
    let mut first = 0;
    while first < n_steps {
        let last = run_end(&points, first);
        gears[first..last].fill(direction);
        let turn = match direction {
            Direction::Forward => 0.0,
            Direction::Reverse => PI,
        };
        for (i, tangent) in tangents(&points[first..=last]).into_iter().enumerate() {
            let heading = wrap_angle(tangent + turn);
            let at_cusp = i == 0 && first > 0;
            headings[first + i] = if at_cusp {
                let before = headings[first];
                wrap_angle(before + 0.5 * angle_difference(heading, before))
            } else {
                heading
            };
        }
        first = last;
        direction = other(direction);
    }
    let poses: Vec<_> = points
        .iter()
        .zip(headings)
        .map(|(&point, heading)| Pose2::at(point, heading))
        .collect();
    path_through(&poses, &gears, rounding_m)
}

fn other(direction: Direction) -> Direction {
    match direction {
        Direction::Forward => Direction::Reverse,
        Direction::Reverse => Direction::Forward,
    }
}

fn gear(from: Pose2, to: Pose2) -> Direction {
    let step = to.position() - from.position();
    let ahead = Point2::unit(from.heading) + Point2::unit(to.heading);
    if step.dot(ahead) >= 0.0 {
        Direction::Forward
    } else {
        Direction::Reverse
    }
}

fn path_through(poses: &[Pose2], gears: &[Direction], rounding_m: f64) -> Option<CurvePath> {
    let start = *poses.first()?;
    let mut segments = Vec::new();
    let mut from = 0;
    while from + 1 < poses.len() {
        let (to, curve) = reach(&poses[from..], &gears[from..], rounding_m);
        segments.extend(curve);
        from += to;
    }
    Some(CurvePath::from_segments(start, segments))
}

/// The most steps that one biarc may reach over.
const MAX_REACH: usize = 64;

/// Rounding that does not disturb curvatures, meters: every step gets its own biarc.
const NEGLIGIBLE_ROUNDING_M: f64 = 1e-7;

/// The farthest pose that one curve from the first reaches, and the curve.
fn reach(poses: &[Pose2], gears: &[Direction], rounding_m: f64) -> (usize, Vec<CurveSegment>) {
    let to = |i: usize| between(poses[0], poses[i], gears[0]);
    if rounding_m <= NEGLIGIBLE_ROUNDING_M {
        return (1, to(1));
    }
    let n_same_gear = gears.iter().take_while(|&&gear| gear == gears[0]).count();
    let passing = |i: usize| {
        let curve = to(i);
        passes(&curve, &poses[1..i], rounding_m).then_some((i, curve))
    };
    let longest = (2..=n_same_gear.min(MAX_REACH)).rev().find_map(passing);
    let (i, curve) = longest.unwrap_or_else(|| (1, to(1)));
    // A short rest before a cusp would be all rounding: the last two curves share alike.
    let half = n_same_gear.div_ceil(2);
    if half < i && i < n_same_gear {
        return passing(half).unwrap_or((i, curve));
    }
    (i, curve)
}

/// The segments of a step: a biarc, one arc where both halves are the same, or a line that
/// joins neither heading.
fn between(from: Pose2, to: Pose2, direction: Direction) -> Vec<CurveSegment> {
    let step = to.position() - from.position();
    let length_m = step.norm();
    if length_m == 0.0 {
        return Vec::new();
    }
    let tangents = [from, to].map(|pose| Point2::unit(pose.heading) * direction.sign());
    let Some([first, second]) = flattest_biarc(step, tangents) else {
        let against = match direction {
            Direction::Forward => 0.0,
            Direction::Reverse => PI,
        };
        return vec![CurveSegment {
            start: Pose2::at(from.position(), wrap_angle(step.angle() + against)),
            curvature_per_m: 0.0,
            curvature_rate_per_m2: 0.0,
            length_m,
            direction,
        }];
    };
    let segment = |start, arc: Arc| CurveSegment {
        start,
        // The heading turns by direction * curvature * length, with the direction of motion.
        curvature_per_m: arc.curvature_per_m * direction.sign(),
        curvature_rate_per_m2: 0.0,
        length_m: arc.length_m(),
        direction,
    };
    let one = segment(from, first);
    vec![one, segment(one.end(), second)]
}

/// The largest distance between a curve and a sample: both coordinates are rounded, at the sample
/// and at the ends of the curve.
pub(super) fn deviation_m(rounding_m: f64) -> f64 {
    if rounding_m <= NEGLIGIBLE_ROUNDING_M {
        return 0.0;
    }
    2.0 * SQRT_2 * rounding_m
}

/// True if a curve passes all poses within the rounding of their file.
fn passes(curve: &[CurveSegment], poses: &[Pose2], rounding_m: f64) -> bool {
    let off_m = deviation_m(rounding_m);
    let length_m: f64 = curve.iter().map(|segment| segment.length_m).sum();
    // Headings are rounded alike, and a step between rounded points points elsewhere.
    let off_rad = 2.0 * rounding_m + 2.0 * off_m * (poses.len() + 1) as f64 / length_m;
    poses.iter().all(|pose| {
        curve.iter().any(|segment| {
            let at = nearest_on(segment, pose.position());
            at.position().distance(pose.position()) <= off_m
                && angle_difference(at.heading, pose.heading).abs() <= off_rad
        })
    })
}

/// The pose on a segment that is nearest to a point.
fn nearest_on(segment: &CurveSegment, point: Point2) -> Pose2 {
    let signed_length_m = segment.direction.sign() * segment.length_m;
    Arc::new(segment.curvature_per_m, signed_length_m).nearest_from(segment.start, point)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::f64::consts::FRAC_PI_2;

    /// Left, straight, right, then back in reverse to the left.
    fn known() -> CurvePath {
        let mut path = CurvePath::new(Pose2::new(3.0, -2.0, 2.5));
        path.push(0.8, 1.3, Direction::Forward);
        path.push(0.0, 1.04, Direction::Forward);
        path.push(-0.5, 2.0, Direction::Forward);
        path.push(0.7, 1.1, Direction::Reverse);
        path.push(0.0, 0.7, Direction::Reverse);
        path
    }

    fn poses(path: &CurvePath) -> Vec<Pose2> {
        path.sample(0.1).iter().map(|p| p.pose.wrapped()).collect()
    }

    fn points(path: &CurvePath) -> Vec<Point2> {
        poses(path).iter().map(|p| p.position()).collect()
    }

    /// Every arc length driven so far has the curvature and gear that it should have.
    fn assert_same(found: &CurvePath, path: &CurvePath, tolerance: f64) {
        assert!((found.length_m() - path.length_m()).abs() < tolerance);
        let truth = path.sample(0.01);
        for (found, truth) in found.sample(0.013).iter().map(|p| {
            let at = truth
                .partition_point(|t| t.s_m < p.s_m)
                .min(truth.len() - 1);
            (p, truth[at])
        }) {
            assert!(found.pose.position().distance(truth.pose.position()) < 0.011);
            assert!(angle_difference(found.pose.heading, truth.pose.heading).abs() < 0.02);
        }
        for segment in found.segments() {
            let middle = segment.pose_at(0.5 * segment.length_m).position();
            let known = path.segments().iter().find(|known| {
                let same_gear = known.direction == segment.direction;
                let off_m = nearest_on(known, middle).position().distance(middle);
                same_gear
                    && off_m < tolerance
                    && (known.curvature_per_m - segment.curvature_per_m).abs() < tolerance
            });
            assert!(known.is_some(), "{segment:?}");
        }
    }

    fn assert_joined(path: &CurvePath) {
        for w in path.segments().windows(2) {
            assert!(w[0].end().position().distance(w[1].start.position()) < 1e-9);
            assert!(angle_difference(w[0].end().heading, w[1].start.heading).abs() < 1e-9);
        }
    }

    fn largest_curvature(path: &CurvePath) -> f64 {
        let bends = path.segments().iter().map(|s| s.curvature_per_m.abs());
        bends.fold(0.0, f64::max)
    }

    #[test]
    fn recovers_arcs_and_gears_from_poses() {
        let found = path_through_poses(&poses(&known()), 0.0).unwrap();
        assert_joined(&found);
        assert_same(&found, &known(), 1e-6);
    }

    #[test]
    fn recovers_arcs_and_gears_from_points() {
        let found = path_through_points(&points(&known()), Direction::Forward, 0.0).unwrap();
        assert_joined(&found);
        assert_same(&found, &known(), 1e-6);
    }

    #[test]
    fn samples_astride_a_joint_are_not_read_as_more_curved() {
        // Uniform samples that miss every joint but the cusp.
        let mut path = CurvePath::new(Pose2::default());
        path.push(0.0, 0.975, Direction::Forward);
        path.push(0.8, 1.013, Direction::Forward);
        path.push(-0.8, 1.012, Direction::Forward);
        let at = |s_m: f64| {
            let mut rest_m = s_m;
            let segment = path.segments().iter().find(|segment| {
                let here = rest_m <= segment.length_m;
                rest_m -= if here { 0.0 } else { segment.length_m };
                here
            });
            segment.unwrap().pose_at(rest_m)
        };
        let poses: Vec<_> = (0..30).map(|i| at(0.1 * f64::from(i))).collect();
        let found = path_through_poses(&poses, 0.0).unwrap();
        assert_joined(&found);
        assert!(
            largest_curvature(&found) <= 0.8 * 1.001,
            "{}",
            largest_curvature(&found)
        );
        let points: Vec<_> = poses.iter().map(|p| p.position()).collect();
        let found = path_through_points(&points, Direction::Forward, 0.0).unwrap();
        assert_joined(&found);
        assert!(
            largest_curvature(&found) <= 0.8 * 1.001,
            "{}",
            largest_curvature(&found)
        );
    }

    #[test]
    fn rounding_to_millimeters_stays_within_the_slack() {
        let round = |v: f64| (v * 1e3).round() / 1e3;
        let rounded: Vec<_> = poses(&known())
            .iter()
            .map(|p| Pose2::new(round(p.x), round(p.y), round(p.heading)))
            .collect();
        let found = path_through_poses(&rounded, 0.0005).unwrap();
        assert_joined(&found);
        assert!(
            largest_curvature(&found) <= 0.8 * 1.05,
            "{}",
            largest_curvature(&found)
        );
    }

    #[test]
    fn sideways_steps_and_turns_on_the_spot_stay_jumps() {
        let sideways = [Pose2::default(), Pose2::new(0.0, 0.1, 0.0)];
        let path = path_through_poses(&sideways, 0.0).unwrap();
        assert!((path.segments()[0].start.heading - FRAC_PI_2).abs() < 1e-12);
        let spin = [
            Pose2::default(),
            Pose2::new(1.0, 0.0, 0.0),
            Pose2::new(1.0, 0.0, 1.0),
            Pose2::new(1.0 + 1_f64.cos(), 1_f64.sin(), 1.0),
        ];
        let path = path_through_poses(&spin, 0.0).unwrap();
        let jump = |w: &[CurveSegment]| (w[1].start.heading - w[0].end().heading).abs();
        assert!(
            path.segments()
                .windows(2)
                .any(|w| (jump(w) - 1.0).abs() < 1e-9)
        );
    }

    #[test]
    fn few_samples_are_no_trouble() {
        assert_eq!(path_through_points(&[], Direction::Forward, 0.0), None);
        assert_eq!(path_through_poses(&[], 0.0), None);
        let p = Point2::new(1.0, 2.0);
        assert_eq!(
            path_through_points(&[p, p, p], Direction::Forward, 0.0)
                .unwrap()
                .length_m(),
            0.0
        );
        assert_eq!(
            path_through_poses(&[Pose2::at(p, 1.0)], 0.0)
                .unwrap()
                .end()
                .heading,
            1.0
        );
        let line =
            path_through_points(&[p, Point2::new(2.0, 2.0)], Direction::Forward, 0.0).unwrap();
        assert!((line.length_m() - 1.0).abs() < 1e-12);
        let there_and_back = [p, Point2::new(2.0, 2.0), p];
        let path = path_through_points(&there_and_back, Direction::Forward, 0.0).unwrap();
        assert_eq!(
            path.segments().last().unwrap().direction,
            Direction::Reverse
        );
        assert!(path.end().position().distance(p) < 1e-12);
    }

    proptest! {
        #[test]
        fn no_path_is_read_as_more_curved_than_it_is(
            motions in prop::collection::vec((0..3_i8, 0.25..2.0, prop::bool::weighted(0.2)), 1..8),
            heading in -3.0..3.0,
        ) {
            let mut path = CurvePath::new(Pose2::new(1.0, 2.0, heading));
            let mut gear = Direction::Forward;
            for (bend, length_m, changes_gear) in motions {
                gear = if changes_gear { other(gear) } else { gear };
                path.push(0.8 * f64::from(bend - 1), length_m, gear);
            }
            let from_poses = path_through_poses(&poses(&path), 0.0).unwrap();
            let from_points = path_through_points(&points(&path), Direction::Forward, 0.0).unwrap();
            for found in [from_poses, from_points] {
                assert_joined(&found);
                prop_assert!(largest_curvature(&found) <= 0.8 * 1.001);
                prop_assert!((found.length_m() - path.length_m()).abs() < 0.01);
            }
        }
    }
}
