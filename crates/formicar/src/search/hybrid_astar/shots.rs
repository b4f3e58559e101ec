//! Curves straight to the goal: the analytic expansion.

use super::HybridProblem;
use super::tree::Node;
use crate::geometry::{Arc, Curve, Pose2, dubins, reeds_shepp};
use crate::scenario::MotionMode;

/// How many words are tried per goal, shortest first.
const MAX_WORDS: usize = 6;
/// Of how many goals the words are counted; of more, the nearest get most of them.
const MAX_COUNTED_GOALS: usize = 4;

/// The cheapest free curve from a node to a goal pose among the shortest words, with its cost.
pub(super) fn best(problem: &HybridProblem, node: &Node) -> Option<(Vec<Arc>, f64)> {
    let mut curves: Vec<Curve> = problem
        .goals()
        .iter()
        .flat_map(|&goal| words(problem, node.pose, goal))
        .collect();
    curves.sort_by(|a, b| a.length_m().total_cmp(&b.length_m()));
    let costs = curves
        .iter()
        .take(MAX_WORDS * problem.n_goals().min(MAX_COUNTED_GOALS))
        .filter_map(|curve| Some((curve, cost(problem, node, curve)?)));
    costs
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map(|(curve, cost)| (curve.arcs().to_vec(), cost))
}

fn words(problem: &HybridProblem, from: Pose2, to: Pose2) -> Vec<Curve> {
    match problem.motion() {
        MotionMode::Forward => dubins::candidates(from, to, problem.radius_m()),
        MotionMode::Reverse => reeds_shepp::candidates(from, to, problem.radius_m()),
    }
}

/// The cost of a curve driven after a node, by the same measure as that of primitives; none where
/// it touches anything.
fn cost(problem: &HybridProblem, node: &Node, curve: &Curve) -> Option<f64> {
    let mut before = *node;
    let mut total = 0.0;
    for (start, arc) in curve.placed_arcs(node.pose) {
        total += problem.true_cost(&before, start, arc)?;
        before.arc = arc;
    }
    Some(total)
}
