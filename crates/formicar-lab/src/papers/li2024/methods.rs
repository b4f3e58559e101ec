//! The methods that are compared.

use formicar::planner::PlannerName;

/// A planner, and the way it is measured.
#[derive(Clone, Copy, Debug)]
pub(super) struct Method {
    pub(super) planner: PlannerName,
    /// The vertices of its path before it is made drivable.
    pub(super) native: Native,
    /// The source of its costs by generation.
    pub(super) generations: Generations,
}

/// The vertices of a path before it is made drivable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Native {
    /// All cells, as A* finds them.
    Cells,
    /// The nodes of a polyline.
    Nodes,
    /// The joints of the curve itself.
    Curve,
}

impl Native {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Cells => "cells",
            Self::Nodes => "nodes",
            Self::Curve => "curve",
        }
    }
}

/// The source of the cost J of a generation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Generations {
    /// There are no generations.
    None,
    /// In its record: the method minimizes J.
    Record,
    /// In the ways of its ants, once their redundant nodes are removed: the method minimizes
    /// something else.
    Ways,
}

/// The method that the paper proposes.
pub(super) const PROPOSED: &str = "faco2024";
/// The method that times are compared with.
pub(super) const YARDSTICK: &str = "astar";

/// The methods in the order of the paper's tables.
pub(super) fn methods() -> Vec<Method> {
    use PlannerName::{Aco, Acof, Aga, Astar, Faco2024, Ga, ImprovedAstar};
    let method = |(planner, native, generations)| Method {
        planner,
        native,
        generations,
    };
    [
        (Astar, Native::Cells, Generations::None),
        (ImprovedAstar, Native::Cells, Generations::None),
        (Ga, Native::Nodes, Generations::Record),
        (Aga, Native::Nodes, Generations::Record),
        (Aco, Native::Nodes, Generations::Ways),
        (Acof, Native::Curve, Generations::Ways),
        (Faco2024, Native::Cells, Generations::Record),
    ]
    .map(method)
    .to_vec()
}
