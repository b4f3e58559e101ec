//! The least change of a chain that meets a pose within the limits of curvature and its rate.
//!
//! Newton's method on the end pose: each step solves the quadratic program "least weighted change
//! that meets the linearized pose and the limits" by Hildreth's method (1957), which goes round the
//! limits, moves onto each that is broken, and takes back what turned out to be too much. The pose's
//! three equations are met together, last in each round.

use super::chain::{Chain, Effect};
use crate::geometry::{Pose2, angle_difference};

/// The limits of a chain.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    pub(super) max_curvature_per_m: f64,
    pub(super) max_rate_per_m2: f64,
}

/// Share by which the solver stays within the limits, so that what its rounds leave over does no
/// harm.
pub(super) const RESERVE: f64 = 1e-5;

/// No ramp gets shorter than this, meters: a shorter one has no rate in rounded numbers.
const MIN_LENGTH_M: f64 = 1e-4;
/// Newton's method ends within these, meters and radians.
const CLOSE_M: f64 = 1e-11;
const CLOSE_RAD: f64 = 1e-12;
const MAX_NEWTON_STEPS: usize = 14;
const MAX_ROUNDS: usize = 150;
/// The first linear step may not miss by more than this, relative to the chain's length: beyond,
/// the chain becomes another way.
const MAX_MISS: f64 = 0.5;

/// Changes a chain so that it ends at `target` and keeps the limits; whether that succeeded.
pub(super) fn fit(chain: &mut Chain, target: Pose2, limits: Limits) -> bool {
    let mut before = f64::INFINITY;
    for _ in 0..MAX_NEWTON_STEPS {
        let poses = chain.poses(Pose2::default());
        let miss = miss(poses[poses.len() - 1], target);
        let is_close = miss[0].hypot(miss[1]) < CLOSE_M && miss[2].abs() < CLOSE_RAD;
        let excess = excess(chain, limits);
        if is_close && excess <= 0.0 {
            return true;
        }
        let size = miss[0].hypot(miss[1]) + miss[2].abs() + excess.max(0.0);
        // Not every step gains, but none may lose much.
        let lost = !size.is_finite() || size > 2.0 * before + 1e-9;
        if lost || miss[0].hypot(miss[1]) > MAX_MISS * chain.length_m() {
            return false;
        }
        before = before.min(size);
        let effects = chain.effects(&poses);
        if !Program::new(chain, limits).solve(chain, &effects, miss) {
            return false;
        }
    }
    false
}

fn miss(end: Pose2, target: Pose2) -> Effect {
    [
        target.x - end.x,
        target.y - end.y,
        angle_difference(target.heading, end.heading),
    ]
}

/// The excess over each limit, in the limit's unit; at most 0 where the chain keeps it.
fn excess(chain: &Chain, limits: Limits) -> f64 {
    let bends = chain.nodes.iter().map(|n| n.curvature_per_m.abs());
    let bend = bends.fold(0.0, f64::max) - limits.max_curvature_per_m;
    let rates = chain.ramps.iter().map(|ramp| {
        let [from, to] = chain.curvatures(ramp);
        (to - from).abs() / ramp.length_m
    });
    bend.max(rates.fold(0.0, f64::max) - limits.max_rate_per_m2)
}

/// A limit on two curvatures and a length, as a row of a linear program: `sum <= bound`.
struct Row {
    terms: [(usize, f64); 3],
    bound: f64,
    multiplier: f64,
}

/// The quadratic program of one Newton step.
struct Program {
    /// Inverse weights: how willingly a number changes.
    ease: Vec<f64>,
    rows: Vec<Row>,
}

impl Program {
    fn new(chain: &Chain, limits: Limits) -> Self {
        // A full change of curvature costs as much as the length that it takes.
        let full_m = limits.max_curvature_per_m / limits.max_rate_per_m2;
        let bend = |free: bool| {
            if free {
                limits.max_curvature_per_m.powi(2)
            } else {
                0.0
            }
        };
        let bends = chain.nodes.iter().map(|node| bend(node.is_free));
        let lengths = chain.ramps.iter().map(|_| full_m * full_m);
        Self {
            ease: bends.chain(lengths).collect(),
            rows: rows(chain, limits),
        }
    }

    /// Moves the chain by the least change; whether the pose can be met at all.
    fn solve(&mut self, chain: &mut Chain, effects: &[Effect], miss: Effect) -> bool {
        let Some(gain) = inverse(self.squares(effects)) else {
            return false;
        };
        let origin = numbers(chain);
        let mut x = origin.clone();
        for _ in 0..MAX_ROUNDS {
            let moved = self.round(&mut x);
            let mut left = miss;
            for ((effect, x), origin) in effects.iter().zip(&x).zip(&origin) {
                (0..3).for_each(|i| left[i] -= effect[i] * (x - origin));
            }
            let push: Effect = [0, 1, 2].map(|i| (0..3).map(|j| gain[i][j] * left[j]).sum());
            for (i, effect) in effects.iter().enumerate() {
                let along: f64 = (0..3).map(|j| effect[j] * push[j]).sum();
                x[i] += self.ease[i] * along;
            }
            if moved < 1e-14 && left.iter().all(|m| m.abs() < 1e-13) {
                break;
            }
        }
        let (bends, lengths) = x.split_at(chain.nodes.len());
        for (node, &bend) in chain.nodes.iter_mut().zip(bends) {
            node.curvature_per_m = bend;
        }
        for (ramp, &length) in chain.ramps.iter_mut().zip(lengths) {
            ramp.length_m = length.max(0.5 * MIN_LENGTH_M);
        }
        true
    }

    /// One round over the limits; how much moved, in units of the weights.
    fn round(&mut self, x: &mut [f64]) -> f64 {
        let mut moved = 0.0_f64;
        for row in &mut self.rows {
            let sum: f64 = row.terms.iter().map(|&(i, c)| c * x[i]).sum();
            let square: f64 = row.terms.iter().map(|&(i, c)| c * c * self.ease[i]).sum();
            if square <= 0.0 {
                continue;
            }
            let multiplier = (row.multiplier + (sum - row.bound) / square).max(0.0);
            let change = multiplier - row.multiplier;
            row.multiplier = multiplier;
            for &(i, c) in &row.terms {
                x[i] -= self.ease[i] * c * change;
            }
            moved = moved.max(change.abs() * square.sqrt());
        }
        moved
    }

    fn squares(&self, effects: &[Effect]) -> [[f64; 3]; 3] {
        let mut squares = [[0.0; 3]; 3];
        for (effect, ease) in effects.iter().zip(&self.ease) {
            for i in 0..3 {
                (0..3).for_each(|j| squares[i][j] += ease * effect[i] * effect[j]);
            }
        }
        squares
    }
}

fn numbers(chain: &Chain) -> Vec<f64> {
    let bends = chain.nodes.iter().map(|node| node.curvature_per_m);
    let lengths = chain.ramps.iter().map(|ramp| ramp.length_m);
    bends.chain(lengths).collect()
}

fn rows(chain: &Chain, limits: Limits) -> Vec<Row> {
    let bend = limits.max_curvature_per_m * (1.0 - RESERVE);
    let rate = limits.max_rate_per_m2 * (1.0 - RESERVE);
    let row = |terms, bound| Row {
        terms,
        bound,
        multiplier: 0.0,
    };
    let free = chain.nodes.iter().enumerate().filter(|(_, n)| n.is_free);
    let bends =
        free.flat_map(|(i, _)| [1.0, -1.0].map(|side| row([(i, side), (i, 0.0), (i, 0.0)], bend)));
    let first = chain.nodes.len();
    let ramps = chain.ramps.iter().enumerate().flat_map(|(i, ramp)| {
        let length = first + i;
        let steep = |side: f64| row([(ramp.to, side), (ramp.from, -side), (length, -rate)], 0.0);
        let short = row(
            [(length, -1.0), (length, 0.0), (length, 0.0)],
            -MIN_LENGTH_M,
        );
        [steep(1.0), steep(-1.0), short]
    });
    bends.chain(ramps).collect()
}

/// The inverse of a symmetric matrix; none where it is singular in rounded numbers.
fn inverse(m: [[f64; 3]; 3]) -> Option<[[f64; 3]; 3]> {
    let minor = |i: usize, j: usize| {
        let [a, b] = [(i + 1) % 3, (i + 2) % 3];
        let [c, d] = [(j + 1) % 3, (j + 2) % 3];
        m[a][c] * m[b][d] - m[a][d] * m[b][c]
    };
    let determinant: f64 = (0..3).map(|j| m[0][j] * minor(0, j)).sum();
    let scale = m[0][0] * m[1][1] * m[2][2];
    if !(determinant.is_finite() && determinant.abs() > 1e-14 * scale) {
        return None;
    }
    Some([0, 1, 2].map(|i| [0, 1, 2].map(|j| minor(j, i) / determinant)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::smoothing::continuous::chain::Ramp;

    #[test]
    fn inverts() {
        let m = [[4.0, 1.0, 0.5], [1.0, 3.0, -0.2], [0.5, -0.2, 2.0]];
        let n = inverse(m).unwrap();
        for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
            let sum: f64 = (0..3).map(|k| m[i][k] * n[k][j]).sum();
            let expected = if i == j { 1.0 } else { 0.0 };
            assert!((sum - expected).abs() < 1e-12);
        }
        assert!(inverse([[1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 1.0]]).is_none());
    }

    #[test]
    fn a_corner_of_an_arc_gets_its_transitions() {
        let limits = Limits {
            max_curvature_per_m: 0.5,
            max_rate_per_m2: 0.5,
        };
        let mut chain = Chain::default();
        for (k, free) in [
            (0.0, false),
            (0.0, true),
            (0.5, true),
            (0.5, true),
            (0.0, true),
            (0.0, false),
        ] {
            chain.node(k, free);
        }
        let lengths = [5.0, 0.2, 2.0, 0.2, 5.0];
        for (i, length_m) in lengths.into_iter().enumerate() {
            chain.ramps.push(Ramp {
                from: i,
                to: i + 1,
                length_m,
                sign: 1.0,
            });
        }
        let target = Pose2::default()
            .advance(0.0, 5.0)
            .advance(0.5, 2.2)
            .advance(0.0, 5.0);
        assert!(fit(&mut chain, target, limits));
        let end = chain.poses(Pose2::default())[5];
        assert!(end.position().distance(target.position()) < 1e-10);
        assert!(excess(&chain, limits) <= 0.0);
    }
}
