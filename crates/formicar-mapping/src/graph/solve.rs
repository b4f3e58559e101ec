//! Levenberg-Marquardt over a pose graph, with robust loops.

use super::ldl::{Block, BlockMatrix};
use super::ordering::Ordering;
use super::{Edge, EdgeKind};
use crate::matrix::Sym3;
use formicar::Pose2;
use serde::{Deserialize, Serialize};

/// Parameters of the optimization.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct GraphRule {
    /// Loops, and edges across lost scans, that deviate by more than this many standard deviations
    /// lose weight (Cauchy).
    pub robust_scale: f64,
    /// Most steps.
    pub max_iterations: usize,
    /// The search ends when the cost falls by less than this share.
    pub tolerance: f64,
}

impl Default for GraphRule {
    fn default() -> Self {
        Self {
            robust_scale: 2.0,
            max_iterations: 30,
            tolerance: 1e-5,
        }
    }
}

/// The arrangement found.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// The poses; the first is that of the start.
    pub poses: Vec<Pose2>,
    /// The cost: half the sum of the robust squared deviations.
    pub cost: f64,
    /// The weight of each edge, 1 where it is believed.
    pub weights: Vec<f64>,
    /// Steps taken.
    pub n_iterations: usize,
}

/// The most likely poses under the edges, from a start; the first pose stays.
///
/// Minimizes `1/2 sum rho(eᵀ Ω e)` with e the deviation in the frame of the edge's first node.
/// Edges must name poses that exist. A step costs a factorization of the sparse normal matrix.
pub fn solve(start: &[Pose2], edges: &[Edge], rule: &GraphRule) -> Solution {
    let pairs = edges.iter().map(|edge| (edge.from, edge.to));
    let mut matrix = BlockMatrix::new(Ordering::minimum_degree(start.len(), pairs));
    let mut poses = start.to_vec();
    let mut cost = cost_of(&poses, edges, rule);
    let mut damping = 1e-7;
    let mut n_iterations = 0;
    while n_iterations < rule.max_iterations && poses.len() > 1 {
        n_iterations += 1;
        let right = assemble(&mut matrix, &poses, edges, rule);
        matrix.damp(damping, 1e-9);
        let Some(step) = matrix.solve(&right) else {
            damping *= 100.0;
            continue;
        };
        let next: Vec<Pose2> = poses
            .iter()
            .zip(step.chunks_exact(3))
            .map(|(pose, d)| Pose2::new(pose.x + d[0], pose.y + d[1], pose.heading + d[2]))
            .collect();
        let next_cost = cost_of(&next, edges, rule);
        if next_cost <= cost {
            let gain = cost - next_cost;
            poses = next;
            cost = next_cost;
            damping = (damping * 0.1_f64).max(1e-10);
            if gain <= rule.tolerance * cost {
                break;
            }
        } else {
            damping *= 30.0;
            if damping > 1e6 {
                break;
            }
        }
    }
    let weights = edges.iter().map(|edge| weight_of(&poses, edge, rule).0);
    Solution {
        weights: weights.collect(),
        poses: poses.into_iter().map(Pose2::wrapped).collect(),
        cost,
        n_iterations,
    }
}

/// Weight and robust cost of an edge.
fn weight_of(poses: &[Pose2], edge: &Edge, rule: &GraphRule) -> (f64, f64) {
    let error = edge.error(poses[edge.from], poses[edge.to]);
    let square = edge.information.form(error);
    if edge.kind == EdgeKind::Sequence {
        return (1.0, 0.5 * square);
    }
    let scale = rule.robust_scale.powi(2);
    let cost = 0.5 * scale * (square / scale).ln_1p();
    (1.0 / (1.0 + square / scale), cost)
}

fn cost_of(poses: &[Pose2], edges: &[Edge], rule: &GraphRule) -> f64 {
    edges
        .iter()
        .map(|edge| weight_of(poses, edge, rule).1)
        .sum()
}

/// The normal matrix, and the right-hand side (the negative gradient).
fn assemble(
    matrix: &mut BlockMatrix,
    poses: &[Pose2],
    edges: &[Edge],
    rule: &GraphRule,
) -> Vec<f64> {
    matrix.clear();
    let mut right = vec![0.0; 3 * poses.len()];
    for edge in edges {
        let (weight, _) = weight_of(poses, edge, rule);
        let information = edge.information.times(weight);
        let (from, to) = (poses[edge.from], poses[edge.to]);
        let error = edge.error(from, to);
        let (a, b) = jacobians(from, to);
        let (wa, wb) = (product(&information, &a), product(&information, &b));
        matrix.add_diagonal(edge.from, &transposed_product(&a, &wa));
        matrix.add_diagonal(edge.to, &transposed_product(&b, &wb));
        matrix.add_between(edge.from, edge.to, &transposed_product(&a, &wb));
        for k in 0..3 {
            for (i, e) in error.iter().enumerate() {
                right[3 * edge.from + k] -= wa[3 * i + k] * e;
                right[3 * edge.to + k] -= wb[3 * i + k] * e;
            }
        }
    }
    // The first pose stays.
    let held = 1e12;
    matrix.add_diagonal(0, &[held, 0.0, 0.0, 0.0, held, 0.0, 0.0, 0.0, held]);
    right
}

/// Derivatives of the deviation with respect to the two poses.
fn jacobians(from: Pose2, to: Pose2) -> (Block, Block) {
    let (s, c) = from.heading.sin_cos();
    let d = to.position() - from.position();
    let a = [
        -c,
        -s,
        c * d.y - s * d.x,
        s,
        -c,
        -c * d.x - s * d.y,
        0.0,
        0.0,
        -1.0,
    ];
    let b = [c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0];
    (a, b)
}

fn product(m: &Sym3, j: &Block) -> Block {
    let mut out = [0.0; 9];
    for k in 0..3 {
        let column = m.product([j[k], j[3 + k], j[6 + k]]);
        for (i, value) in column.into_iter().enumerate() {
            out[3 * i + k] = value;
        }
    }
    out
}

fn transposed_product(a: &Block, b: &Block) -> Block {
    let mut out = [0.0; 9];
    for i in 0..3 {
        for j in 0..3 {
            out[3 * i + j] = a[i] * b[j] + a[3 + i] * b[3 + j] + a[6 + i] * b[6 + j];
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use formicar::Seed;
    use proptest::prelude::*;

    /// A drive around a square, with an edge between the two passes of each place.
    fn square(n_laps: usize) -> (Vec<Pose2>, Vec<Edge>) {
        let mut truth = vec![Pose2::default()];
        for i in 1..=40 * n_laps {
            let turn = if i % 10 == 0 {
                std::f64::consts::FRAC_PI_2
            } else {
                0.0
            };
            truth.push(truth[i - 1].compose(Pose2::new(1.0, 0.0, turn)));
        }
        let edge = |from: usize, to: usize, kind: EdgeKind| Edge {
            from,
            to,
            motion: truth[from].relative(truth[to]).wrapped(),
            information: Sym3::diagonal(1e4, 4e3, 1e5),
            kind,
        };
        let mut edges: Vec<Edge> = (1..truth.len())
            .map(|i| edge(i - 1, i, EdgeKind::Sequence))
            .collect();
        edges.extend(
            (40..truth.len())
                .step_by(4)
                .map(|i| edge(i - 40, i, EdgeKind::Loop)),
        );
        (truth, edges)
    }

    fn worst(a: &[Pose2], b: &[Pose2]) -> f64 {
        let errors = a
            .iter()
            .zip(b)
            .flat_map(|(a, b)| crate::matrix::difference(*a, *b));
        errors.map(f64::abs).fold(0.0, f64::max)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(30))]
        #[test]
        fn a_graph_of_known_truth_is_recovered(seed in 0..1000_u64) {
            let (truth, edges) = square(2);
            let mut random = Seed(seed).stream([0, 0]);
            let mut drifted = vec![truth[0]];
            for edge in &edges[..truth.len() - 1] {
                let mut motion = edge.motion;
                motion.x += random.range(-0.02, 0.02);
                motion.heading += random.range(-0.02, 0.02);
                drifted.push(drifted[drifted.len() - 1].compose(motion));
            }
            prop_assert!(worst(&drifted, &truth) > 0.1);
            let found = solve(&drifted, &edges, &GraphRule { tolerance: 1e-12, ..GraphRule::default() });
            prop_assert!(worst(&found.poses, &truth) < 1e-5, "{}", worst(&found.poses, &truth));
        }
    }

    #[test]
    fn a_wrong_loop_loses_its_weight() {
        let (truth, mut edges) = square(2);
        let mut wrong = edges[edges.len() - 1];
        wrong.motion.x += 3.0;
        edges.push(wrong);
        let found = solve(&truth, &edges, &GraphRule::default());
        assert!(worst(&found.poses, &truth) < 0.02);
        assert!(found.weights[edges.len() - 1] < 0.01);
    }

    #[test]
    fn derivatives_are_those_of_differences() {
        let (from, to) = (Pose2::new(1.0, -2.0, 0.7), Pose2::new(3.0, 1.0, -0.4));
        let (a, b) = jacobians(from, to);
        let h = 1e-6;
        for k in 0..3 {
            let nudge = |p: Pose2, by: f64| match k {
                0 => Pose2::new(p.x + by, p.y, p.heading),
                1 => Pose2::new(p.x, p.y + by, p.heading),
                _ => Pose2::new(p.x, p.y, p.heading + by),
            };
            let slope = |f: &dyn Fn(f64) -> Pose2, i: usize| {
                let (high, low) = (f(h), f(-h));
                [high.x - low.x, high.y - low.y, high.heading - low.heading][i] / (2.0 * h)
            };
            for i in 0..3 {
                let from_slope = slope(&|by| nudge(from, by).relative(to), i);
                let to_slope = slope(&|by| from.relative(nudge(to, by)), i);
                assert!((from_slope - a[3 * i + k]).abs() < 1e-6);
                assert!((to_slope - b[3 * i + k]).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn the_same_graph_gives_the_same_bits() {
        let (truth, edges) = square(3);
        let start: Vec<Pose2> = truth
            .iter()
            .map(|p| Pose2::new(p.x * 1.02, p.y, p.heading))
            .collect();
        let run = || solve(&start, &edges, &GraphRule::default());
        assert_eq!(run(), run());
    }
}
