//! Speed of colonies at the sizes of their papers.

use divan::{Bencher, black_box};
use formicar::colony::{ColonyConfig, ColonyProblem, Stopping, presets, run};
use formicar::layers::obstacle_expansion;
use formicar::map::{MoveMasks, builtin};
use formicar::numeric::Seed;
use formicar::progress::Limits;

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
    let problem = problem(map, n_grown, config);
    bencher.bench_local(|| {
        let mut nobody = ();
        let mut limits = Limits::new(&mut nobody, None, None);
        run(black_box(&problem), config, Seed(1), 1, &mut limits)
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
