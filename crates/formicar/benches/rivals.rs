//! Speed of whole queries on a generated neighborhood: Li et al. 2024 and its rivals, beside A*.

use divan::{Bencher, black_box};
use formicar::map::generate::{NeighborhoodParameters, alley_neighborhood, free_pose_pairs};
use formicar::numeric::Seed;
use formicar::planner::{Planner, PlannerConfig, PlannerName};
use formicar::scenario::{GoalHeading, Request, StartHeading};
use formicar::vehicle::Vehicle;

fn main() {
    divan::main();
}

/// A sedan on 800 x 500 cells of 0.2 m, from one end of the longest of ten ways to the other: the
/// shortest path over cells, everything else, smoothing and the judge.
#[divan::bench(args = [
    "astar", "dijkstra", "improved-astar", "ga", "aga", "aco", "faco2024",
])]
fn hood_800x500(bencher: Bencher, planner: &str) {
    let map = alley_neighborhood(&NeighborhoodParameters::default(), Seed(1)).expect("a map");
    let vehicle = Vehicle::sedan();
    let pairs = free_pose_pairs(&map, &vehicle, 10, Seed(1)).expect("free poses");
    let apart = |pair: &(formicar::geometry::Pose2, formicar::geometry::Pose2)| {
        pair.0.position().distance(pair.1.position())
    };
    let farthest = pairs
        .into_iter()
        .max_by(|a, b| apart(a).total_cmp(&apart(b)));
    let (start, goal) = farthest.expect("ten pairs");
    let request = Request {
        start_heading: StartHeading::Any,
        goal_heading: GoalHeading::Any,
        ..Request::new(start, goal)
    };
    let config = PlannerConfig::of(planner.parse::<PlannerName>().expect("a planner"));
    let mut planner = Planner::new(&map, vehicle, config).expect("valid parameters");
    bencher.bench_local(|| planner.plan(black_box(&request), Seed(1), &mut ()));
}
