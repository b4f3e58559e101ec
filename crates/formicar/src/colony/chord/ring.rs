//! The steps of an ant: chords to the cells of the ring around it.

use crate::geometry::angle_difference;
use crate::map::{Cell, ring};

/// Chords to all cells at a Chebyshev distance, counter-clockwise from east; eight neighbors at 1.
///
/// Li 2024 names no moves. On eight neighbors every turn is one of 45 degrees, which hardly a car
/// makes within a cell; at a distance of r cells there are 8 r directions.
#[derive(Clone, Debug)]
pub(super) struct Ring {
    /// Columns and rows.
    pub(super) moves: Vec<(i32, i32)>,
    /// Directions, radians.
    pub(super) directions_rad: Vec<f64>,
    /// Lengths in cells.
    pub(super) lengths: Vec<f64>,
}

impl Ring {
    pub(super) fn new(reach: u32) -> Self {
        let (center, side) = (Cell::new(reach, reach), 2 * reach as usize + 1);
        let offset = |to: u32| to as i32 - reach as i32;
        let moves: Vec<(i32, i32)> = ring(center, reach, side, side)
            .map(|cell| (offset(cell.col), offset(cell.row)))
            .collect();
        let of = |f: fn(f64, f64) -> f64| {
            let moves = moves.iter();
            moves
                .map(|&(dx, dy)| f(f64::from(dx), f64::from(dy)))
                .collect()
        };
        Self {
            directions_rad: of(|dx, dy| dy.atan2(dx)),
            lengths: of(f64::hypot),
            moves,
        }
    }

    pub(super) fn len(&self) -> usize {
        self.moves.len()
    }

    /// The turn from one step to another, radians, positive left.
    pub(super) fn turn_rad(&self, from: usize, to: usize) -> f64 {
        angle_difference(self.directions_rad[to], self.directions_rad[from])
    }
}

/// The cell that a step leads to; off the map it may be any.
pub(super) fn moved(cell: Cell, (dx, dy): (i32, i32)) -> Cell {
    Cell::new(
        cell.col.wrapping_add_signed(dx),
        cell.row.wrapping_add_signed(dy),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::STEPS;

    #[test]
    fn a_ring_of_one_is_the_eight_neighbors() {
        assert_eq!(Ring::new(1).moves, STEPS);
    }

    #[test]
    fn directions_of_a_wide_ring_lie_close() {
        let ring = Ring::new(5);
        assert_eq!(ring.len(), 40);
        let turns = (0..40).map(|i| ring.turn_rad(i, (i + 1) % 40).to_degrees());
        assert!(turns.into_iter().all(|turn| (6.0..11.4).contains(&turn)));
    }
}
