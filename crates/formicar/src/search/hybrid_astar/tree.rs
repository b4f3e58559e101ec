//! The search tree: how each state was reached.

use crate::geometry::{Arc, Pose2};

/// A state reached, and the motion that led there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) pose: Pose2,
    /// The motion from the parent; of length 0 at a start.
    pub(super) arc: Arc,
    pub(super) heading_index: usize,
    pub(super) cost: f64,
    pub(super) parent: Option<u32>,
}

impl Node {
    /// A start; its heading need not be on the lattice.
    pub(super) fn root(pose: Pose2) -> Self {
        Self {
            pose,
            arc: Arc::default(),
            heading_index: 0,
            cost: 0.0,
            parent: None,
        }
    }
}

/// All nodes, and the shots that lead from some of them to the goal.
#[derive(Default)]
pub(super) struct Tree {
    nodes: Vec<Node>,
    shots: Vec<Vec<Arc>>,
}

impl Tree {
    pub(super) fn add(&mut self, node: Node) -> u32 {
        self.nodes.push(node);
        (self.nodes.len() - 1) as u32
    }

    pub(super) fn node(&self, id: u32) -> &Node {
        &self.nodes[id as usize]
    }

    pub(super) fn add_shot(&mut self, arcs: Vec<Arc>) -> u32 {
        self.shots.push(arcs);
        (self.shots.len() - 1) as u32
    }

    /// The start and the arcs to a node, and those of a shot from there.
    pub(super) fn path(&self, id: u32, shot: Option<u32>) -> (Pose2, Vec<Arc>) {
        let mut arcs = Vec::new();
        let mut node = self.node(id);
        while let Some(parent) = node.parent {
            arcs.push(node.arc);
            node = self.node(parent);
        }
        arcs.reverse();
        arcs.extend(shot.iter().flat_map(|&shot| &self.shots[shot as usize]));
        (node.pose, arcs)
    }
}
