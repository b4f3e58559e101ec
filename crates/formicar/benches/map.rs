//! Speed of what is computed once per map.

mod support;

use divan::{Bencher, black_box};
use formicar::map::{BitGrid, Cell, Components, DiagonalRule, DistanceField, MoveMasks};
use support::{SIZES, hood, town};

fn main() {
    divan::main();
}

/// A field whose tiles are all computed.
fn whole_field(lethal: &BitGrid, truncation_cells: u32) -> u64 {
    let field = DistanceField::new(black_box(lethal), truncation_cells);
    field.values().map(u64::from).sum()
}

#[divan::bench(args = SIZES, consts = [32, 64, 255])]
fn distance_transform<const TRUNCATION: u32>(bencher: Bencher, (n_cols, n_rows): (usize, usize)) {
    let lethal = town(n_cols, n_rows);
    bencher.bench_local(|| whole_field(&lethal, TRUNCATION));
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
    bencher.bench_local(|| whole_field(&lethal, TRUNCATION));
}

#[divan::bench]
fn distance_transform_of_hood_800x500(bencher: Bencher) {
    let Some(hood) = hood() else { return };
    bencher.bench_local(|| whole_field(&hood.lethal, 64));
}

#[divan::bench(args = SIZES)]
fn inflation(bencher: Bencher, (n_cols, n_rows): (usize, usize)) {
    let field = DistanceField::new(&town(n_cols, n_rows), 32);
    bencher.bench_local(|| black_box(&field).within(2.5));
}

#[divan::bench(args = SIZES)]
fn move_masks(bencher: Bencher, (n_cols, n_rows): (usize, usize)) {
    let lethal = town(n_cols, n_rows);
    bencher.bench_local(|| MoveMasks::new(black_box(&lethal), DiagonalRule::NoObstacles));
}

#[divan::bench(args = SIZES)]
fn components(bencher: Bencher, (n_cols, n_rows): (usize, usize)) {
    let (lethal, rule) = (town(n_cols, n_rows), DiagonalRule::NoObstacles);
    bencher.bench_local(|| Components::new(black_box(&lethal), rule.connectivity()));
}
