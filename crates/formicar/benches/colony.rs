//! Speed of colonies at the sizes of their papers.

use divan::{Bencher, black_box};
use formicar::colony::corridor::{Corridor, RatioCorridor};
use formicar::colony::heuristic::{Advantage, Guidance};
use formicar::colony::{ColonyConfig, ColonyProblem, Stopping, presets, run};
use formicar::layers::obstacle_expansion;
use formicar::map::generate::{NeighborhoodParameters, alley_neighborhood};
use formicar::map::{Cell, MoveMasks, builtin};
use formicar::numeric::Seed;
use formicar::progress::Limits;
use formicar::search::GoalField;

fn main() {
    divan::main();
}

/// A built-in map with obstacles grown by some cells: by one in Lei & Zheng 2020.
fn problem(map: &str, n_grown: u32, config: &ColonyConfig) -> ColonyProblem {
    let builtin = builtin::BuiltinMap::by_name(map).expect("a built-in map");
    let (grid, ends) = (builtin.grid(), &builtin.requests[0]);
    let cell = |pose: formicar::geometry::Pose2| grid.frame().cell_at(pose.position());
    let mut blocked = grid.lethal_cells();
    blocked.unite(&obstacle_expansion(&blocked, n_grown));
    let moves = MoveMasks::new(&blocked, config.diagonal_rule);
    let [start, goal] = [cell(ends.start), cell(ends.goal)].map(|c| c.expect("on the map"));
    ColonyProblem::new(moves, start, goal)
}

fn sized(n_ants: u32, n_iterations: u32, stall_iterations: u32) -> ColonyConfig {
    ColonyConfig {
        n_ants,
        n_iterations,
        stopping: Stopping {
            stall_iterations,
            ..Stopping::default()
        },
        ..presets::lei2020()
    }
}

fn bench(bencher: Bencher, (map, n_grown): (&str, u32), config: &ColonyConfig) {
    bench_on(bencher, &problem(map, n_grown, config), config);
}

fn bench_on(bencher: Bencher, problem: &ColonyProblem, config: &ColonyConfig) {
    bencher.bench_local(|| {
        let mut nobody = ();
        let mut limits = Limits::new(&mut nobody, None, None);
        run(black_box(problem), config, Seed(1), 1, &mut limits)
    });
}

/// 150 iterations of 500 ants on 21 x 21 cells: the paper took 103 s.
#[divan::bench]
fn lei2020_map1_150x500(bencher: Bencher) {
    bench(bencher, ("lei-map1", 1), &sized(500, 150, 0));
}

/// The same until five iterations bring no better path.
#[divan::bench]
fn lei2020_map1_until_stall(bencher: Bencher) {
    bench(bencher, ("lei-map1", 1), &sized(500, 150, 5));
}

/// 200 iterations of 1000 ants on 40 x 40 cells: the paper took 964 s.
#[divan::bench]
fn lei2020_map2_200x1000(bencher: Bencher) {
    bench(bencher, ("lei-map2", 1), &sized(1000, 200, 0));
}

/// The same on map 3, which the paper took 1207 s for.
#[divan::bench]
fn lei2020_map3_200x1000(bencher: Bencher) {
    bench(bencher, ("lei-map3", 1), &sized(1000, 200, 0));
}

/// 200 iterations of 30 ants on 20 x 20 cells.
#[divan::bench]
fn wang2019_aisles_200x30(bencher: Bencher) {
    bench(bencher, ("wang-aisles", 0), &presets::wang2019());
}

/// From corner to corner of a neighborhood of 800 x 500 cells, obstacles grown by 0.6 m.
fn neighborhood(config: &ColonyConfig) -> ColonyProblem {
    let map = alley_neighborhood(&NeighborhoodParameters::default(), Seed(1));
    let mut blocked = map.expect("valid parameters").lethal_cells();
    blocked.unite(&obstacle_expansion(&blocked, 3));
    let moves = MoveMasks::new(&blocked, config.diagonal_rule);
    let mut nobody = ();
    let mut limits = Limits::new(&mut nobody, None, None);
    let middle = nearest(&moves, (400, 250), |cell| moves.moves(cell) != 0);
    let field = GoalField::new(&moves, &[middle], &mut limits).expect("a free cell");
    let [start, goal] =
        [(0, 0), (800, 500)].map(|corner| nearest(&moves, corner, |c| field.cost(c).is_some()));
    ColonyProblem::new(moves, start, goal)
}

/// The cell of a kind that is nearest to a place.
fn nearest(moves: &MoveMasks, place: (u32, u32), is_one: impl Fn(Cell) -> bool) -> Cell {
    let cells = (0..moves.as_slice().len()).map(|index| moves.cell(index));
    let away = |c: &Cell| c.col.abs_diff(place.0).pow(2) + c.row.abs_diff(place.1).pow(2);
    cells.filter(|&c| is_one(c)).min_by_key(away).expect("one")
}

/// 50 ants that know the way, on all cells that they can reach.
fn guided(n_iterations: u32) -> ColonyConfig {
    ColonyConfig {
        n_ants: 50,
        n_iterations,
        guidance: Guidance::Advantage(Advantage::default()),
        ..presets::ant_system()
    }
}

/// Iterations of 50 guided ants on 800 x 500 cells.
#[divan::bench(args = [1, 50])]
fn neighborhood_whole(bencher: Bencher, n_iterations: u32) {
    let config = guided(n_iterations);
    bench_on(bencher, &neighborhood(&config), &config);
}

/// The same in the corridor of ways a tenth longer than the shortest.
#[divan::bench(args = [1, 50])]
fn neighborhood_corridor(bencher: Bencher, n_iterations: u32) {
    let config = ColonyConfig {
        corridor: Corridor::Ratio(RatioCorridor::default()),
        ..guided(n_iterations)
    };
    bench_on(bencher, &neighborhood(&config), &config);
}
