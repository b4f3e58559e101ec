//! Hybrid A* (Dolgov, Thrun, Montemerlo & Diebel 2010): A* over motion primitives on an absolute
//! heading lattice, guided by a goal field and by obstacle-free curves, ended by a curve that
//! hits the goal pose.
//!
//! Positions stay continuous; a state is the lattice cell and heading they fall into. Whether a
//! motion is free is asked when its state comes up, not when it is put on the list: most never
//! come up.

mod config;
mod guide;
mod open_list;
mod problem;
mod shots;
mod state_costs;
mod tree;

pub use config::HybridAstarConfig;
pub use problem::HybridProblem;

use crate::geometry::{Arc, Pose2};
use crate::progress::{Limits, Status};
use guide::Guide;
use open_list::{Entry, OpenList, Step};
use state_costs::StateCosts;
use tree::{Node, Tree};

/// Searches a drivable chain of arcs from start to goal, in grid coordinates.
///
/// A step of the limits is a state taken from the open list. The result is the start pose and the
/// arcs; whether it is certified is the judge's to say.
///
/// # Errors
/// The status to end with: no path on the lattice, budget, deadline or cancel.
pub fn hybrid_astar(
    problem: &HybridProblem,
    limits: &mut Limits,
) -> Result<(Pose2, Vec<Arc>), Status> {
    let fine = problem.refined();
    let (from_goal, fine_from_goal) = (problem.swapped(), fine.swapped());
    let [turning, wide, sure] = problem.inflations_m();
    // A guide that leads astray, or a tight place at the other end, must not cost all the time
    // there is: patience is short where hope is small, and unbounded only at the end.
    let stages = [
        (Some(problem), turning, PATIENCE_STEPS),
        (from_goal.as_ref(), turning, PATIENCE_STEPS),
        (Some(problem), wide, PATIENCE_STEPS),
        (Some(&fine), wide, PATIENCE_STEPS / 10),
        (fine_from_goal.as_ref(), wide, PATIENCE_STEPS / 10),
        (from_goal.as_ref(), wide, PATIENCE_STEPS),
        (fine_from_goal.as_ref(), wide, PATIENCE_STEPS),
        (Some(&fine), wide, PATIENCE_STEPS),
        (Some(problem), sure, 10 * PATIENCE_STEPS),
        (Some(&fine), sure, u64::MAX),
    ];
    // Others may have used the same limits before.
    let n_before = limits.n_steps();
    let most_steps = problem.config().max_iterations;
    for (problem, inflation_m, patience) in stages {
        let left = most_steps.saturating_sub(limits.n_steps() - n_before);
        if left == 0 {
            return Err(Status::BudgetExhausted);
        }
        let Some(problem) = problem else { continue };
        let Some(guide) = Guide::new(problem, inflation_m, limits)? else {
            continue;
        };
        match Search::new(problem, &guide).run(patience.min(left), limits) {
            Err(Status::NoPath) => {}
            ended => return ended.map(|path| problem.in_driving_order(path)),
        }
    }
    if limits.n_steps() - n_before >= most_steps {
        Err(Status::BudgetExhausted)
    } else {
        Err(Status::NoPath)
    }
}

/// Steps after which, usually, the next guide, side or lattice is tried.
const PATIENCE_STEPS: u64 = 50_000;

/// The state of one search.
struct Search<'a> {
    problem: &'a HybridProblem<'a>,
    guide: &'a Guide<'a>,
    tree: Tree,
    states: StateCosts,
    open: OpenList,
}

impl<'a> Search<'a> {
    fn new(problem: &'a HybridProblem<'a>, guide: &'a Guide<'a>) -> Self {
        Self {
            problem,
            guide,
            tree: Tree::default(),
            states: StateCosts::new(),
            open: OpenList::default(),
        }
    }

    fn run(
        mut self,
        patience_steps: u64,
        limits: &mut Limits,
    ) -> Result<(Pose2, Vec<Arc>), Status> {
        let before = limits.n_steps();
        for start in self.problem.starts() {
            let root = self.tree.add(Node::root(start));
            self.open_shots(root);
            self.open_moves(root);
        }
        while let Some(entry) = self.open.pop() {
            match entry.step {
                Step::Shot(shot) => return Ok(self.tree.path(entry.node, Some(shot))),
                Step::Move(step) => {
                    if limits.n_steps() - before == patience_steps {
                        break;
                    }
                    limits.step()?;
                    self.drive(entry.node, step);
                }
                Step::Expand if self.problem.at_goal(self.tree.node(entry.node).pose) => {
                    return Ok(self.tree.path(entry.node, None));
                }
                Step::Expand => self.expand(entry.node),
            }
        }
        Err(Status::NoPath)
    }

    /// Checks a motion from a node. Its true cost is known only now: where it leads waits on the
    /// list for its turn.
    fn drive(&mut self, parent: u32, step: u16) {
        let from = self.tree.node(parent);
        let mut node = self.problem.arrive(parent, from, step);
        if !self.states.improves(self.problem.key(&node), node.cost) {
            return;
        }
        let Some(cost) = self.problem.true_cost(from, from.pose, node.arc) else {
            return;
        };
        node.cost = from.cost + cost;
        let key = self.problem.key(&node);
        if !self.states.improves(key, node.cost) {
            return;
        }
        if let Some(estimate) = self.estimate(&node) {
            self.states.reach(key, node.cost);
            let node = self.tree.add(node);
            self.open.push(Entry {
                node,
                step: Step::Expand,
                estimate,
            });
        }
    }

    fn expand(&mut self, id: u32) {
        let node = self.tree.node(id);
        let (key, pose) = (self.problem.key(node), node.pose);
        if self.states.is_closed(key) {
            return;
        }
        self.states.close(key);
        if self.guide.wants_shot(pose, id) {
            self.open_shots(id);
        }
        self.open_moves(id);
    }

    fn estimate(&self, node: &Node) -> Option<f64> {
        let to_go = self.guide.cost_to_go(node.pose)?;
        Some(node.cost + self.problem.config().weight * to_go)
    }

    /// Puts the motions from a node on the list that may lead somewhere new.
    fn open_moves(&mut self, parent: u32) {
        let from = *self.tree.node(parent);
        for step in 0..self.problem.n_moves(&from) {
            let node = self.problem.arrive(parent, &from, step);
            if self.problem.hits(node.pose)
                || !self.states.improves(self.problem.key(&node), node.cost)
            {
                continue;
            }
            if let Some(estimate) = self.estimate(&node) {
                self.open.push(Entry {
                    node: parent,
                    step: Step::Move(step),
                    estimate,
                });
            }
        }
    }

    /// Puts the cheapest free curve from a node to the goal on the list.
    fn open_shots(&mut self, parent: u32) {
        let node = self.tree.node(parent);
        if let Some((arcs, cost)) = shots::best(self.problem, node) {
            let estimate = node.cost + cost;
            let shot = self.tree.add_shot(arcs);
            self.open.push(Entry {
                node: parent,
                step: Step::Shot(shot),
                estimate,
            });
        }
    }
}
