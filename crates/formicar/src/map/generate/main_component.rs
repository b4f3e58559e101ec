//! The largest free area of a map.

use crate::map::{BitGrid, Cell, FREE, OCCUPIED, OccupancyGrid};

/// The cells of the largest 4-connected area that is not lethal; of equal areas the one whose
/// first cell comes first.
pub(super) fn main_component(map: &OccupancyGrid) -> BitGrid {
    let frame = map.frame();
    let (n_cols, n_rows) = (frame.n_cols(), frame.n_rows());
    let mut area_of: Vec<u32> = vec![0; frame.n_cells()];
    let is_lethal = |index: usize| !(FREE..OCCUPIED).contains(&map.values()[index]);
    let (mut best, mut n_areas) = ((0, 0), 0);
    let mut open = Vec::new();
    for first in 0..frame.n_cells() {
        if area_of[first] != 0 || is_lethal(first) {
            continue;
        }
        n_areas += 1;
        area_of[first] = n_areas;
        open.push(first);
        let mut n_cells = 0_usize;
        while let Some(index) = open.pop() {
            n_cells += 1;
            let (col, row) = (index % n_cols, index / n_cols);
            let neighbors = [
                (col > 0).then(|| index - 1),
                (col + 1 < n_cols).then(|| index + 1),
                (row > 0).then(|| index - n_cols),
                (row + 1 < n_rows).then(|| index + n_cols),
            ];
            for next in neighbors.into_iter().flatten() {
                if area_of[next] == 0 && !is_lethal(next) {
                    area_of[next] = n_areas;
                    open.push(next);
                }
            }
        }
        if n_cells > best.1 {
            best = (n_areas, n_cells);
        }
    }
    let mut cells = BitGrid::new(n_cols, n_rows);
    for (index, _) in area_of
        .iter()
        .enumerate()
        .filter(|&(_, &area)| area != 0 && area == best.0)
    {
        cells.insert(frame.cell(index));
    }
    cells
}

/// Occupies every free cell outside the largest free area.
pub(super) fn seal_all_but_main(map: &mut OccupancyGrid) {
    let main = main_component(map);
    for row in 0..main.n_rows() {
        for col in (0..main.n_cols()).filter(|&col| !main.get(col, row)) {
            map.set(Cell::new(col as u32, row as u32), OCCUPIED);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seals_what_cannot_be_reached() {
        let mut map = OccupancyGrid::from_rows(&["..#..", ".#...", "#...?"], 1.0).unwrap();
        seal_all_but_main(&mut map);
        let expected = OccupancyGrid::from_rows(&["###..", "##...", "#...#"], 1.0).unwrap();
        assert_eq!(map, expected);
    }
}
