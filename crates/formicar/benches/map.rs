//! Speed of what is computed once per map.

mod support;

use divan::{Bencher, black_box};
use formicar::map::{BitGrid, Cell, DistanceField};
use support::{SIZES, town};

fn main() {
    divan::main();
}

#[divan::bench(args = SIZES, consts = [32, 64, 255])]
fn distance_transform<const TRUNCATION: u32>(bencher: Bencher, (n_cols, n_rows): (usize, usize)) {
    let lethal = town(n_cols, n_rows);
    bencher.bench_local(|| DistanceField::new(black_box(&lethal), TRUNCATION));
}

/// The slowest case: open ground with a pole every 100 cells.
#[divan::bench(args = SIZES, consts = [32, 64, 255])]
fn distance_transform_of_poles<const TRUNCATION: u32>(
    bencher: Bencher,
    (n_cols, n_rows): (usize, usize),
) {
    let mut lethal = BitGrid::new(n_cols, n_rows);
    for row in (0..n_rows as u32).step_by(100) {
        let cols = (0..n_cols as u32).step_by(100);
        cols.for_each(|col| lethal.insert(Cell::new(col, row)));
    }
    bencher.bench_local(|| DistanceField::new(black_box(&lethal), TRUNCATION));
}
