//! Dubins and Reeds-Shepp curves against another crate, their symmetries and brute force.

use dubins_paths::f64::{DubinsPath, PosRot};
use formicar::geometry::{Curve, Pose2, angle_difference, dubins, reeds_shepp};
use formicar::numeric::{RandomStream, Seed};
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_4, PI};

fn random_pose(random: &mut RandomStream, reach_m: f64) -> Pose2 {
    Pose2::new(
        random.range(-reach_m, reach_m),
        random.range(-reach_m, reach_m),
        random.range(-PI, PI),
    )
}

/// How far the curve's end is from where it should be, as a share of the scale.
fn end_error(curve: &Curve, from: Pose2, to: Pose2, radius_m: f64) -> f64 {
    let end = curve.end_from(from);
    let scale = [1.0, radius_m, from.x, from.y, to.x, to.y, to.heading]
        .into_iter()
        .fold(from.heading.abs(), |scale, x| scale.max(x.abs()));
    let gap = end.position().distance(to.position());
    gap.max(angle_difference(end.heading, to.heading).abs()) / scale
}

fn check_all(from: Pose2, to: Pose2, radius_m: f64) {
    let all_of = [
        (
            dubins::candidates(from, to, radius_m),
            dubins::shortest(from, to, radius_m).expect("finite numbers"),
            dubins::distance(from, to, radius_m).expect("finite numbers"),
        ),
        (
            reeds_shepp::candidates(from, to, radius_m),
            reeds_shepp::shortest(from, to, radius_m).expect("finite numbers"),
            reeds_shepp::distance(from, to, radius_m).expect("finite numbers"),
        ),
    ];
    for (candidates, shortest, distance) in all_of {
        let tolerance = 1e-9 * radius_m.max(1.0).max(distance);
        assert!((shortest.length_m() - distance).abs() < tolerance);
        assert!((candidates[0].length_m() - distance).abs() < tolerance);
        for curve in candidates.iter().chain([&shortest]) {
            let error = end_error(curve, from, to, radius_m);
            assert!(error < 1e-9, "{error} {from:?} {to:?} {radius_m} {curve:?}");
            let turns = curve
                .arcs()
                .iter()
                .map(|a| (a.signed_length_m * a.curvature_per_m).abs());
            assert!(
                turns.clone().all(|turn| turn < 2.0 * PI - 1e-13),
                "{curve:?}"
            );
        }
        assert!(candidates.is_sorted_by(|a, b| a.length_m() <= b.length_m()));
    }
}

/// Headings and offsets at which words degenerate: multiples of an eighth of a turn and of the
/// radius, exact or off by little.
fn awkward_pose() -> impl Strategy<Value = Pose2> {
    let nudge = prop_oneof![
        Just(0.0),
        Just(1e-16),
        Just(-1e-15),
        Just(3e-13),
        Just(-1e-11),
        Just(1e-8)
    ];
    (
        -8..=8,
        -8..=8,
        -8..=8,
        [nudge.clone(), nudge.clone(), nudge],
    )
        .prop_map(|(x, y, heading, [dx, dy, turn])| {
            Pose2::new(
                0.5 * f64::from(x) + dx,
                0.5 * f64::from(y) + dy,
                FRAC_PI_4 * f64::from(heading) + turn,
            )
        })
}

fn any_pose() -> impl Strategy<Value = Pose2> {
    let reach = prop_oneof![Just(1e-9), Just(1e-3), Just(5.0), Just(1e3), Just(1e8)];
    (reach, -1.0..1.0, -1.0..1.0, -20.0..20.0)
        .prop_map(|(reach, x, y, heading)| Pose2::new(reach * x, reach * y, heading))
}

proptest! {
    #[test]
    fn curves_end_where_they_should(
        from in any_pose(), to in any_pose(), radius_m in 0.01..100.0
    ) {
        check_all(from, to, radius_m);
    }

    #[test]
    fn curves_end_where_they_should_in_awkward_places(
        from in awkward_pose(), to in awkward_pose(), radius_m in prop_oneof![Just(0.5), Just(1.0)]
    ) {
        check_all(from, to, radius_m);
        check_all(from, from.advance(1.0 / radius_m, to.x), radius_m);
        check_all(from, from.advance(0.0, to.y), radius_m);
    }
}

#[test]
fn dubins_lengths_are_those_of_another_crate() {
    let mut random = Seed(1).stream([0, 0]);
    for i in 0..20_000 {
        let reach_m = [1.0, 4.0, 30.0][i % 3];
        let (a, b) = (
            random_pose(&mut random, reach_m),
            random_pose(&mut random, reach_m),
        );
        let radius_m = random.range(0.3, 3.0);
        let rotation = |p: Pose2| PosRot::from_floats(p.x, p.y, p.heading);
        let other = DubinsPath::shortest_from(rotation(a), rotation(b), radius_m).unwrap();
        let ours = dubins::distance(a, b, radius_m).unwrap();
        assert!(
            (ours - other.length()).abs() < 1e-8,
            "{a:?} {b:?} {radius_m}"
        );
    }
}

/// A random chain of at most five arcs within the radius; its length and its end.
fn random_drive(random: &mut RandomStream, reverse_share: f64) -> (f64, Pose2) {
    let curvatures = [-1.0, 0.0, 1.0, -1.0, 1.0, random.range(-1.0, 1.0)];
    let n_arcs = 1 + random.below(Curve::MAX_ARCS);
    let mut driven = (0.0, Pose2::default());
    for _ in 0..n_arcs {
        let curvature = curvatures[random.below(curvatures.len())];
        let sign = if random.unit() < reverse_share {
            -1.0
        } else {
            1.0
        };
        let length = random.range(0.0, 3.0);
        driven.0 += length;
        driven.1 = driven.1.advance(curvature, sign * length);
    }
    driven
}

#[test]
fn no_random_drive_is_shorter() {
    let mut random = Seed(2).stream([0, 0]);
    for _ in 0..200_000 {
        let (length, end) = random_drive(&mut random, 0.0);
        let shortest = dubins::distance(Pose2::default(), end, 1.0).unwrap();
        assert!(shortest <= length + 1e-9, "{end:?}: {shortest} > {length}");
        let (length, end) = random_drive(&mut random, 0.5);
        let shortest = reeds_shepp::distance(Pose2::default(), end, 1.0).unwrap();
        assert!(shortest <= length + 1e-9, "{end:?}: {shortest} > {length}");
    }
}

#[test]
fn distances_are_ordered_and_obey_the_triangle() {
    let mut random = Seed(3).stream([0, 0]);
    for _ in 0..50_000 {
        let [a, b, c] = [(); 3].map(|()| random_pose(&mut random, 4.0));
        let (forward, both) = (
            |p, q| dubins::distance(p, q, 1.0).unwrap(),
            |p, q| reeds_shepp::distance(p, q, 1.0).unwrap(),
        );
        let straight = a.position().distance(b.position());
        assert!(straight <= both(a, b) + 1e-9);
        assert!(both(a, b) <= forward(a, b) + 1e-9);
        assert!(both(a, c) <= both(a, b) + both(b, c) + 1e-9);
        assert!(forward(a, c) <= forward(a, b) + forward(b, c) + 1e-9);
    }
}

#[test]
fn symmetric_tasks_have_equal_lengths() {
    let mut random = Seed(4).stream([0, 0]);
    let mirrored = |p: Pose2| Pose2::new(p.x, -p.y, -p.heading);
    let turned = |p: Pose2| Pose2::new(p.x, p.y, p.heading + PI);
    for _ in 0..20_000 {
        let (a, b) = (random_pose(&mut random, 4.0), random_pose(&mut random, 4.0));
        let forward = |p, q| dubins::distance(p, q, 1.0).unwrap();
        let both = |p, q| reeds_shepp::distance(p, q, 1.0).unwrap();
        assert!((forward(a, b) - forward(mirrored(a), mirrored(b))).abs() < 1e-8);
        assert!((forward(a, b) - forward(turned(b), turned(a))).abs() < 1e-8);
        assert!((both(a, b) - both(mirrored(a), mirrored(b))).abs() < 1e-8);
        assert!((both(a, b) - both(turned(a), turned(b))).abs() < 1e-8);
        assert!((both(a, b) - both(b, a)).abs() < 1e-8);
    }
}

/// A part of a shortest curve is a shortest curve.
#[test]
fn shortest_curves_consist_of_shortest_curves() {
    let mut random = Seed(6).stream([0, 0]);
    for _ in 0..20_000 {
        let goal = random_pose(&mut random, 4.0);
        for (shortest, distance) in [
            (
                dubins::shortest as fn(_, _, _) -> _,
                dubins::distance as fn(_, _, _) -> _,
            ),
            (reeds_shepp::shortest, reeds_shepp::distance),
        ] {
            let curve: Curve = shortest(Pose2::default(), goal, 1.0).unwrap();
            let (mut driven, mut pose) = (0.0, Pose2::default());
            for arc in curve.arcs() {
                let share = random.unit();
                let cut = pose.advance(arc.curvature_per_m, share * arc.signed_length_m);
                let to_cut: f64 = distance(Pose2::default(), cut, 1.0).unwrap();
                let from_cut: f64 = distance(cut, goal, 1.0).unwrap();
                let rest = curve.length_m() - driven - share * arc.length_m();
                assert!((to_cut - driven - share * arc.length_m()).abs() < 1e-8);
                assert!((from_cut - rest).abs() < 1e-8);
                driven += arc.length_m();
                pose = arc.end_from(pose);
            }
        }
    }
}

#[test]
fn every_family_is_the_shortest_somewhere() {
    let mut random = Seed(5).stream([0, 0]);
    let mut n_by_shape = std::collections::BTreeMap::new();
    for _ in 0..100_000 {
        let goal = random_pose(&mut random, 5.0);
        let curve = reeds_shepp::shortest(Pose2::default(), goal, 1.0).unwrap();
        let shape: String = curve
            .arcs()
            .iter()
            .map(|a| if a.curvature_per_m == 0.0 { 's' } else { 'c' })
            .collect();
        *n_by_shape.entry(shape).or_insert(0) += 1;
    }
    for shape in ["csc", "ccc", "cccc", "ccsc", "cscc", "ccscc"] {
        assert!(n_by_shape.contains_key(shape), "{shape}: {n_by_shape:?}");
    }
}
