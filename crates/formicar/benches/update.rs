//! Speed of changing a map under a warm planner, beside making the planner anew.

mod support;

use divan::{Bencher, black_box};
use formicar::collision::ObstacleMap;
use formicar::geometry::Pose2;
use formicar::map::{Cell, CellRegion, FREE, OCCUPIED, OccupancyGrid};
use formicar::numeric::Seed;
use formicar::planner::{Planner, PlannerConfig};
use formicar::scenario::Request;
use formicar::vehicle::Vehicle;
use support::town_map;

/// Grid sizes.
const SIZES: [(usize, usize); 2] = [(800, 500), (2000, 2000)];
/// The cells that change.
const SIDE: usize = 20;

fn main() {
    divan::main();
}

fn region(n_cols: usize, n_rows: usize) -> CellRegion {
    let corner = Cell::new(n_cols as u32 / 2, n_rows as u32 / 2);
    CellRegion::new(corner, SIDE, SIDE)
}

/// A planner that has prepared everything for a query across the lower left corner.
fn warm(map: &OccupancyGrid) -> (Planner, Request) {
    let config = PlannerConfig::default();
    let planner = Planner::new(map, Vehicle::lei2020(), config);
    let mut planner = planner.expect("valid parameters");
    let mut request = Request::new(Pose2::new(2.0, 0.8, 0.0), Pose2::new(12.0, 0.8, 0.0));
    request.budget_steps = Some(10_000);
    let outcome = planner.plan(&request, Seed(1), &mut ());
    outcome.expect("a valid request");
    (planner, request)
}

/// Values that make every second cell of the rectangle another than before, each time.
fn values(turn: &mut bool) -> Vec<i8> {
    *turn = !*turn;
    let odd = *turn;
    let value = |i: usize| {
        if i.is_multiple_of(2) == odd {
            OCCUPIED
        } else {
            FREE
        }
    };
    (0..SIDE * SIDE).map(value).collect()
}

#[divan::bench(args = SIZES)]
fn update_map(bencher: Bencher, (n_cols, n_rows): (usize, usize)) {
    let (mut planner, _) = warm(&town_map(n_cols, n_rows));
    let (region, mut turn) = (region(n_cols, n_rows), false);
    bencher.bench_local(|| planner.update_map(region, &values(&mut turn)));
}

#[divan::bench(args = SIZES)]
fn update_map_and_short_query(bencher: Bencher, (n_cols, n_rows): (usize, usize)) {
    let (mut planner, request) = warm(&town_map(n_cols, n_rows));
    let (region, mut turn) = (region(n_cols, n_rows), false);
    bencher.bench_local(|| {
        let _ = planner.update_map(region, &values(&mut turn));
        planner.plan(black_box(&request), Seed(1), &mut ())
    });
}

#[divan::bench(args = SIZES)]
fn new_planner_and_short_query(bencher: Bencher, (n_cols, n_rows): (usize, usize)) {
    let map = town_map(n_cols, n_rows);
    bencher.bench_local(|| warm(black_box(&map)));
}

#[divan::bench(args = SIZES)]
fn short_query(bencher: Bencher, (n_cols, n_rows): (usize, usize)) {
    let (mut planner, request) = warm(&town_map(n_cols, n_rows));
    bencher.bench_local(|| planner.plan(black_box(&request), Seed(1), &mut ()));
}

#[divan::bench(args = SIZES)]
fn new_obstacle_map(bencher: Bencher, (n_cols, n_rows): (usize, usize)) {
    let map = town_map(n_cols, n_rows);
    bencher.bench_local(|| ObstacleMap::new(black_box(&map)));
}
