//! Curves straight to the goal: the analytic expansion.

use super::HybridProblem;
use super::tree::Node;
use crate::geometry::{Arc, Curve, Pose2, dubins, reeds_shepp};
use crate::scenario::MotionMode;

/// How many words are tried per goal pose, shortest first.
const MAX_WORDS: usize = 6;

/// The cheapest free curve from a node to a goal pose among the shortest words, with its cost.
pub(super) fn best(problem: &HybridProblem, node: &Node) -> Option<(Vec<Arc>, f64)> {
    let mut ranked: Vec<(f64, Curve)> = problem
        .goals()
        .iter()
        .flat_map(|&goal| words(problem, node.pose, goal))
        .map(|curve| (cost(problem, node, &curve), curve))
        .collect();
    ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
    let free = |curve: &Curve| {
        curve
            .placed_arcs(node.pose)
            .all(|(start, arc)| problem.is_free(start, arc))
    };
    ranked
        .iter()
        .take(MAX_WORDS)
        .find(|(_, curve)| free(curve))
        .map(|(cost, curve)| (curve.arcs().to_vec(), *cost))
}

fn words(problem: &HybridProblem, from: Pose2, to: Pose2) -> Vec<Curve> {
    match problem.motion() {
        MotionMode::Forward => dubins::candidates(from, to, problem.radius_m()),
        MotionMode::Reverse => reeds_shepp::candidates(from, to, problem.radius_m()),
    }
}

/// The cost of a curve driven after a node, by the same measure as that of primitives.
fn cost(problem: &HybridProblem, node: &Node, curve: &Curve) -> f64 {
    let mut total = 0.0;
    let mut last = *node;
    for (start, arc) in curve.placed_arcs(node.pose) {
        let middle = Arc::new(arc.curvature_per_m, 0.5 * arc.signed_length_m).end_from(start);
        total += problem.cost(&last, arc, middle);
        last = Node { arc, ..last };
    }
    total
}
