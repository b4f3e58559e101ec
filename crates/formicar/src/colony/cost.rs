//! Costs of ants' paths.

use crate::objective::{PathCost, PolylineCost, StepCounts};

/// The value of a path by a colony's objective.
pub(super) trait AntCost: Copy + Default + Send {
    /// The cost of the path.
    fn cost(&self) -> f64;

    /// The length of the path, in the unit of the objective.
    fn length(&self) -> f64;
}

/// The cost and the length of a path over cells.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct CellCost {
    pub(super) cost: f64,
    pub(super) length_cells: f64,
}

impl CellCost {
    /// The cost of a path of steps, each an index into [`STEPS`](crate::map::STEPS).
    pub(super) fn new(objective: &PathCost, steps: &[u8]) -> Self {
        let counts = StepCounts::of(steps);
        Self {
            cost: objective.cost(counts),
            length_cells: objective.length_cells(counts),
        }
    }
}

impl AntCost for CellCost {
    fn cost(&self) -> f64 {
        self.cost
    }

    fn length(&self) -> f64 {
        self.length_cells
    }
}

impl AntCost for PolylineCost {
    fn cost(&self) -> f64 {
        self.cost
    }

    fn length(&self) -> f64 {
        self.length_m
    }
}
