//! Speed of the pose graph. The difference of two counts of steps is the time of the steps between
//! them: the ordering of the nodes is computed once.

use divan::{Bencher, black_box};
use formicar::Pose2;
use formicar::numeric::{RandomStream, Seed};
use formicar_mapping::graph::{Edge, EdgeKind, GraphRule, Ordering, solve};
use formicar_mapping::matrix::Sym3;

fn main() {
    divan::main();
}

const N_POSES: usize = 10_000;

/// Laps through a building of 20 x 20 crossings 5 m apart, a pose each meter, as odometry has them;
/// a loop at every second pose that has been near an earlier one.
fn building() -> (Vec<Pose2>, Vec<Edge>) {
    let truth: Vec<Pose2> = (0..N_POSES).map(on_the_way).collect();
    let mut noise = Seed(7).stream([0, 0]);
    let mut edges = Vec::new();
    let mut odometry = vec![truth[0]];
    for i in 1..N_POSES {
        let motion = measured(truth[i - 1].relative(truth[i]), &mut noise);
        odometry.push(odometry[i - 1].compose(motion).wrapped());
        edges.push(edge((i - 1, i), motion, EdgeKind::Sequence));
    }
    for i in (1000..N_POSES).step_by(2) {
        let near = |j: &usize| truth[*j].position().distance(truth[i].position()) < 1.5;
        if let Some(j) = (0..i - 100).rev().step_by(7).find(near) {
            let motion = measured(truth[j].relative(truth[i]), &mut noise);
            edges.push(edge((j, i), motion, EdgeKind::Loop));
        }
    }
    (odometry, edges)
}

/// Lap after lap, each around another block.
fn on_the_way(i: usize) -> Pose2 {
    let lap = i / 400;
    let (side_m, at) = (100.0, (i % 400) as f64);
    let shift = 5.0 * (lap % 5) as f64;
    let (side, along) = ((at / side_m) as usize, at % side_m);
    let turn = side as f64 * std::f64::consts::FRAC_PI_2;
    let corner = [(0.0, 0.0), (side_m, 0.0), (side_m, side_m), (0.0, side_m)][side % 4];
    Pose2::new(
        corner.0 + along * turn.cos() + shift,
        corner.1 + along * turn.sin() + shift,
        turn,
    )
}

fn measured(motion: Pose2, noise: &mut RandomStream) -> Pose2 {
    let mut draw = |scale: f64| scale * (2.0 * noise.unit() - 1.0);
    Pose2::new(
        motion.x + draw(0.02),
        motion.y + draw(0.02),
        motion.heading + draw(0.005),
    )
}

fn edge((from, to): (usize, usize), motion: Pose2, kind: EdgeKind) -> Edge {
    Edge {
        from,
        to,
        motion,
        information: Sym3::diagonal(1e4, 1e4, 1e5),
        kind,
    }
}

#[divan::bench(args = [1, 6], sample_count = 10)]
fn steps_with_10000_poses(bencher: Bencher, n_steps: usize) {
    let (start, edges) = building();
    let rule = GraphRule {
        max_iterations: n_steps,
        tolerance: -1.0,
        ..GraphRule::default()
    };
    bencher.bench_local(|| {
        let solution = solve(black_box(&start), &edges, &rule);
        assert_eq!(solution.n_iterations, n_steps);
        solution.cost
    });
}

#[divan::bench(sample_count = 10)]
fn ordering_of_10000_poses(bencher: Bencher) {
    let (start, edges) = building();
    let pairs: Vec<(usize, usize)> = edges.iter().map(|edge| (edge.from, edge.to)).collect();
    bencher
        .bench_local(|| Ordering::minimum_degree(start.len(), black_box(&pairs).iter().copied()));
}
