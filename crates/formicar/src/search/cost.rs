//! The range of integer costs of steps, and pruning of steps.

pub use crate::map::{DIAGONAL_COST, STRAIGHT_COST};

use crate::map::Cell;
pub(super) use crate::map::STEP_COSTS;

/// The largest cost from which a step may be taken; sums then fit 32 bits.
pub(super) const MAX_COST: u32 = u32::MAX - 1 - DIAGONAL_COST;

/// Cost between two cells on free ground (the octile distance), modulo 2^32.
pub(super) fn octile(a: Cell, b: Cell) -> u32 {
    let (dx, dy) = (a.col.abs_diff(b.col), a.row.abs_diff(b.row));
    let (long, short) = (dx.max(dy), dx.min(dy));
    long.wrapping_mul(STRAIGHT_COST)
        .wrapping_add(short.wrapping_mul(DIAGONAL_COST - STRAIGHT_COST))
}

/// By the step that reached a cell from its best neighbor, the steps worth taking on where all
/// eight are allowed; all of them at [`NO_STEP`].
///
/// Every other neighbor is reached past the cell at no more cost (Harabor & Grastien 2011): nearly
/// all by a strictly shorter way. The one tie, straight and then diagonal, is the diagonal step
/// first and the straight one then; the cell between drops that straight step only where a
/// strictly shorter way exists, so it does not matter which of two equal ways came first.
pub(super) const ONWARD_STEPS: [u8; 9] = {
    let mut onward = [0xFF_u8; 9];
    let mut step = 0;
    while step < 8 {
        let ahead = 1_u8 << step;
        let beside = ahead.rotate_left(1) | ahead.rotate_right(1);
        onward[step] = if step % 2 == 0 { ahead } else { ahead | beside };
        step += 1;
    }
    onward
};

/// Stands for no step: the cell is a start.
pub(super) const NO_STEP: usize = 8;
