//! The widest way through: where the narrowest gap between two places is, and how wide.

use crate::map::{Cell, DistanceField, STEPS};

/// The narrowest place on the widest way between two cells.
#[derive(Clone, Debug, PartialEq)]
pub struct Passage {
    /// The way, from cell to cell.
    pub cells: Vec<Cell>,
    /// Where it is narrowest.
    pub narrowest: Cell,
    /// Distance between the centers of that cell and the nearest obstacle cell, in cells; at the
    /// truncation of the distance field, at least that.
    pub distance_cells: f64,
}

/// The way between two cells whose least distance from obstacles is largest; none where obstacles
/// separate them. Ways step to all eight neighbors, never between two obstacles.
///
/// Cost is proportional to the cells visited: a search by falling distance in one bucket per
/// squared distance.
pub fn widest_passage(distance: &DistanceField, from: Cell, to: Cell) -> Option<Passage> {
    const UNSEEN: u8 = u8::MAX;
    const FIRST: u8 = 8;
    let (n_cols, n_rows) = (distance.n_cols(), distance.n_rows());
    let on_map = |cell: Cell| (cell.col as usize) < n_cols && (cell.row as usize) < n_rows;
    if !on_map(from) || !on_map(to) {
        return None;
    }
    let clear = |cell: Cell| distance.squared(cell.col as usize, cell.row as usize);
    let index = |cell: Cell| cell.row as usize * n_cols + cell.col as usize;
    let mut came_by = vec![UNSEEN; n_cols * n_rows];
    let mut buckets = vec![Vec::new(); (distance.truncation_cells() as usize).pow(2) + 1];
    let mut level = clear(from) as usize;
    came_by[index(from)] = FIRST;
    buckets[level].push(from);
    while level > 0 {
        let Some(cell) = buckets[level].pop() else {
            level -= 1;
            continue;
        };
        if cell == to {
            return Some(trace(distance, &came_by, from, to));
        }
        for (step, next) in neighbors(distance, cell) {
            if came_by[index(next)] == UNSEEN {
                came_by[index(next)] = step;
                buckets[level.min(clear(next) as usize)].push(next);
            }
        }
    }
    None
}

/// Free neighbors, with the step that leads there.
fn neighbors(distance: &DistanceField, cell: Cell) -> impl Iterator<Item = (u8, Cell)> + '_ {
    let free = |col: u32, row: u32| distance.squared(col as usize, row as usize) > 0;
    STEPS
        .iter()
        .enumerate()
        .filter_map(move |(step, &(dx, dy))| {
            let (col, row) = (
                cell.col.checked_add_signed(dx)?,
                cell.row.checked_add_signed(dy)?,
            );
            let on_map = (col as usize) < distance.n_cols() && (row as usize) < distance.n_rows();
            let open = on_map && free(col, row) && (free(cell.col, row) || free(col, cell.row));
            open.then(|| (step as u8, Cell::new(col, row)))
        })
}

fn trace(distance: &DistanceField, came_by: &[u8], from: Cell, to: Cell) -> Passage {
    let mut cells = vec![to];
    let mut cell = to;
    while cell != from {
        let (dx, dy) =
            STEPS[came_by[cell.row as usize * distance.n_cols() + cell.col as usize] as usize];
        cell = Cell::new(
            cell.col.wrapping_add_signed(-dx),
            cell.row.wrapping_add_signed(-dy),
        );
        cells.push(cell);
    }
    cells.reverse();
    let clear = |cell: &Cell| distance.distance_cells(*cell);
    let narrowest = *cells
        .iter()
        .min_by(|a, b| clear(a).total_cmp(&clear(b)))
        .unwrap_or(&from);
    Passage {
        narrowest,
        distance_cells: clear(&narrowest),
        cells,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::OccupancyGrid;

    fn field(rows: &[&str]) -> DistanceField {
        DistanceField::new(
            &OccupancyGrid::from_rows(rows, 1.0).unwrap().lethal_cells(),
            64,
        )
    }

    #[test]
    fn takes_the_wider_of_two_gaps() {
        let rows = [
            ".........", //
            ".........",
            ".........",
            "##.##...#",
            ".........",
            ".........",
            ".........",
        ];
        let passage = widest_passage(&field(&rows), Cell::new(2, 6), Cell::new(2, 0)).unwrap();
        assert_eq!(passage.narrowest, Cell::new(6, 3));
        assert_eq!(passage.distance_cells, 2.0);
        assert_eq!(
            (passage.cells[0], passage.cells[passage.cells.len() - 1]),
            (Cell::new(2, 6), Cell::new(2, 0))
        );
    }

    #[test]
    fn walls_separate() {
        let field = field(&["..#..", "..#..", "..#.."]);
        assert_eq!(
            widest_passage(&field, Cell::new(0, 0), Cell::new(4, 0)),
            None
        );
        assert!(widest_passage(&field, Cell::new(0, 0), Cell::new(1, 2)).is_some());
        assert_eq!(
            widest_passage(&field, Cell::new(9, 0), Cell::new(4, 0)),
            None
        );
    }
}
