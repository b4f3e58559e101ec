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
mod state_set;
mod tree;

pub use config::HybridAstarConfig;
pub use problem::HybridProblem;

use crate::geometry::{Arc, Pose2};
use crate::progress::{Limits, Status};
use guide::Guide;
use open_list::{Entry, Move, OpenList};
use state_set::StateSet;
use tree::{Node, Tree};

/// Searches a drivable chain of arcs from start to goal, in grid coordinates.
///
/// A step of the limits is a state taken from the open list. The result is the start pose and the
/// arcs; whether it is certified is the judge's to say.
///
/// # Errors
/// The status to end with: no path on the lattice, budget, deadline or cancel.
pub fn hybrid_astar(problem: &HybridProblem, limits: &mut Limits) -> Result<(Pose2, Vec<Arc>), Status> {
    let mut ended = Status::NoPath;
    for inflation_m in problem.inflations_m() {
        let Some(guide) = Guide::new(problem, inflation_m, limits)? else { continue };
        match Search::new(problem, &guide).run(limits) {
            Err(Status::NoPath) => ended = Status::NoPath,
            other => return other,
        }
    }
    Err(ended)
}

/// The state of one search.
struct Search<'a> {
    problem: &'a HybridProblem<'a>,
    guide: &'a Guide<'a>,
    tree: Tree,
    closed: StateSet,
    open: OpenList,
}

impl<'a> Search<'a> {
    fn new(problem: &'a HybridProblem<'a>, guide: &'a Guide<'a>) -> Self {
        Self { problem, guide, tree: Tree::default(), closed: StateSet::new(), open: OpenList::default() }
    }

    fn run(mut self, limits: &mut Limits) -> Result<(Pose2, Vec<Arc>), Status> {
        for start in self.problem.starts() {
            let root = self.tree.add(Node::root(start));
            self.open_shots(root);
            self.open_alignments(root);
        }
        while let Some(entry) = self.open.pop() {
            if let Move::Shot(shot) = entry.step {
                return Ok(self.tree.path(entry.parent, &self.tree.shot(shot).clone()));
            }
            let node = self.arrive(&entry);
            if !self.closed.vacant(self.problem.key(&node)) {
                continue;
            }
            limits.step()?;
            if !self.problem.is_free(self.tree.pose(entry.parent), node.arc) {
                continue;
            }
            self.closed.insert(self.problem.key(&node));
            let id = self.tree.add(node);
            if self.problem.at_goal(self.tree.pose(id)) {
                return Ok(self.tree.path(id, &[]));
            }
            if self.guide.wants_shot(self.tree.pose(id), id) {
                self.open_shots(id);
            }
            self.open_primitives(id);
        }
        Err(Status::NoPath)
    }

    /// The node that an entry leads to.
    fn arrive(&self, entry: &Entry) -> Node {
        let parent = &self.tree.node(entry.parent);
        let (arc, heading_index) = match entry.step {
            Move::Primitive(i) => {
                let primitive = &self.problem.lattice().primitives()[i as usize];
                (primitive.arc(), self.problem.lattice().heading_after(parent.heading_index, primitive))
            }
            Move::Alignment(i) => {
                let alignment = self.problem.lattice().alignment_arcs(parent.pose.heading)[i as usize];
                (alignment.arc, alignment.heading_index)
            }
            Move::Shot(_) => unreachable!("shots are answered before they arrive anywhere"),
        };
        let pose = self.problem.lattice_pose(arc.end_from(parent.pose), heading_index);
        let cost = parent.cost + self.problem.cost(parent, arc, pose);
        Node { pose, arc, heading_index, cost, parent: Some(entry.parent) }
    }

    fn open_primitives(&mut self, id: u32) {
        for i in 0..self.problem.lattice().primitives().len() {
            self.open_move(id, Move::Primitive(i as u16));
        }
    }

    fn open_alignments(&mut self, id: u32) {
        let n = self.problem.lattice().alignment_arcs(self.tree.pose(id).heading).len();
        for i in 0..n {
            self.open_move(id, Move::Alignment(i as u16));
        }
    }

    fn open_move(&mut self, parent: u32, step: Move) {
        let entry = Entry { parent, step, estimate: 0.0 };
        let node = self.arrive(&entry);
        if self.problem.hits(node.pose) || !self.closed.vacant(self.problem.key(&node)) {
            return;
        }
        if let Some(to_go) = self.guide.cost_to_go(node.pose) {
            let estimate = node.cost + self.problem.config().weight * to_go;
            self.open.push(Entry { estimate, ..entry });
        }
    }

    /// Puts the cheapest free curve from a node to the goal on the list.
    fn open_shots(&mut self, id: u32) {
        if let Some((arcs, cost)) = shots::best(self.problem, &self.tree.node(id)) {
            let estimate = self.tree.node(id).cost + cost;
            let shot = self.tree.add_shot(arcs);
            self.open.push(Entry { parent: id, step: Move::Shot(shot), estimate });
        }
    }
}
