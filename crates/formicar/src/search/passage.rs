//! The widest passage between two places: its narrowest gap and the width there.

use crate::map::{Cell, DistanceField, STEPS};
use std::f64::consts::FRAC_1_SQRT_2;

/// The narrowest place on the widest way between two cells.
#[derive(Clone, Debug, PartialEq)]
pub struct Passage {
    /// The way, from cell to cell.
    pub cells: Vec<Cell>,
    /// The narrowest place.
    pub narrowest: Cell,
    /// Distance between the centers of that cell and the nearest obstacle cell, in cells; at the
    /// truncation of the distance field, at least that.
    pub distance_cells: f64,
}

impl Passage {
    /// No wider disc passes on any way between the same two cells, in cells; none where the field
    /// it was found in does not reach so far.
    ///
    /// The middle of the cell in which the disc's own lies is at most half a diagonal away from it,
    /// and that of an obstacle cell lies half a side behind the obstacle's side.
    pub fn widest_disc_cells(&self, distance: &DistanceField) -> Option<f64> {
        let is_known = self.distance_cells < f64::from(distance.truncation_cells());
        is_known.then_some(2.0 * (self.distance_cells + FRAC_1_SQRT_2 - 0.5))
    }
}

/// The way between two cells whose least distance from obstacles is largest; none where obstacles
/// separate them. Ways step to all eight neighbors, never between two obstacles.
pub fn widest_passage(distance: &DistanceField, from: Cell, to: Cell) -> Option<Passage> {
    widest_passage_while(distance, [from, to], &mut || true)
}

/// The same, where `goes_on` is asked on the way whether to go on; none where it said no.
pub(crate) fn widest_passage_while(
    distance: &DistanceField,
    [from, to]: [Cell; 2],
    goes_on: &mut dyn FnMut() -> bool,
) -> Option<Passage> {
    if !is_on(distance, to) {
        return None;
    }
    let goal = to.row as usize * distance.n_cols() + to.col as usize;
    widest_way_out(distance, from, |index| index == goal, goes_on)
}

/// The same to the first cell that `is_there` accepts, given its place row by row, where all such
/// cells lie wider than the narrowest place on the way to them; none where `goes_on` says no.
///
/// Cost is proportional to the cells visited, but for clearing five bytes per cell: a search by
/// falling distance, with one stack per squared distance, all in one list.
pub(crate) fn widest_way_out(
    distance: &DistanceField,
    from: Cell,
    is_there: impl Fn(usize) -> bool,
    goes_on: &mut dyn FnMut() -> bool,
) -> Option<Passage> {
    if !is_on(distance, from) {
        return None;
    }
    let (n_cols, n_cells) = (distance.n_cols(), distance.n_cols() * distance.n_rows());
    let start = from.row as usize * n_cols + from.col as usize;
    let mut came_by = vec![UNSEEN; n_cells];
    let mut level = usize::from(distance.squared(from.col as usize, from.row as usize));
    let mut stacks = Stacks::new(n_cells, level);
    came_by[start] = FIRST;
    stacks.push(level, start);
    let mut n_popped = 0_usize;
    while level > 0 {
        let Some(index) = stacks.pop(level) else {
            level -= 1;
            continue;
        };
        n_popped += 1;
        if n_popped.is_multiple_of(CELLS_PER_LOOK) && !goes_on() {
            return None;
        }
        if is_there(index) {
            return Some(trace(distance, &came_by, start, index));
        }
        let (col, row) = (index % n_cols, index / n_cols);
        for (step, &(dx, dy)) in STEPS.iter().enumerate() {
            let (to_col, to_row) = (
                col.wrapping_add_signed(dx as isize),
                row.wrapping_add_signed(dy as isize),
            );
            if to_col >= n_cols || to_row >= distance.n_rows() {
                continue;
            }
            let next = to_row * n_cols + to_col;
            let clear = distance.squared(to_col, to_row);
            let squeezes =
                || distance.squared(to_col, row) == 0 && distance.squared(col, to_row) == 0;
            if came_by[next] == UNSEEN && clear > 0 && !squeezes() {
                came_by[next] = step as u8;
                stacks.push(level.min(usize::from(clear)), next);
            }
        }
    }
    None
}

/// Cells visited between two questions whether to go on.
const CELLS_PER_LOOK: usize = 1024;
/// A cell that nothing has reached.
const UNSEEN: u8 = u8::MAX;
/// The first cell, which no step has reached.
const FIRST: u8 = 8;

fn is_on(distance: &DistanceField, cell: Cell) -> bool {
    (cell.col as usize) < distance.n_cols() && (cell.row as usize) < distance.n_rows()
}

/// A stack of cells per level; a cell is in one of them at most once.
struct Stacks {
    tops: Vec<u32>,
    below: Vec<u32>,
}

impl Stacks {
    const BOTTOM: u32 = u32::MAX;

    fn new(n_cells: usize, highest: usize) -> Self {
        Self {
            tops: vec![Self::BOTTOM; highest + 1],
            below: vec![0; n_cells],
        }
    }

    fn push(&mut self, level: usize, cell: usize) {
        self.below[cell] = self.tops[level];
        self.tops[level] = cell as u32;
    }

    fn pop(&mut self, level: usize) -> Option<usize> {
        let top = self.tops[level];
        (top != Self::BOTTOM).then(|| {
            self.tops[level] = self.below[top as usize];
            top as usize
        })
    }
}

fn trace(distance: &DistanceField, came_by: &[u8], start: usize, end: usize) -> Passage {
    let n_cols = distance.n_cols();
    let cell = |index: usize| Cell::new((index % n_cols) as u32, (index / n_cols) as u32);
    let mut cells = vec![cell(end)];
    let mut index = end;
    while index != start {
        let (dx, dy) = STEPS[came_by[index] as usize];
        index = index.wrapping_add_signed(-(dy as isize * n_cols as isize + dx as isize));
        cells.push(cell(index));
    }
    cells.reverse();
    let clear = |cell: &Cell| distance.distance_cells(*cell);
    let narrowest = *cells
        .iter()
        .min_by(|a, b| clear(a).total_cmp(&clear(b)))
        .unwrap_or(&cells[0]);
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
