//! One search over the lattice, in portions of steps.

use super::open_list::{Entry, OpenList, Step};
use super::state_costs::StateCosts;
use super::tree::Tree;
use crate::progress::{Event, Limits, ReachedView, Status};
use crate::search::drive::{DriveProblem, Driven, Guide, State};

/// A search that can be interrupted.
pub struct HybridSearch<'a> {
    problem: DriveProblem<'a>,
    tree: Tree,
    states: StateCosts,
    open: OpenList,
    /// States of the tree that the observer has heard of.
    n_told: usize,
}

/// After so many more states the observer hears of them.
const TOLD_STATES: usize = 500;

impl<'a> HybridSearch<'a> {
    /// A search about to begin.
    ///
    /// # Errors
    /// Deadline or cancel.
    pub fn new(
        problem: &DriveProblem<'a>,
        guide: &mut Guide,
        limits: &mut Limits,
    ) -> Result<Self, Status> {
        let mut search = Self {
            problem: problem.clone(),
            tree: Tree::default(),
            states: StateCosts::new(),
            open: OpenList::default(),
            n_told: 0,
        };
        for start in problem.start_states() {
            let root = search.tree.add(start, None);
            search.open_shots(root);
            search.open_moves(root, guide, limits)?;
        }
        Ok(search)
    }

    /// Goes on for a number of steps. The path from the request's start, or none so far.
    ///
    /// # Errors
    /// No path on the lattice; budget, deadline or cancel.
    pub fn run(
        &mut self,
        guide: &mut Guide,
        n_steps: u64,
        limits: &mut Limits,
    ) -> Result<Option<Driven>, Status> {
        let result = self.go_on(guide, n_steps, limits);
        self.tell(limits);
        result
    }

    /// Tells an observer that watches which states were reached since.
    fn tell(&mut self, limits: &mut Limits) {
        let first = std::mem::replace(&mut self.n_told, self.tree.len());
        if limits.watches_search() && first < self.tree.len() {
            limits.tell(&Event::Reached(ReachedView {
                n_steps: limits.n_steps(),
                motions: &self.tree.motions_from(first),
            }));
        }
    }

    fn go_on(
        &mut self,
        guide: &mut Guide,
        n_steps: u64,
        limits: &mut Limits,
    ) -> Result<Option<Driven>, Status> {
        let mut n_left = n_steps;
        while let Some(entry) = self.open.peek() {
            if self.tree.len() >= self.n_told + TOLD_STATES {
                self.tell(limits);
            }
            match entry.step {
                Step::Shot(shot) => return Ok(Some(self.path(entry.node, Some(shot)))),
                Step::Move(step) => {
                    if n_left == 0 {
                        return Ok(None);
                    }
                    n_left -= 1;
                    limits.long_step()?;
                    self.open.pop();
                    self.drive(entry, step, guide, limits)?;
                }
                Step::Expand if self.problem.at_goal(self.tree.state(entry.node).pose) => {
                    return Ok(Some(self.path(entry.node, None)));
                }
                Step::Expand => {
                    self.open.pop();
                    self.expand(entry.node, guide, limits)?;
                }
            }
        }
        Err(Status::NoPath)
    }

    fn path(&self, node: u32, shot: Option<u32>) -> Driven {
        self.problem.in_driving_order(self.tree.path(node, shot))
    }

    /// Checks a motion from a node. What is to go from its end is known only now: where that is
    /// more than was hoped, it waits on the list for its turn.
    fn drive(
        &mut self,
        entry: Entry,
        step: u16,
        guide: &mut Guide,
        limits: &mut Limits,
    ) -> Result<(), Status> {
        let from = *self.tree.state(entry.node);
        let Some(state) = self.successor(&from, step as usize) else {
            return Ok(());
        };
        let key = self.problem.key(&state);
        if !self.states.improves(key, state.cost)
            || !self.problem.is_free(&from, step as usize, state.arc)
        {
            return Ok(());
        }
        let Some(to_go) = guide.cost_to_go(&self.problem, state.pose, limits)? else {
            return Ok(());
        };
        self.states.reach(key, state.cost);
        let node = self.tree.add(state, Some(entry.node));
        let estimate = state.cost + self.problem.weight() * to_go;
        if estimate > entry.estimate {
            self.open.push(Entry {
                node,
                step: Step::Expand,
                estimate,
            });
            return Ok(());
        }
        self.expand(node, guide, limits)
    }

    fn successor(&self, from: &State, step: usize) -> Option<State> {
        if !from.is_start {
            return self.problem.arrive(from, step);
        }
        let mut wanted = None;
        self.problem.successors(from, |i, state| {
            if i == step {
                wanted = Some(state);
            }
        });
        wanted
    }

    fn expand(&mut self, node: u32, guide: &mut Guide, limits: &mut Limits) -> Result<(), Status> {
        let state = *self.tree.state(node);
        let key = self.problem.key(&state);
        if self.states.is_closed(key) {
            return Ok(());
        }
        self.states.close(key);
        if self
            .problem
            .wants_shot(guide, state.pose.position(), u64::from(node))
        {
            self.open_shots(node);
        }
        self.open_moves(node, guide, limits)
    }

    /// Puts the motions from a node on the list that may lead somewhere new, each with a hope of
    /// what is to go from there: the way along the field, and what a curve from the node leaves.
    fn open_moves(
        &mut self,
        node: u32,
        guide: &mut Guide,
        limits: &mut Limits,
    ) -> Result<(), Status> {
        let from = *self.tree.state(node);
        let Some(along_field) = guide.along_field_m(&self.problem, from.pose, limits)? else {
            return Ok(());
        };
        let along_curve = guide.along_curve_m(&self.problem, from.pose, along_field);
        let weight = self.problem.weight();
        let mut promising = Vec::with_capacity(self.problem.n_primitives());
        self.problem.successors(&from, |step, state| {
            if self.states.improves(self.problem.key(&state), state.cost) {
                promising.push((step, state));
            }
        });
        for (step, state) in promising {
            let Some(along_field) = guide.along_field_m(&self.problem, state.pose, limits)? else {
                continue;
            };
            let to_go = along_field.max(along_curve - state.arc.length_m());
            self.open.push(Entry {
                node,
                step: Step::Move(step as u16),
                estimate: state.cost + weight * to_go,
            });
        }
        Ok(())
    }

    /// Puts the cheapest free curve from a node to the goal on the list.
    fn open_shots(&mut self, node: u32) {
        let state = self.tree.state(node);
        if let Some((arcs, cost)) = self.problem.shot(state) {
            let estimate = state.cost + cost;
            let shot = self.tree.add_shot(arcs);
            self.open.push(Entry {
                node,
                step: Step::Shot(shot),
                estimate,
            });
        }
    }
}
