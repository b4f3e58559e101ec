//! Data by cell of a prepared map, which are updated where cells change.

use super::Inflation;
use crate::collision::ObstacleMap;
use crate::map::{BitGrid, Cell, CellRegion, DiagonalRule, MoveMasks, PaddedGrid};
use crate::map::{middle_cell, regrow};
use std::f64::consts::FRAC_1_SQRT_2;
use std::sync::OnceLock;

/// Padded obstacles, and the moves of goal fields.
#[derive(Clone, Debug)]
pub(super) struct DrivableCells {
    pub(super) padded: PaddedGrid,
    /// Moves on obstacles grown by each inflation, made when they are first needed.
    moves: [OnceLock<MoveMasks>; 4],
    /// Radii of inflation from cell center to cell center, cells.
    radii_cells: [f64; 4],
}

impl DrivableCells {
    /// Prepares a map for masks of a reach, and for inflation by radii.
    pub(super) fn new(obstacles: &ObstacleMap, reach_cells: usize, inflations_m: [f64; 4]) -> Self {
        let resolution_m = obstacles.frame().resolution_m();
        Self {
            padded: PaddedGrid::new(obstacles.lethal(), reach_cells),
            moves: Default::default(),
            // A cell is blocked only if every position in it is: half a diagonal from the cell's
            // center to the position, half a cell from the obstacle's center to its side.
            radii_cells: inflations_m
                .map(|radius_m| radius_m / resolution_m - (FRAC_1_SQRT_2 - 0.5)),
        }
    }

    /// The moves of an inflation, and the width of their cells in map cells.
    pub(super) fn moves(&self, obstacles: &ObstacleMap, inflation: Inflation) -> (&MoveMasks, u32) {
        let stride = self.stride(inflation);
        let moves = self.moves[inflation as usize].get_or_init(|| {
            let radius = self.radius_cells(obstacles, inflation);
            let blocked = obstacles.distance().within(radius);
            let blocked = blocked.unwrap_or_else(|| obstacles.lethal().clone());
            MoveMasks::new(
                &thinned(&blocked, stride as usize),
                DiagonalRule::AtMostOneObstacle,
            )
        });
        (moves, stride)
    }

    /// Takes over a rectangle of cells that has changed.
    pub(super) fn refresh(&mut self, obstacles: &ObstacleMap, changed: &CellRegion) {
        self.padded.refresh(obstacles.lethal(), changed.rows());
        for inflation in Inflation::ALL {
            let radius = self.radius_cells(obstacles, inflation);
            let stride = self.stride(inflation) as usize;
            if let Some(moves) = self.moves[inflation as usize].get_mut() {
                regrow(moves, obstacles.distance(), changed, (radius, stride));
            }
        }
    }

    fn radius_cells(&self, obstacles: &ObstacleMap, inflation: Inflation) -> f64 {
        let truncation = f64::from(obstacles.distance().truncation_cells());
        self.radii_cells[inflation as usize].clamp(0.0, truncation - 0.5)
    }

    fn stride(&self, inflation: Inflation) -> u32 {
        match inflation {
            Inflation::Sure => 1,
            _ => stride(self.radii_cells[inflation as usize]),
        }
    }
}

/// Largest width of a cell of the field in map cells: an odd number, so that their centers
/// coincide. Half a diagonal step is then shorter than the radius of inflation, so that no step
/// between free cells leads over an obstacle.
fn stride(radius_cells: f64) -> u32 {
    let most = (radius_cells / CELLS_PER_STRIDE) as u32;
    (most.max(1) - 1) / 2 * 2 + 1
}

/// The radius by which obstacles are grown is at least so many strides.
const CELLS_PER_STRIDE: f64 = 1.1;

/// The cells in the middle of blocks of `stride` times `stride` cells.
fn thinned(cells: &BitGrid, stride: usize) -> BitGrid {
    if stride == 1 {
        return cells.clone();
    }
    let (n_cols, n_rows) = (
        cells.n_cols().div_ceil(stride),
        cells.n_rows().div_ceil(stride),
    );
    let mut thinned = BitGrid::new(n_cols, n_rows);
    for row in 0..n_rows {
        for col in 0..n_cols {
            if cells.get(
                middle_cell(col, stride, cells.n_cols()),
                middle_cell(row, stride, cells.n_rows()),
            ) {
                thinned.insert(Cell::new(col as u32, row as u32));
            }
        }
    }
    thinned
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::{OCCUPIED, OccupancyGrid};
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(ProptestConfig::default().cases / 5))]

        #[test]
        fn refreshed_cells_are_those_of_the_changed_map(
            n_cols in 30_usize..160,
            n_rows in 30_usize..80,
            density in 0_usize..60,
            place in (0.0..1.0, 0.0..1.0),
            size in (1_usize..30, 1_usize..30),
            radii_m in (0.0..20.0, 0.0..20.0, 0.0..8.0, 0.0..3.0),
            seed in any::<u64>(),
        ) {
            let mut draw = crate::numeric::Seed(seed).stream([0, 0]);
            let row = ".".repeat(n_cols);
            let mut grid = OccupancyGrid::from_rows(&vec![&row[..]; n_rows], 0.5).unwrap();
            for _ in 0..density {
                let cell = Cell::new(draw.below(n_cols) as u32, draw.below(n_rows) as u32);
                grid.set(cell, OCCUPIED);
            }
            let (col, row) = ((place.0 * n_cols as f64) as usize, (place.1 * n_rows as f64) as usize);
            let (width, height) = (size.0.min(n_cols - col), size.1.min(n_rows - row));
            let region = CellRegion::new(Cell::new(col as u32, row as u32), width, height);
            let values: Vec<i8> = (0..width * height).map(|_| [0, OCCUPIED][draw.below(2)]).collect();
            let radii_m = [radii_m.0, radii_m.1, radii_m.2, radii_m.3];
            let mut map = ObstacleMap::new(&grid);
            let mut cells = DrivableCells::new(&map, 70, radii_m);
            for inflation in Inflation::ALL {
                cells.moves(&map, inflation);
            }
            if let Some(changed) = map.update(&region, &values).unwrap() {
                cells.refresh(&map, &changed);
            }
            grid.replace(&region, &values).unwrap();
            let fresh_map = ObstacleMap::new(&grid);
            let fresh = DrivableCells::new(&fresh_map, 70, radii_m);
            prop_assert_eq!(&cells.padded, &fresh.padded);
            for inflation in Inflation::ALL {
                prop_assert_eq!(cells.moves(&map, inflation), fresh.moves(&fresh_map, inflation));
            }
        }
    }
}
