//! The nodes of the search: junctions passed in a facing, the start and the goal.

use crate::smoothing::roadmap::Facing;

/// A node of the search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Node {
    /// A junction of the roadmap that the vehicle passes in a facing.
    Passing(usize, Facing),
    /// The start.
    Start,
    /// The goal.
    Goal,
}

/// A value per node.
#[derive(Clone, Debug)]
pub(super) struct NodeMap<T> {
    values: Vec<T>,
    n_junctions: usize,
}

impl<T: Clone> NodeMap<T> {
    pub(super) fn new(n_junctions: usize, value: T) -> Self {
        Self {
            values: vec![value; 2 * n_junctions + 2],
            n_junctions,
        }
    }

    /// Nodes in the order of the polyline, each junction along before against.
    fn index(&self, node: Node) -> usize {
        match node {
            Node::Passing(junction, facing) => 2 * junction + facing as usize,
            Node::Start => 2 * self.n_junctions,
            Node::Goal => 2 * self.n_junctions + 1,
        }
    }
}

impl<T: Clone> std::ops::Index<Node> for NodeMap<T> {
    type Output = T;

    fn index(&self, node: Node) -> &T {
        &self.values[NodeMap::index(self, node)]
    }
}

impl<T: Clone> std::ops::IndexMut<Node> for NodeMap<T> {
    fn index_mut(&mut self, node: Node) -> &mut T {
        let index = NodeMap::index(self, node);
        &mut self.values[index]
    }
}
