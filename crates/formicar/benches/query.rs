//! Speed of a query on maps of growing size.

mod support;

use divan::{Bencher, black_box};
use formicar::geometry::Pose2;
use formicar::map::OccupancyGrid;
use formicar::numeric::Seed;
use formicar::planner::{FormicarParameters, Outcome, Planner, PlannerConfig};
use formicar::scenario::Request;
use formicar::vehicle::Vehicle;
use support::{SIZES, town_map};

fn main() {
    divan::main();
}

/// From the lower left corner of the town to the upper right one.
fn across(map: &OccupancyGrid) -> Request {
    let frame = map.frame();
    let side = |n_cells: usize| n_cells as f64 * frame.resolution_m();
    let (width_m, height_m) = (side(frame.n_cols()), side(frame.n_rows()));
    let goal = Pose2::new(width_m - 4.0, height_m - 1.0, 0.0);
    Request::new(Pose2::new(2.0, 0.8, 0.0), goal)
}

/// A planner that has answered the query once.
fn warm(map: &OccupancyGrid, config: PlannerConfig) -> Planner {
    let planner = Planner::new(map, Vehicle::lei2020(), config);
    let mut planner = planner.expect("valid parameters");
    let outcome = planner.plan(&across(map), Seed(1), &mut ());
    let plan = outcome.and_then(Outcome::found);
    plan.expect("a way across the town");
    planner
}

/// Nothing after the race.
fn without_improvement() -> PlannerConfig {
    let mut parameters = FormicarParameters::default();
    let (improve, drive) = (&mut parameters.improve, &mut parameters.drive);
    (improve.max_tries, improve.polish_passes) = (0, 0);
    (drive.second_steps, drive.n_stalled) = (0, 0);
    PlannerConfig::Formicar(parameters)
}

#[divan::bench(args = SIZES)]
fn first_path(bencher: Bencher, (n_cols, n_rows): (usize, usize)) {
    query(bencher, &town_map(n_cols, n_rows), without_improvement());
}

#[divan::bench(args = SIZES, sample_count = 10)]
fn improved_path(bencher: Bencher, (n_cols, n_rows): (usize, usize)) {
    query(bencher, &town_map(n_cols, n_rows), PlannerConfig::default());
}

#[divan::bench(args = SIZES, sample_count = 10)]
fn map_set_up(bencher: Bencher, (n_cols, n_rows): (usize, usize)) {
    let map = town_map(n_cols, n_rows);
    bencher.bench_local(|| {
        let config = PlannerConfig::default();
        Planner::new(black_box(&map), Vehicle::lei2020(), config)
    });
}

fn query(bencher: Bencher, map: &OccupancyGrid, config: PlannerConfig) {
    let (mut planner, request) = (warm(map, config), across(map));
    bencher.bench_local(|| planner.plan(black_box(&request), Seed(1), &mut ()));
}
