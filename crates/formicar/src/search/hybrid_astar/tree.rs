//! The search tree: how each state was reached.

use crate::geometry::{Arc, Pose2};
use crate::search::drive::{Driven, State};

/// No parent: a start.
const NONE: u32 = u32::MAX;

/// All states reached, and the shots that lead from some of them to the goal.
#[derive(Default)]
pub(super) struct Tree {
    states: Vec<State>,
    parents: Vec<u32>,
    shots: Vec<Vec<Arc>>,
}

impl Tree {
    pub(super) fn add(&mut self, state: State, parent: Option<u32>) -> u32 {
        self.states.push(state);
        self.parents.push(parent.unwrap_or(NONE));
        (self.states.len() - 1) as u32
    }

    pub(super) fn state(&self, id: u32) -> &State {
        &self.states[id as usize]
    }

    /// States reached.
    pub(super) fn len(&self) -> usize {
        self.states.len()
    }

    /// The motions to the states from a place in the tree on, each from where it begins; starts
    /// have none.
    pub(super) fn motions_from(&self, first: usize) -> Vec<(Pose2, Arc)> {
        let reached = self.states[first..].iter().zip(&self.parents[first..]);
        let reached = reached.filter(|&(_, &parent)| parent != NONE);
        let motions = reached.map(|(state, &parent)| (self.state(parent).pose, state.arc));
        motions.collect()
    }

    pub(super) fn add_shot(&mut self, arcs: Vec<Arc>) -> u32 {
        self.shots.push(arcs);
        (self.shots.len() - 1) as u32
    }

    /// The start and the arcs to a state, and those of a shot from there.
    pub(super) fn path(&self, id: u32, shot: Option<u32>) -> Driven {
        let mut arcs = Vec::new();
        let mut id = id;
        while self.parents[id as usize] != NONE {
            arcs.push(self.state(id).arc);
            id = self.parents[id as usize];
        }
        arcs.reverse();
        arcs.extend(shot.iter().flat_map(|&shot| &self.shots[shot as usize]));
        (self.state(id).pose, arcs)
    }
}
