//! Exact line of sight: every cell that a segment touches, corner contact included.
//!
//! Points are given in cell units from the map's lower left corner: cell (c, r) is the closed
//! square from (c, r) to (c + 1, r + 1).

use super::orientation::side_of_line;
use super::{BitGrid, Cell, DiagonalRule};
use crate::geometry::Point2;
use std::cmp::Ordering;

/// True if the closed segment from `a` to `b`, in cell units, is free of obstacles.
///
/// No cell that it touches may be blocked. Cells that it touches in nothing but a corner follow
/// the diagonal rule: at each corner as many of them may be blocked as beside a diagonal step.
/// Everything off the map is blocked; a segment that ends there, or at no finite point, is not
/// free. The answer is exact for the coordinates given.
///
/// ```
/// use formicar::map::{BitGrid, Cell, DiagonalRule, line_of_sight};
/// use formicar::Point2;
///
/// let mut blocked = BitGrid::new(10, 10);
/// blocked.insert(Cell::new(5, 5));
/// let sees = |y| line_of_sight(&blocked, DiagonalRule::NoObstacles, Point2::new(1.5, y), Point2::new(9.5, y));
/// assert!(sees(4.5) && !sees(5.5));
/// ```
pub fn line_of_sight(blocked: &BitGrid, rule: DiagonalRule, a: Point2, b: Point2) -> bool {
    if !on_map(blocked, a) || !on_map(blocked, b) {
        return false;
    }
    let segment = Rising::new(a, b);
    let (a, b) = (segment.a, segment.b);
    let side = |col, row| side_of_line(a, b, Point2::new(col as f64, row as f64));
    segment.is_free(blocked, rule, side)
}

/// True if the center of one cell is seen from that of another, in integer arithmetic; the same
/// answer as [`line_of_sight`] gives, several times faster.
pub fn cells_in_sight(blocked: &BitGrid, rule: DiagonalRule, from: Cell, to: Cell) -> bool {
    let (from, to) = (center(from), center(to));
    if !on_map(blocked, from) || !on_map(blocked, to) {
        return false;
    }
    let segment = Rising::new(from, to);
    // Twice a center is a small integer, and products of two stay far below 2^63.
    let double = |p: Point2| ((2.0 * p.x) as i64, (2.0 * p.y) as i64);
    let (a, b) = (double(segment.a), double(segment.b));
    let side = |col: i64, row: i64| {
        let left = (b.0 - a.0) * (2 * row - a.1);
        left.cmp(&((b.1 - a.1) * (2 * col - a.0)))
    };
    segment.is_free(blocked, rule, side)
}

/// The cells of an `n_cols` x `n_rows` grid that the closed segment from `a` to `b` touches, in
/// cell units, row by row; none if an end is off the grid.
pub fn touched_cells(a: Point2, b: Point2, n_cols: usize, n_rows: usize) -> Vec<Cell> {
    let mut cells = Vec::new();
    if !on_grid(a, n_cols, n_rows) || !on_grid(b, n_cols, n_rows) {
        return cells;
    }
    let segment = Rising::new(a, b);
    let (a, b) = (segment.a, segment.b);
    let side = |col, row| side_of_line(a, b, Point2::new(col as f64, row as f64));
    segment.all_runs(side, |run| {
        let cols = segment.map_cols(run);
        let on_grid = cols.0.max(0)..=cols.1.min(n_cols as i64 - 1);
        if (0..n_rows as i64).contains(&run.row) {
            cells.extend(on_grid.map(|col| Cell::new(col as u32, run.row as u32)));
        }
        true
    });
    cells
}

fn center(cell: Cell) -> Point2 {
    Point2::new(f64::from(cell.col) + 0.5, f64::from(cell.row) + 0.5)
}

fn on_map(map: &BitGrid, point: Point2) -> bool {
    on_grid(point, map.n_cols(), map.n_rows())
}

fn on_grid(point: Point2, n_cols: usize, n_rows: usize) -> bool {
    (0.0..=n_cols as f64).contains(&point.x) && (0.0..=n_rows as f64).contains(&point.y)
}

/// A segment swapped and mirrored so that it runs up and to the right.
struct Rising {
    a: Point2,
    b: Point2,
    /// True if columns count backward: column c of the map is column -1 - c here.
    is_mirrored: bool,
}

/// The touched cells of a row, from the first to the last column.
#[derive(Clone, Copy)]
struct Run {
    row: i64,
    first: i64,
    last: i64,
}

impl Rising {
    fn new(a: Point2, b: Point2) -> Self {
        let (a, b) = if b.y < a.y { (b, a) } else { (a, b) };
        let is_mirrored = b.x < a.x;
        let mirror = |p: Point2| Point2::new(if is_mirrored { -p.x } else { p.x }, p.y);
        Self {
            a: mirror(a),
            b: mirror(b),
            is_mirrored,
        }
    }

    /// Visits the touched cells row by row until `visit` declines; whether it never did. `side`
    /// tells on which side of the line a lattice point lies.
    ///
    /// A cell is touched if it meets the segment's bounding box and its upper left and lower right
    /// corner are not strictly on the same side. Both limits of a row only grow with the rows.
    fn all_runs(
        &self,
        side: impl Fn(i64, i64) -> Ordering,
        mut visit: impl FnMut(Run) -> bool,
    ) -> bool {
        let closed = |low: f64, high: f64| (low.ceil() as i64 - 1, high.floor() as i64);
        let (mut first, last_col) = closed(self.a.x, self.b.x);
        let (first_row, last_row) = closed(self.a.y, self.b.y);
        (first_row..=last_row).all(|row| {
            while first < last_col && side(first + 1, row) == Ordering::Greater {
                first += 1;
            }
            let mut last = first;
            while last < last_col && side(last + 1, row + 1) != Ordering::Less {
                last += 1;
            }
            visit(Run { row, first, last })
        })
    }

    fn is_free(
        &self,
        blocked: &BitGrid,
        rule: DiagonalRule,
        side: impl Fn(i64, i64) -> Ordering,
    ) -> bool {
        self.all_runs(&side, |run| {
            is_run_free(blocked, run.row, self.map_cols(run))
                || (run.first..=run.last).all(|col| {
                    let cell = (col, run.row);
                    !self.is_blocked(blocked, cell) || self.is_pardoned(blocked, rule, &side, cell)
                })
        })
    }

    /// True if a blocked cell touches the segment in a corner alone, and not too many do so there.
    fn is_pardoned(
        &self,
        blocked: &BitGrid,
        rule: DiagonalRule,
        side: &impl Fn(i64, i64) -> Ordering,
        cell: (i64, i64),
    ) -> bool {
        let Some((col, row)) = self.corner_contact(side, cell) else {
            return false;
        };
        let around = [
            (col, row),
            (col - 1, row),
            (col - 1, row - 1),
            (col, row - 1),
        ];
        let touches = |&&cell: &&(i64, i64)| {
            self.is_blocked(blocked, cell) && self.corner_contact(side, cell) == Some((col, row))
        };
        around.iter().filter(touches).count() <= rule.max_corner_obstacles()
    }

    /// The corner of a touched cell that is all it has in common with the segment, if so.
    fn corner_contact(
        &self,
        side: &impl Fn(i64, i64) -> Ordering,
        (col, row): (i64, i64),
    ) -> Option<(i64, i64)> {
        let (is_level, is_steep) = (self.a.y == self.b.y, self.a.x == self.b.x);
        let contact = |right: i64, upper: i64| {
            let corner = (col + right, row + upper);
            let place = Point2::new(corner.0 as f64, corner.1 as f64);
            // Onward the segment stays in the cell from its lower left corner, backward from its
            // upper right one; along an edge from two corners each.
            let stays = |is_lower_left: i64| {
                (right != is_lower_left || is_steep) && (upper != is_lower_left || is_level)
            };
            let leaves = (place == self.b || !stays(1)) && (place == self.a || !stays(0));
            let is_on_segment = (self.a.x..=self.b.x).contains(&place.x)
                && (self.a.y..=self.b.y).contains(&place.y)
                && side(corner.0, corner.1) == Ordering::Equal;
            (is_on_segment && leaves).then_some(corner)
        };
        [(0, 0), (1, 0), (0, 1), (1, 1)]
            .into_iter()
            .find_map(|(right, upper)| contact(right, upper))
    }

    fn is_blocked(&self, blocked: &BitGrid, (col, row): (i64, i64)) -> bool {
        let col = if self.is_mirrored { !col } else { col };
        let on_map = (0..blocked.n_cols() as i64).contains(&col)
            && (0..blocked.n_rows() as i64).contains(&row);
        !on_map || blocked.contains(col, row)
    }

    /// The columns of a run as the map counts them.
    fn map_cols(&self, run: Run) -> (i64, i64) {
        if self.is_mirrored {
            (!run.last, !run.first)
        } else {
            (run.first, run.last)
        }
    }
}

/// True if the cells of a row between two columns are all on the map and free, by whole words.
fn is_run_free(blocked: &BitGrid, row: i64, (first, last): (i64, i64)) -> bool {
    let on_map =
        first >= 0 && last < blocked.n_cols() as i64 && (0..blocked.n_rows() as i64).contains(&row);
    if !on_map {
        return false;
    }
    let (first, last) = (first as usize, last as usize);
    let words = &blocked.row(row as usize)[first / 64..=last / 64];
    let (from_first, to_last) = (u64::MAX << (first % 64), u64::MAX >> (63 - last % 64));
    match words {
        [word] => word & from_first & to_last == 0,
        [low, between @ .., high] => {
            low & from_first == 0 && high & to_last == 0 && between.iter().all(|&w| w == 0)
        }
        [] => true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::MoveMasks;
    use crate::map::neighborhood::STEPS;
    use proptest::prelude::*;

    /// True if a segment in eighths of cells touches a cell: do its parameter intervals in the
    /// cell's two slabs overlap?
    fn touches(a: [i64; 2], b: [i64; 2], cell: [i64; 2]) -> bool {
        // Fractions of the way from a to b as (numerator, positive denominator).
        let (mut low, mut high) = ((0, 1), (1, 1));
        let less = |p: (i64, i64), q: (i64, i64)| p.0 * q.1 < q.0 * p.1;
        for axis in 0..2 {
            let (from, to) = (8 * cell[axis] - a[axis], 8 * cell[axis] + 8 - a[axis]);
            let way = b[axis] - a[axis];
            if way == 0 && (from > 0 || to < 0) {
                return false;
            }
            let (enter, leave) = match way.signum() {
                1 => ((from, way), (to, way)),
                -1 => ((-to, -way), (-from, -way)),
                _ => continue,
            };
            low = if less(low, enter) { enter } else { low };
            high = if less(leave, high) { leave } else { high };
        }
        !less(high, low)
    }

    fn eighths(p: [i64; 2]) -> Point2 {
        Point2::new(p[0] as f64 / 8.0, p[1] as f64 / 8.0)
    }

    fn grid_of(n_cols: usize, n_rows: usize, bits: &[bool]) -> BitGrid {
        let mut grid = BitGrid::new(n_cols, n_rows);
        for (i, _) in bits.iter().enumerate().filter(|(_, is_set)| **is_set) {
            grid.insert(Cell::new((i % n_cols) as u32, (i / n_cols) as u32));
        }
        grid
    }

    proptest! {
        #[test]
        fn finds_every_touched_cell(ends in prop::array::uniform4(0_i64..=96)) {
            let (a, b) = ([ends[0], ends[1]], [ends[2], ends[3]]);
            let cells = (0..144).map(|i| Cell::new(i % 12, i / 12));
            let expected: Vec<_> = cells.filter(|c| touches(a, b, [c.col.into(), c.row.into()])).collect();
            prop_assert_eq!(touched_cells(eighths(a), eighths(b), 12, 12), expected);
        }

        #[test]
        fn without_corner_cutting_sight_is_freedom_of_every_touched_cell(
            ends in prop::array::uniform4(1_i64..96),
            bits in prop::collection::vec(prop::bool::weighted(0.05), 144),
        ) {
            let grid = grid_of(12, 12, &bits);
            let (a, b) = ([ends[0], ends[1]], [ends[2], ends[3]]);
            let is_free = !grid.iter().any(|c| touches(a, b, [c.col.into(), c.row.into()]));
            let seen = DiagonalRule::ALL.map(|rule| line_of_sight(&grid, rule, eighths(a), eighths(b)));
            prop_assert_eq!(seen[2], is_free);
            prop_assert!(seen[0] >= seen[1] && seen[1] >= seen[2]);
            for rule in DiagonalRule::ALL {
                let there = line_of_sight(&grid, rule, eighths(a), eighths(b));
                prop_assert_eq!(there, line_of_sight(&grid, rule, eighths(b), eighths(a)));
            }
        }

        #[test]
        fn integers_agree_with_reals(
            ends in prop::array::uniform4(0_u32..12),
            bits in prop::collection::vec(prop::bool::weighted(0.2), 144),
        ) {
            let grid = grid_of(12, 12, &bits);
            let (a, b) = (Cell::new(ends[0], ends[1]), Cell::new(ends[2], ends[3]));
            for rule in DiagonalRule::ALL {
                let expected = line_of_sight(&grid, rule, center(a), center(b));
                prop_assert_eq!(cells_in_sight(&grid, rule, a, b), expected);
            }
        }

        #[test]
        fn neighbors_are_in_sight_if_the_step_is_allowed(
            bits in prop::collection::vec(prop::bool::weighted(0.4), 36),
        ) {
            let grid = grid_of(6, 6, &bits);
            for rule in DiagonalRule::ALL {
                let moves = MoveMasks::new(&grid, rule);
                for (i, step) in (0..36 * 8).map(|i| (i / 8, i % 8)) {
                    let cell = moves.cell(i);
                    let (col, row) = (i64::from(cell.col) + i64::from(STEPS[step].0), i64::from(cell.row) + i64::from(STEPS[step].1));
                    if !(0..6).contains(&col) || !(0..6).contains(&row) {
                        continue;
                    }
                    let seen = cells_in_sight(&grid, rule, cell, Cell::new(col as u32, row as u32));
                    prop_assert_eq!(seen, moves.moves(cell) >> step & 1 == 1);
                }
            }
        }
    }

    #[test]
    fn a_wall_along_the_segment_blocks_it_and_nowhere_is_not_seen() {
        let mut grid = BitGrid::new(8, 8);
        grid.insert(Cell::new(4, 3));
        let from = Point2::new(1.0, 3.0);
        for rule in DiagonalRule::ALL {
            assert!(!line_of_sight(&grid, rule, from, Point2::new(7.0, 3.0)));
            assert!(!line_of_sight(
                &grid,
                rule,
                from,
                Point2::new(f64::NAN, 3.0)
            ));
            assert!(!line_of_sight(&grid, rule, from, Point2::new(1e300, 3.0)));
        }
        let at_its_corner = Point2::new(4.0, 3.0);
        assert!(line_of_sight(
            &grid,
            DiagonalRule::ALL[1],
            from,
            at_its_corner
        ));
        assert!(!line_of_sight(
            &grid,
            DiagonalRule::ALL[2],
            from,
            at_its_corner
        ));
    }
}
