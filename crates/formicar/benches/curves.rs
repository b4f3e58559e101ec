//! Speed of Dubins and Reeds-Shepp curves, as heuristics and as shots: time per 1000 of them.

use divan::{Bencher, black_box};
use formicar::geometry::{Pose2, dubins, reeds_shepp};
use formicar::numeric::Seed;
use std::f64::consts::PI;

fn main() {
    divan::main();
}

/// Largest coordinate of a goal, turning radii.
const REACHES: [u32; 3] = [3, 10, 100];

fn goals(reach: u32) -> Vec<Pose2> {
    let (mut random, reach) = (Seed(1).stream([0, 0]), f64::from(reach));
    let mut goal = || {
        let (x, y) = (random.range(-reach, reach), random.range(-reach, reach));
        Pose2::new(x, y, random.range(-PI, PI))
    };
    (0..1000).map(|_| goal()).collect()
}

fn to_all<T>(bencher: Bencher, reach: u32, to_one: impl Fn(Pose2, Pose2, f64) -> T) {
    let goals = goals(reach);
    let start = Pose2::default();
    bencher.bench_local(|| {
        for &goal in &goals {
            black_box(to_one(start, goal, 1.0));
        }
    });
}

#[divan::bench(args = REACHES)]
fn dubins_distance(bencher: Bencher, reach: u32) {
    to_all(bencher, reach, dubins::distance);
}

#[divan::bench(args = REACHES)]
fn dubins_shortest(bencher: Bencher, reach: u32) {
    to_all(bencher, reach, dubins::shortest);
}

#[divan::bench(args = REACHES)]
fn dubins_candidates(bencher: Bencher, reach: u32) {
    to_all(bencher, reach, dubins::candidates);
}

#[divan::bench(args = REACHES)]
fn reeds_shepp_distance(bencher: Bencher, reach: u32) {
    to_all(bencher, reach, reeds_shepp::distance);
}

#[divan::bench(args = REACHES)]
fn reeds_shepp_shortest(bencher: Bencher, reach: u32) {
    to_all(bencher, reach, reeds_shepp::shortest);
}

#[divan::bench(args = REACHES)]
fn reeds_shepp_candidates(bencher: Bencher, reach: u32) {
    to_all(bencher, reach, reeds_shepp::candidates);
}
