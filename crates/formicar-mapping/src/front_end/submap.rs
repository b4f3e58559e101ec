//! Submaps: signed distances of some twenty scans in a row.

use crate::config::MappingConfig;
use crate::sdf::{PackedSdf, SdfMap, Sweep};
use formicar::Pose2;

/// A finished submap, packed, in the frame of the front end.
#[derive(Clone, Debug, PartialEq)]
pub struct Submap {
    /// The first and one past the last of the nodes in it.
    pub nodes: (usize, usize),
    /// Its signed distances.
    pub field: PackedSdf,
}

impl Submap {
    /// The node in its middle, to which its frame is tied.
    pub fn anchor(&self) -> usize {
        usize::midpoint(self.nodes.0, self.nodes.1)
    }

    /// Number of its nodes.
    pub fn n_nodes(&self) -> usize {
        self.nodes.1 - self.nodes.0
    }
}

/// A submap that still grows.
#[derive(Clone, Debug, PartialEq)]
pub struct GrowingSubmap {
    /// Its first node.
    pub first_node: usize,
    /// Number of its nodes.
    pub n_nodes: usize,
    /// Its signed distances.
    pub field: SdfMap,
}

impl GrowingSubmap {
    /// An empty submap that begins with a node.
    pub fn new(first_node: usize, config: &MappingConfig) -> Self {
        Self {
            first_node,
            n_nodes: 0,
            field: SdfMap::new(config.resolution_m, config.truncation_m()),
        }
    }

    /// Inserts the scan of a node.
    pub fn insert(&mut self, sweep: &Sweep, pose: Pose2, config: &MappingConfig) {
        config.insertion.insert(&mut self.field, sweep, pose);
        self.n_nodes += 1;
    }

    /// The submap without further growth.
    pub fn finished(&self) -> Submap {
        Submap {
            nodes: (self.first_node, self.first_node + self.n_nodes),
            field: self.field.packed(),
        }
    }
}
