//! A map whose pockets are closed one by one, each on trial first.

use super::detour::{Detours, OutOfSteps, PocketMoves};
use super::pocket_fate::PocketFate;
use super::pockets::Run;
use crate::map::{BitGrid, Cell, DiagonalRule, MoveMasks, STEPS, set_bits};
use std::ops::Range;

/// The cells of a pocket that are open, and the columns and rows that they take.
pub(super) struct OpenPocket {
    pub(super) cells: Vec<Cell>,
    cols: Range<usize>,
    rows: Range<usize>,
}

impl OpenPocket {
    /// The cells of some runs that are not blocked; none if all are.
    pub(super) fn new(runs: &[Run], blocked: &BitGrid) -> Option<Self> {
        let is_open = |cell: &Cell| !blocked.get(cell.col as usize, cell.row as usize);
        let cells = runs.iter().flat_map(|run| run.cells()).filter(is_open);
        let cells: Vec<Cell> = cells.collect();
        let cols = || cells.iter().map(|cell| cell.col as usize);
        Some(Self {
            cols: cols().min()?..cols().max()? + 1,
            rows: cells.first()?.row as usize..cells.last()?.row as usize + 1,
            cells,
        })
    }
}

/// The map between two pockets, or with one on trial.
pub(super) struct Closing {
    /// Moves with the pocket on trial open.
    open: MoveMasks,
    /// Moves with it closed; the same as `open` between two pockets.
    shut: MoveMasks,
    /// Its cells; none between two pockets.
    pocket: BitGrid,
    detours: Detours,
}

impl Closing {
    pub(super) fn new(blocked: &BitGrid, rule: DiagonalRule) -> Self {
        let (n_cols, n_rows) = (blocked.n_cols(), blocked.n_rows());
        let open = MoveMasks::new(blocked, rule);
        Self {
            shut: open.clone(),
            open,
            pocket: BitGrid::new(n_cols, n_rows),
            detours: Detours::new(n_cols, n_rows),
        }
    }

    /// The cells that are blocked, or closed by now.
    pub(super) fn blocked(&self) -> &BitGrid {
        self.open.blocked()
    }

    /// Closes a pocket if that forces no detour; returns its fate and the closed cells.
    pub(super) fn try_close(&mut self, pocket: &OpenPocket) -> (PocketFate, Vec<Cell>) {
        self.pocket.extend(pocket.cells.iter().copied());
        let rim = self.rim(pocket);
        let fate = if rim.is_empty() {
            PocketFate::NoMouth
        } else {
            self.shut(pocket);
            self.spare_corners(pocket, &rim);
            self.fate(pocket, &rim)
        };
        (fate, self.conclude(pocket, fate))
    }

    /// The open cells outside of the pocket from which a step leads into it, row by row.
    fn rim(&self, pocket: &OpenPocket) -> Vec<Cell> {
        let grown =
            |range: &Range<usize>, n: usize| range.start.saturating_sub(1)..(range.end + 1).min(n);
        let cols = grown(&pocket.cols, self.open.n_cols());
        let words = cols.start / 64..cols.end.div_ceil(64);
        let mut rim = Vec::new();
        for row in grown(&pocket.rows, self.open.n_rows()) {
            for w in words.clone() {
                let near = self.near_pocket(row, w) & !self.pocket.row(row)[w];
                let cells = set_bits(near).map(|bit| Cell::new((64 * w) as u32 + bit, row as u32));
                rim.extend(cells.filter(|&cell| self.leads_in(cell)));
            }
        }
        rim
    }

    /// Word `w` of a row of the pocket and the cells around it; bits past the last column too.
    fn near_pocket(&self, row: usize, w: usize) -> u64 {
        let rows = row.saturating_sub(1)..(row + 2).min(self.pocket.n_rows());
        let three_rows = |w: usize| {
            let words = rows.clone().filter_map(|row| self.pocket.row(row).get(w));
            words.fold(0, |all, word| all | word)
        };
        let (here, after) = (three_rows(w), three_rows(w + 1));
        let before = w.checked_sub(1).map_or(0, three_rows);
        here | here << 1 | before >> 63 | here >> 1 | after << 63
    }

    /// Whether a cell is one of the map and a step leads from it into the pocket.
    fn leads_in(&self, cell: Cell) -> bool {
        (cell.col as usize) < self.open.n_cols() && {
            let mut steps = set_bits(self.open.moves(cell).into());
            steps.any(|step| self.is_in_pocket(moved(cell, STEPS[step as usize])))
        }
    }

    fn is_in_pocket(&self, cell: Cell) -> bool {
        self.pocket.get(cell.col as usize, cell.row as usize)
    }

    fn is_shut(&self, cell: Cell) -> bool {
        self.shut
            .blocked()
            .get(cell.col as usize, cell.row as usize)
    }

    /// Closes the whole pocket on trial.
    fn shut(&mut self, pocket: &OpenPocket) {
        let (cols, rows) = (pocket.cols.clone(), pocket.rows.clone());
        self.shut.change(cols, rows, |blocked| {
            blocked.extend(pocket.cells.iter().copied());
        });
    }

    /// Leaves the cells open that the diagonal rule needs for a diagonal step from rim to rim:
    /// otherwise only horizontal and vertical mouths could be closed.
    fn spare_corners(&mut self, pocket: &OpenPocket, rim: &[Cell]) {
        let mut spared = Vec::new();
        for &cell in rim {
            let lost = self.open.moves(cell) & !self.shut.moves(cell);
            let lost = set_bits(lost.into()).map(|step| STEPS[step as usize]);
            for (dx, dy) in lost.filter(|&step| !self.is_in_pocket(moved(cell, step))) {
                let beside = [moved(cell, (dx, 0)), moved(cell, (0, dy))];
                spared.extend(beside.into_iter().filter(|&cell| self.is_in_pocket(cell)));
            }
        }
        if !spared.is_empty() {
            let (cols, rows) = (pocket.cols.clone(), pocket.rows.clone());
            self.shut
                .change(cols, rows, |blocked| blocked.remove_all(spared));
        }
    }

    /// The effect of closing the pocket as tried.
    fn fate(&mut self, pocket: &OpenPocket, rim: &[Cell]) -> PocketFate {
        if !pocket.cells.iter().any(|&cell| self.is_shut(cell)) {
            return PocketFate::WouldHarm;
        }
        let moves = PocketMoves {
            open: &self.open,
            shut: &self.shut,
            pocket: &self.pocket,
        };
        match self.detours.are_needed(&moves, rim, pocket.cells.len()) {
            Ok(false) => PocketFate::Closed,
            Ok(true) => PocketFate::WouldHarm,
            Err(OutOfSteps) => PocketFate::TooIntricate,
        }
    }

    /// Ends the trial: makes both sets of moves the same, and forgets the pocket.
    fn conclude(&mut self, pocket: &OpenPocket, fate: PocketFate) -> Vec<Cell> {
        let cells = pocket.cells.iter().copied();
        let shut: Vec<Cell> = cells.filter(|&cell| self.is_shut(cell)).collect();
        self.pocket.remove_all(pocket.cells.iter().copied());
        let (cols, rows) = (pocket.cols.clone(), pocket.rows.clone());
        if fate == PocketFate::Closed {
            self.open
                .change(cols, rows, |blocked| blocked.extend(shut.iter().copied()));
            return shut;
        }
        self.shut
            .change(cols, rows, |blocked| blocked.remove_all(shut));
        Vec::new()
    }
}

/// The cell that an allowed step leads to, or one beside its corner.
fn moved(cell: Cell, (dx, dy): (i32, i32)) -> Cell {
    Cell::new(
        cell.col.wrapping_add_signed(dx),
        cell.row.wrapping_add_signed(dy),
    )
}
