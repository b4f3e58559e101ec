//! Repair of the goal field at the places where ants died.

use super::FieldRepair;
use crate::geometry::Point2;
use crate::map::Cell;
use crate::search::{FieldGrid, STRAIGHT_COST};
use std::collections::BTreeMap;

/// Tolls on the cells around the places of death, in proportion to the deaths there.
pub(super) fn tolls(
    repair: &FieldRepair,
    deaths: &[Point2],
    radius_m: f64,
    grid: FieldGrid,
) -> Vec<(Cell, u32)> {
    let FieldGrid {
        resolution_m,
        n_cols,
        n_rows,
    } = grid;
    let toll = (repair.toll_per_death * f64::from(STRAIGHT_COST)) as u32;
    let reach = (repair.reach_radii * radius_m / resolution_m).round() as i64;
    let mut tolls = BTreeMap::new();
    for death in deaths {
        let (col, row) = (
            (death.x / resolution_m) as i64,
            (death.y / resolution_m) as i64,
        );
        for dy in -reach..=reach {
            for dx in -reach..=reach {
                let (col, row) = (col + dx, row + dy);
                let is_near = dx * dx + dy * dy <= reach * reach;
                let on_map = (0..n_cols as i64).contains(&col) && (0..n_rows as i64).contains(&row);
                if is_near && on_map {
                    *tolls.entry((row as u32, col as u32)).or_insert(0) += toll;
                }
            }
        }
    }
    let cells = tolls.into_iter();
    cells
        .map(|((row, col), toll)| (Cell::new(col, row), toll))
        .collect()
}
