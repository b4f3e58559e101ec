//! Costs of steps as integers, so that sums are exact and ties are ties.

/// Cost of a straight step.
pub const STRAIGHT_COST: u32 = 985;
/// Cost of a diagonal step: 1393 / 985 is a convergent of sqrt(2), 2.6e-7 below it in proportion.
pub const DIAGONAL_COST: u32 = 1393;

/// Costs by place in [`STEPS`](super::STEPS).
pub(crate) const STEP_COSTS: [u32; 8] = {
    let mut costs = [STRAIGHT_COST; 8];
    let mut i = 1;
    while i < 8 {
        costs[i] = DIAGONAL_COST;
        i += 2;
    }
    costs
};
