//! Speed of what is laid over a map before ants walk on it.

mod support;

use divan::{Bencher, black_box};
use formicar::layers::{Expansion, Layers, LayersConfig, UShapes, obstacle_expansion};
use formicar::map::{BitGrid, Cell, DiagonalRule};
use formicar::numeric::Seed;
use support::{SIZES, hood, town};

fn main() {
    divan::main();
}

#[divan::bench(args = SIZES, consts = [1, 5, 16])]
fn expansion<const N_CELLS: u32>(bencher: Bencher, (n_cols, n_rows): (usize, usize)) {
    let obstacles = town(n_cols, n_rows);
    bencher.bench_local(|| obstacle_expansion(black_box(&obstacles), N_CELLS));
}

/// Both layers, from one corner of the map to the other.
fn layers(obstacles: &BitGrid, rule: DiagonalRule) -> Layers {
    let config = LayersConfig {
        expansion: Expansion::Cells(2),
        u_shapes: UShapes::Close,
    };
    let far = Cell::new(obstacles.n_cols() as u32 - 1, obstacles.n_rows() as u32 - 1);
    Layers::new(obstacles, &config, &[Cell::new(0, 0), far], rule, 0.0)
}

#[divan::bench(args = SIZES)]
fn layers_of_town(bencher: Bencher, (n_cols, n_rows): (usize, usize)) {
    let obstacles = town(n_cols, n_rows);
    bencher.bench_local(|| layers(black_box(&obstacles), DiagonalRule::NoObstacles));
}

/// The slowest case: obstacles without order, whose mouths are no straight lines.
#[divan::bench(args = SIZES)]
fn layers_of_scatter(bencher: Bencher, (n_cols, n_rows): (usize, usize)) {
    let mut obstacles = BitGrid::new(n_cols, n_rows);
    let mut stream = Seed(1).stream([n_cols as u64, n_rows as u64]);
    for _ in 0..n_cols * n_rows / 100 {
        let (col, row) = (stream.below(n_cols), stream.below(n_rows));
        obstacles.insert(Cell::new(col as u32, row as u32));
    }
    bencher.bench_local(|| layers(black_box(&obstacles), DiagonalRule::NoObstacles));
}

#[divan::bench(args = [DiagonalRule::Always, DiagonalRule::NoObstacles])]
fn layers_of_hood_800x500(bencher: Bencher, rule: DiagonalRule) {
    let Some(hood) = hood() else { return };
    bencher.bench_local(|| layers(black_box(&hood.lethal), rule));
}
