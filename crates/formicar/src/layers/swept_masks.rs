//! The cells that a body sweeps on straight steps, as bits: one mask for each step.

use super::bit_mask::{BitMask, ROUNDING};
use crate::geometry::{ConvexPolygon, Point2, Pose2};
use crate::map::{BitGrid, Cell, shifted};
use crate::vehicle::Vehicle;

/// The cells that the body sweeps on each of some straight steps from cell center to cell center,
/// heading along the step.
///
/// Li 2024 (16-17): the oriented footprint S = R f(theta) with a margin, precomputed per heading,
/// in place of a map grown by one radius, which closes narrow alleys. A cell counts as swept where
/// its closed square touches the swept polygon.
#[derive(Clone, Debug)]
pub struct SweptMasks {
    masks: Vec<BitMask>,
}

impl SweptMasks {
    /// Masks of a vehicle with a margin around its body for steps given in cells, `(0, 0)` not
    /// among them, on cells of a size.
    pub fn new(vehicle: &Vehicle, margin_m: f64, steps: &[(i32, i32)], resolution_m: f64) -> Self {
        let parts: Vec<_> = (vehicle.parts().iter())
            .map(|part| part.grown(margin_m))
            .collect();
        let mask = |&(dx, dy): &(i32, i32)| {
            let step = Point2::new(f64::from(dx), f64::from(dy)) * resolution_m;
            let poses = [Point2::default(), step].map(|p| Pose2::at(p, step.angle()));
            let swept = |part: &ConvexPolygon| {
                let corners = poses
                    .map(|pose| part.placed(pose).corners().to_vec())
                    .concat();
                let in_cells: Vec<_> = corners.iter().map(|&p| p * (1.0 / resolution_m)).collect();
                ConvexPolygon::hull(&in_cells).expect("a moved body has an area")
            };
            let swept: Vec<_> = parts.iter().map(swept).collect();
            // Steps begin in the middle of a cell.
            BitMask::of(&swept, Point2::new(0.5, 0.5), ROUNDING)
        };
        Self {
            masks: steps.iter().map(mask).collect(),
        }
    }

    /// Whether the body keeps off all obstacles and on the map on a step from a cell.
    pub fn is_clear(&self, obstacles: &BitGrid, from: Cell, step: usize) -> bool {
        self.masks[step].is_clear(obstacles, from)
    }

    /// The cells swept on a step from a cell, in rows from below; those off the map too.
    pub fn swept(&self, from: Cell, step: usize) -> impl Iterator<Item = (i64, i64)> + '_ {
        let mask = &self.masks[step];
        let low = (
            i64::from(from.col) + i64::from(mask.low.0),
            i64::from(from.row) + i64::from(mask.low.1),
        );
        let rows = mask.words.chunks(mask.words_per_row).enumerate();
        rows.flat_map(move |(row, words)| {
            let columns = (0..mask.n_cols).filter(|col| words[col / 64] >> (col % 64) & 1 == 1);
            columns.map(move |col| (low.0 + col as i64, low.1 + row as i64))
        })
    }
}

impl BitMask {
    #[inline]
    fn is_clear(&self, obstacles: &BitGrid, from: Cell) -> bool {
        let (col, row) = (
            i64::from(from.col) + i64::from(self.low.0),
            i64::from(from.row) + i64::from(self.low.1),
        );
        let n_rows = (self.words.len() / self.words_per_row) as i64;
        let is_inside = col >= 0
            && row >= 0
            && col + self.n_cols as i64 <= obstacles.n_cols() as i64
            && row + n_rows <= obstacles.n_rows() as i64;
        if !is_inside {
            return false;
        }
        let (word, shift) = (col as usize / 64, col as usize % 64);
        let rows = self.words.chunks_exact(self.words_per_row).enumerate();
        rows.fold(0, |hit, (i, mask)| {
            let obstacles = &obstacles.row(row as usize + i)[word..];
            hit | hits(mask, obstacles, shift)
        }) == 0
    }
}

/// Bits of a mask that meet obstacles, whose words begin `shift` bits before the mask.
#[inline]
fn hits(mask: &[u64], obstacles: &[u64], shift: usize) -> u64 {
    let words = mask.iter().enumerate();
    words.fold(0, |hit, (w, &mask)| {
        let next = obstacles.get(w + 1).copied().unwrap_or(0);
        hit | mask & shifted(obstacles[w], next, shift)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collision::{Body, Drive, ObstacleMap};
    use crate::map::OccupancyGrid;
    use proptest::prelude::*;

    const STEPS: [(i32, i32); 6] = [(5, 0), (5, 2), (3, 5), (-5, 4), (0, -5), (-1, -5)];

    proptest! {
        #[test]
        fn a_mask_is_clear_where_the_exact_sweep_is(
            obstacles in prop::collection::vec((0_u32..90, 0_u32..40), 0..30),
            col in 0_u32..90,
            row in 0_u32..40,
            step in 0_usize..6,
        ) {
            let mut map = OccupancyGrid::from_rows(&[&".".repeat(90)[..]; 40], 0.2).unwrap();
            for (col, row) in obstacles {
                map.set(Cell::new(col, row), crate::map::OCCUPIED);
            }
            let vehicle = Vehicle::lei2020();
            let map = ObstacleMap::new(&map);
            let masks = SweptMasks::new(&vehicle, 0.0, &STEPS, 0.2);
            let from = Cell::new(col, row);
            let (dx, dy) = STEPS[step];
            let along = Point2::new(f64::from(dx), f64::from(dy)) * 0.2;
            let center = Point2::new(f64::from(col) + 0.5, f64::from(row) + 0.5) * 0.2;
            let drive = Drive {
                start: Pose2::at(center, along.angle()),
                curvature_per_m: 0.0,
                signed_length_m: along.norm(),
            };
            let body = Body::new(&vehicle);
            let is_clear = masks.is_clear(map.lethal(), from, step);
            let exact = map.is_free(&body, &drive);
            // Bare contact aside, both say the same; a mask never says free where the body hits.
            prop_assert!(!is_clear || exact);
            let apart = map.is_free(&Body::new(&vehicle.with_safety_margin(1e-3).unwrap()), &drive);
            prop_assert!(is_clear || !apart);
        }
    }

    #[test]
    fn masks_wider_than_a_word_are_read_across_words() {
        let vehicle = Vehicle::lei2020();
        let masks = SweptMasks::new(&vehicle, 0.0, &[(80, 0)], 0.02);
        let mut obstacles = BitGrid::new(600, 100);
        let from = Cell::new(50, 50);
        let swept: Vec<_> = masks.swept(from, 0).collect();
        assert!(masks.is_clear(&obstacles, from, 0));
        let (left, right) = swept.iter().fold((600, 0), |(low, high), cell| {
            (cell.0.min(low), cell.0.max(high))
        });
        for (col, is_clear) in [
            (left - 1, true),
            (left, false),
            (right, false),
            (right + 1, true),
        ] {
            let cell = Cell::new(col as u32, 50);
            obstacles.insert(cell);
            assert_eq!(masks.is_clear(&obstacles, from, 0), is_clear, "{col}");
            obstacles.remove(cell);
        }
        assert!(
            !masks.is_clear(&obstacles, Cell::new(10, 50), 0),
            "off the map"
        );
    }
}
