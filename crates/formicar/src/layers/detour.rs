//! The check that closing a pocket forces no detour.

use crate::map::{BitGrid, Cell, MoveMasks, STEP_COSTS, STEPS, set_bits};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Moves around a pocket, open and closed.
pub(super) struct PocketMoves<'a> {
    /// Moves with the pocket open.
    pub(super) open: &'a MoveMasks,
    /// Moves with it closed, or that part of it which is to be closed.
    pub(super) shut: &'a MoveMasks,
    /// All cells of the pocket.
    pub(super) pocket: &'a BitGrid,
}

/// The search would take too many steps.
#[derive(Debug)]
pub(super) struct OutOfSteps;

/// Search steps granted to a pocket: a constant and a number per cell, within a limit that keeps
/// labels in 32 bits.
const STEPS_AT_LEAST: usize = 1 << 12;
const STEPS_PER_CELL: usize = 64;
const STEPS_AT_MOST: usize = 1 << 18;

/// Dijkstra's search, with memory that is reused from pocket to pocket.
///
/// A label is twice the cost of the way to a cell, and one more where every shortest way there
/// takes a step that closing forbids.
pub(super) struct Detours {
    /// Per cell its label, complemented; 0 where the search has not been.
    labels: Vec<u32>,
    reached: Vec<usize>,
    queue: BinaryHeap<Reverse<(u32, usize)>>,
    /// Queued entries that may still matter: the source, cells of the pocket, and paths that
    /// closing forbids.
    n_inner: usize,
    targets: BitGrid,
}

impl Detours {
    pub(super) fn new(n_cols: usize, n_rows: usize) -> Self {
        Self {
            labels: vec![0; n_cols * n_rows],
            reached: Vec::new(),
            queue: BinaryHeap::new(),
            n_inner: 0,
            targets: BitGrid::new(n_cols, n_rows),
        }
    }

    /// Whether closing makes some path between two cells outside of the pocket longer.
    ///
    /// The rim holds all cells outside of the pocket from which a step leads into it. Every path
    /// that closing affects leaves the outside and returns to it by cells of the rim, so these
    /// suffice.
    pub(super) fn are_needed(
        &mut self,
        moves: &PocketMoves,
        rim: &[Cell],
        n_pocket_cells: usize,
    ) -> Result<bool, OutOfSteps> {
        if is_straight(moves.shut, rim) {
            return Ok(false);
        }
        let granted = STEPS_AT_LEAST + STEPS_PER_CELL * n_pocket_cells;
        let mut n_steps = granted.min(STEPS_AT_MOST);
        self.targets.extend(rim.iter().copied());
        let mut answer = Ok(false);
        for (i, &cell) in rim.iter().enumerate() {
            self.targets.remove(cell);
            if matches!(answer, Ok(false)) {
                answer = self.search(moves, cell, rim.len() - i - 1, &mut n_steps);
                self.clear();
            }
        }
        answer
    }

    /// Whether some path from a cell to a target becomes longer. The search ends when all targets
    /// are settled, or no entry matters any more.
    fn search(
        &mut self,
        moves: &PocketMoves,
        source: Cell,
        mut n_targets: usize,
        n_steps: &mut usize,
    ) -> Result<bool, OutOfSteps> {
        self.reach(moves, source, 0);
        while n_targets > 0 {
            let Some((label, cell)) = self.settle(moves) else {
                break;
            };
            *n_steps = n_steps.checked_sub(1).ok_or(OutOfSteps)?;
            if self.targets.get(cell.col as usize, cell.row as usize) {
                if label % 2 == 1 {
                    return Ok(true);
                }
                n_targets -= 1;
            }
            self.expand(moves, label, cell);
        }
        Ok(false)
    }

    /// Takes the cell with the least label that was not settled yet.
    fn settle(&mut self, moves: &PocketMoves) -> Option<(u32, Cell)> {
        while self.n_inner > 0 {
            let Reverse((label, index)) = self.queue.pop()?;
            let cell = moves.open.cell(index);
            self.n_inner -= usize::from(is_inner(moves, label, cell));
            if self.labels[index] == !label {
                return Some((label, cell));
            }
        }
        None
    }

    fn expand(&mut self, moves: &PocketMoves, label: u32, cell: Cell) {
        let (open, shut) = (moves.open.moves(cell), moves.shut.moves(cell));
        for step in set_bits(open.into()) {
            let is_forbidden = u32::from(shut >> step & 1 == 0);
            let (dx, dy) = STEPS[step as usize];
            let next = Cell::new(
                cell.col.wrapping_add_signed(dx),
                cell.row.wrapping_add_signed(dy),
            );
            self.reach(
                moves,
                next,
                (label | is_forbidden) + 2 * STEP_COSTS[step as usize],
            );
        }
    }

    fn reach(&mut self, moves: &PocketMoves, cell: Cell, label: u32) {
        let index = moves.open.index(cell);
        if !label <= self.labels[index] {
            return;
        }
        if self.labels[index] == 0 {
            self.reached.push(index);
        }
        self.labels[index] = !label;
        self.queue.push(Reverse((label, index)));
        self.n_inner += usize::from(is_inner(moves, label, cell));
    }

    fn clear(&mut self) {
        for index in self.reached.drain(..) {
            self.labels[index] = 0;
        }
        self.queue.clear();
        self.n_inner = 0;
    }
}

fn is_inner(moves: &PocketMoves, label: u32, cell: Cell) -> bool {
    label == 0 || label % 2 == 1 || moves.pocket.get(cell.col as usize, cell.row as usize)
}

/// Whether the rim is a digital straight line that stays open: then no detour is needed.
///
/// From cell to cell it takes steps of two directions, east and north say. One of the two never
/// comes twice in a row, and wherever they alternate the diagonal step is allowed. So along the rim
/// as many steps can be diagonal as between the same two cells without obstacles, and no path
/// through the pocket is shorter.
fn is_straight(shut: &MoveMasks, rim: &[Cell]) -> bool {
    let mut cells = rim.to_vec();
    cells.sort_unstable_by_key(|cell| (cell.col, cell.row));
    if is_staircase(shut, &cells) {
        return true;
    }
    cells.sort_unstable_by_key(|cell| (cell.col, Reverse(cell.row)));
    is_staircase(shut, &cells)
}

fn is_staircase(shut: &MoveMasks, cells: &[Cell]) -> bool {
    let steps = cells.windows(2).map(|pair| step_between(pair[0], pair[1]));
    let Some(steps) = steps.collect::<Option<Vec<usize>>>() else {
        return false;
    };
    // Along an axis: 0 for columns, 2 for rows.
    let is_doubled = |axis: usize| {
        let mut pairs = steps.windows(2);
        pairs.any(|pair| pair[0] == pair[1] && pair[0] % 4 == axis)
    };
    let corners = cells.windows(3).zip(steps.windows(2));
    let mut turns = corners.filter(|(_, steps)| steps[0] != steps[1]);
    steps.iter().all(|step| step % 2 == 0)
        && !(is_doubled(0) && is_doubled(2))
        && turns.all(|(cells, _)| {
            let diagonal = step_between(cells[0], cells[2]);
            diagonal.is_some_and(|step| shut.moves(cells[0]) >> step & 1 == 1)
        })
}

/// The place in [`STEPS`] of the step from a cell to a neighbor.
fn step_between(from: Cell, to: Cell) -> Option<usize> {
    STEPS.iter().position(|&(dx, dy)| {
        let col = from.col.checked_add_signed(dx);
        (col, from.row.checked_add_signed(dy)) == (Some(to.col), Some(to.row))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::{DiagonalRule, OccupancyGrid};
    use proptest::prelude::*;

    /// Costs of the shortest ways between all cells (Floyd 1962).
    fn all_costs(moves: &MoveMasks) -> Vec<Vec<u32>> {
        let n = moves.as_slice().len();
        let mut costs = vec![vec![u32::MAX / 4; n]; n];
        for (i, costs) in costs.iter_mut().enumerate() {
            costs[i] = 0;
            for step in set_bits(moves.as_slice()[i].into()) {
                let next = i.wrapping_add_signed(moves.offsets()[step as usize]);
                costs[next] = STEP_COSTS[step as usize];
            }
        }
        for k in 0..n {
            let through = costs[k].clone();
            for from in &mut costs {
                let first = from[k];
                for (cost, onward) in from.iter_mut().zip(&through) {
                    *cost = (*cost).min(first + onward);
                }
            }
        }
        costs
    }

    fn grid(n_cols: usize, cells: impl Iterator<Item = usize>) -> BitGrid {
        let mut grid = BitGrid::new(n_cols, n_cols);
        grid.extend(cells.map(|i| Cell::new((i % n_cols) as u32, (i / n_cols) as u32)));
        grid
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(ProptestConfig::default().cases / 3))]

        #[test]
        fn equals_a_comparison_of_all_ways(
            // 0 to 4 are obstacles, 5 to 9 the pocket, of which 5 stays open.
            cells in prop::collection::vec(0_u32..24, 64),
            corner in (0_usize..6, 0_usize..6),
            rule in prop::sample::select(&DiagonalRule::ALL[..]),
        ) {
            // Half of the cases have a pocket in one piece.
            let in_block = |i: usize| {
                let (col, row) = (i % 8, i / 8);
                (corner.0..corner.0 + 3).contains(&col) && (corner.1..corner.1 + 4).contains(&row)
            };
            let is_block = cells[63] % 2 == 0;
            let is_obstacle = |i: &usize| cells[*i] < 5;
            let is_pocket = |i: &usize| !is_obstacle(i) && (if is_block { in_block(*i) } else { cells[*i] < 10 });
            let blocked = grid(8, (0..64).filter(is_obstacle));
            let pocket = grid(8, (0..64).filter(is_pocket));
            let stays_open = |i: &usize| if is_block { cells[*i] > 21 } else { cells[*i] == 5 };
            let shut = grid(8, (0..64).filter(|i| is_obstacle(i) || is_pocket(i) && !stays_open(i)));
            let (open, shut) = (MoveMasks::new(&blocked, rule), MoveMasks::new(&shut, rule));
            let outside: Vec<usize> = (0..64).filter(|i| !is_obstacle(i) && !is_pocket(i)).collect();

            let (before, after) = (all_costs(&open), all_costs(&shut));
            let mut pairs = outside.iter().flat_map(|&u| outside.iter().map(move |&v| (u, v)));
            let expected = pairs.any(|(u, v)| before[u][v] != after[u][v]);
            let leads_in = |cell: &Cell| {
                let mut steps = set_bits(open.moves(*cell).into());
                let index = open.index(*cell);
                steps.any(|step| is_pocket(&index.wrapping_add_signed(open.offsets()[step as usize])))
            };
            let rim: Vec<Cell> = outside.iter().map(|&i| open.cell(i)).filter(leads_in).collect();
            let around = PocketMoves { open: &open, shut: &shut, pocket: &pocket };
            let mut detours = Detours::new(8, 8);
            for _ in 0..2 {
                // The second time with the memory of the first.
                let found = detours.are_needed(&around, &rim, 1000).unwrap();
                prop_assert_eq!(found, expected);
            }
        }
    }

    #[test]
    fn digital_lines_are_straight_if_nothing_stands_at_their_turns() {
        let is_straight_in = |rows: &[&str]| {
            let map = OccupancyGrid::from_rows(rows, 1.0).unwrap();
            let moves = MoveMasks::new(&map.lethal_cells(), DiagonalRule::NoObstacles);
            let drawn = rows.iter().rev().zip(0..).flat_map(|(row, y)| {
                let cols = row.chars().zip(0..).filter(|(c, _)| *c == 'o');
                cols.map(move |(_, x)| Cell::new(x, y))
            });
            is_straight(&moves, &drawn.collect::<Vec<_>>())
        };
        assert!(!is_straight_in(&["......", "...ooo", "ooo...", "......"]));
        assert!(is_straight_in(&["......", "..oooo", "ooo...", "......"]));
        assert!(!is_straight_in(&["ooo...", "..oo..", "...o..", "...o.."]));
        assert!(is_straight_in(&["oo....", ".oo...", "..oo..", "......"]));
        assert!(is_straight_in(&[".#....", "..oooo", "ooo...", "......"]));
        assert!(!is_straight_in(&[".#....", ".#oooo", "ooo...", "......"]));
        assert!(!is_straight_in(&["o.....", "o.....", "ooo...", "......"]));
        assert!(is_straight_in(&["o....."]) && is_straight_in(&["oooooo"]));
    }
}
