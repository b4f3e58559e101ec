//! The attraction of cells and steps, as logarithms.

/// Logarithms of the factors by which an ant favors cells and steps.
#[derive(Clone, Debug)]
pub(in crate::colony) struct LogDesire {
    /// By number of the cell.
    pub(in crate::colony) cells: Vec<f64>,
    /// By place in [`STEPS`](crate::map::STEPS).
    pub(in crate::colony) steps: [f64; 8],
}

/// Length of each of [`STEPS`](crate::map::STEPS) in cells.
pub(in crate::colony) fn step_length(step: usize) -> f64 {
    if step.is_multiple_of(2) {
        1.0
    } else {
        std::f64::consts::SQRT_2
    }
}
