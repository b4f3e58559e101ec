//! The methods that are compared.

use formicar::planner::PlannerName;

/// A planner, and how it is measured.
#[derive(Clone, Copy, Debug)]
pub(super) struct Method {
    pub(super) planner: PlannerName,
    /// What its path was before it was made drivable.
    pub(super) native: Native,
    /// What it has by generation.
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

/// Where the cost J of a generation is found.
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

/// Names and measures in the order of the paper's tables.
const METHODS: [(&str, Native, Generations); 7] = [
    (YARDSTICK, Native::Cells, Generations::None),
    ("improved-astar", Native::Cells, Generations::None),
    ("ga", Native::Nodes, Generations::Record),
    ("aga", Native::Nodes, Generations::Record),
    ("aco", Native::Nodes, Generations::Ways),
    ("acof", Native::Curve, Generations::Ways),
    (PROPOSED, Native::Nodes, Generations::Record),
];

/// The methods that this build knows, and the names of the others.
pub(super) fn methods() -> (Vec<Method>, Vec<&'static str>) {
    let (mut known, mut unknown) = (Vec::new(), Vec::new());
    for (name, native, generations) in METHODS {
        match name.parse() {
            Ok(planner) => known.push(Method {
                planner,
                native,
                generations,
            }),
            Err(_) => unknown.push(name),
        }
    }
    (known, unknown)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_method_is_known_or_named() {
        let (known, unknown) = methods();
        assert_eq!(known.len() + unknown.len(), METHODS.len());
        assert_eq!(known[0].planner, PlannerName::Astar);
    }
}
