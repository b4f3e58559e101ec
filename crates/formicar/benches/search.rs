//! Speed of searches on grids, beside the `pathfinding` crate.

mod support;

use divan::{Bencher, black_box};
use formicar::map::{BitGrid, Cell, DiagonalRule, DistanceField, MoveMasks, STEPS};
use formicar::progress::Limits;
use formicar::search::{
    AstarWorkspace, DIAGONAL_COST, GoalField, ImprovedAstarConfig, STRAIGHT_COST, astar,
    improved_astar,
};
use pathfinding::prelude::astar as peer_astar;
use support::{SIZES, hood, town};

fn main() {
    divan::main();
}

#[divan::bench(args = SIZES)]
fn goal_field(bencher: Bencher, (n_cols, n_rows): (usize, usize)) {
    let moves = MoveMasks::new(&town(n_cols, n_rows), DiagonalRule::NoObstacles);
    let goals = [Cell::new(2, 2)];
    bencher.bench_local(|| {
        let mut nobody = ();
        let mut limits = Limits::new(&mut nobody, None, None);
        GoalField::new(black_box(&moves), &goals, &mut limits).map(drop)
    });
}

/// Ten queries on the neighborhood inflated by half a car's width, 0.5 m, no corner cutting.
mod hood_800x500 {
    use super::{
        AstarWorkspace, Bencher, BitGrid, Cell, DIAGONAL_COST, DiagonalRule, DistanceField,
        GoalField, ImprovedAstarConfig, Limits, MoveMasks, STEPS, STRAIGHT_COST, astar, black_box,
        hood, improved_astar, peer_astar,
    };

    const INFLATION_CELLS: f64 = 0.5 / 0.2;

    fn inflated() -> Option<(BitGrid, Vec<[Cell; 2]>)> {
        let hood = hood()?;
        let blocked = DistanceField::new(&hood.lethal, 32).within(INFLATION_CELLS)?;
        let is_free = |c: &Cell| !blocked.get(c.col as usize, c.row as usize);
        let queries = hood.queries.into_iter();
        let queries = queries.filter(|ends| ends.iter().all(is_free)).collect();
        Some((blocked, queries))
    }

    #[divan::bench]
    fn goal_field(bencher: Bencher) {
        let Some((blocked, queries)) = inflated() else {
            return;
        };
        let moves = MoveMasks::new(&blocked, DiagonalRule::NoObstacles);
        bencher.bench_local(|| {
            let mut nobody = ();
            let mut limits = Limits::new(&mut nobody, None, None);
            GoalField::new(black_box(&moves), &queries[0][1..], &mut limits).map(drop)
        });
    }

    /// All queries in a row.
    #[divan::bench]
    fn astar_10_queries(bencher: Bencher) {
        let Some((blocked, queries)) = inflated() else {
            return;
        };
        let moves = MoveMasks::new(&blocked, DiagonalRule::NoObstacles);
        let mut workspace = AstarWorkspace::new();
        bencher.bench_local(|| {
            let cost = |&ends: &[Cell; 2]| own_cost(&moves, ends, &mut workspace);
            queries.iter().map(cost).sum::<u64>()
        });
    }

    /// The same with the estimate of Niu 2021.
    #[divan::bench]
    fn improved_astar_10_queries(bencher: Bencher) {
        let Some((blocked, queries)) = inflated() else {
            return;
        };
        let moves = MoveMasks::new(&blocked, DiagonalRule::NoObstacles);
        let (mut workspace, config) = (AstarWorkspace::new(), ImprovedAstarConfig::default());
        bencher.bench_local(|| {
            let cost = |&ends: &[Cell; 2]| {
                let mut nobody = ();
                let mut limits = Limits::new(&mut nobody, None, None);
                let found = improved_astar(&moves, ends, &config, &mut workspace, &mut limits);
                found.map_or(0, |found| found.cost())
            };
            queries.iter().map(cost).sum::<u64>()
        });
    }

    fn own_cost(
        moves: &MoveMasks,
        [start, goal]: [Cell; 2],
        workspace: &mut AstarWorkspace,
    ) -> u64 {
        let mut nobody = ();
        let mut limits = Limits::new(&mut nobody, None, None);
        astar(moves, start, goal, workspace, &mut limits).map_or(0, |found| found.cost())
    }

    /// The same by `pathfinding`: same costs, heuristic, move masks.
    #[divan::bench]
    fn pathfinding_10_queries(bencher: Bencher) {
        let Some((blocked, queries)) = inflated() else {
            return;
        };
        let moves = MoveMasks::new(&blocked, DiagonalRule::NoObstacles);
        assert_eq!(queries.len(), 10, "every start and goal is free");
        for &ends in &queries {
            let own = own_cost(&moves, ends, &mut AstarWorkspace::new());
            assert!(own > 0 && own == peer_cost(&moves, ends), "{ends:?}");
        }
        bencher.bench_local(|| {
            let cost = |&ends: &[Cell; 2]| peer_cost(&moves, ends);
            queries.iter().map(cost).sum::<u64>()
        });
    }

    fn peer_cost(moves: &MoveMasks, [start, goal]: [Cell; 2]) -> u64 {
        let octile = |cell: &Cell| {
            let (dx, dy) = (cell.col.abs_diff(goal.col), cell.row.abs_diff(goal.row));
            dx.max(dy) * STRAIGHT_COST + dx.min(dy) * (DIAGONAL_COST - STRAIGHT_COST)
        };
        let successors = |&cell: &Cell| {
            let mask = moves.moves(cell);
            (0..8).filter(move |i| mask >> i & 1 == 1).map(move |i| {
                let (dx, dy) = STEPS[i];
                let to = Cell::new(
                    cell.col.wrapping_add_signed(dx),
                    cell.row.wrapping_add_signed(dy),
                );
                (to, [STRAIGHT_COST, DIAGONAL_COST][i % 2])
            })
        };
        peer_astar(&start, successors, octile, |&cell| cell == goal).map_or(0, |f| f.1.into())
    }
}
