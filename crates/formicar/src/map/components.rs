//! Connected components of free cells.

use super::{BitGrid, Cell, Connectivity};
use std::ops::Range;

/// Connected components of the free cells, numbered in the order of their first cells, row by row.
///
/// ```
/// use formicar::OccupancyGrid;
/// use formicar::map::{Cell, Components, Connectivity};
///
/// let map = OccupancyGrid::from_rows(&["..#.", "..#."], 1.0)?;
/// let components = Components::new(&map.lethal_cells(), Connectivity::Eight);
/// assert_eq!(components.n_components(), 2);
/// assert!(!components.same(Cell::new(0, 0), Cell::new(3, 0)));
/// # Ok::<(), formicar::MapError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Components {
    /// Runs of free cells, row by row.
    runs: Vec<Run>,
    /// Where each row's runs start, with the end of the last.
    row_starts: Vec<usize>,
    /// The component of each run.
    labels: Vec<u32>,
    sizes: Vec<u32>,
}

/// Rows, and runs, between two questions whether to go on.
const ROWS_PER_LOOK: usize = 64;
const RUNS_PER_LOOK: usize = 1024;

/// Free cells of a row from column `first` up to, but not including, `end`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Run {
    first: u32,
    end: u32,
}

impl Components {
    /// Labels the cells that are not blocked: runs of each row, joined with those of the row below
    /// in a forest of disjoint sets.
    pub fn new(blocked: &BitGrid, connectivity: Connectivity) -> Self {
        Self::new_while(blocked, connectivity, &mut || true)
    }

    /// The same, where `goes_on` is asked on the way whether to go on; of no use where it said no.
    pub(crate) fn new_while(
        blocked: &BitGrid,
        connectivity: Connectivity,
        goes_on: &mut dyn FnMut() -> bool,
    ) -> Self {
        let (runs, row_starts) = free_runs(blocked, goes_on);
        let mut sets: Vec<u32> = (0..runs.len() as u32).collect();
        for (i, rows) in row_starts.windows(3).enumerate() {
            if i.is_multiple_of(ROWS_PER_LOOK) && !goes_on() {
                break;
            }
            let (below, above) = (rows[0]..rows[1], rows[1]..rows[2]);
            join_rows(&runs, &mut sets, (below, above), connectivity);
        }
        let mut components = Self {
            labels: Vec::with_capacity(runs.len()),
            runs,
            row_starts,
            sizes: Vec::new(),
        };
        components.label_runs(&mut sets, goes_on);
        components
    }

    /// Number of components.
    pub fn n_components(&self) -> usize {
        self.sizes.len()
    }

    /// The component of a cell, in `0..n_components`; none if the cell is blocked.
    pub fn label(&self, cell: Cell) -> Option<u32> {
        let row = self.row_starts.get(cell.row as usize..)?;
        let row = *row.first()?..*row.get(1)?;
        let n_before = self.runs[row.clone()].partition_point(|run| run.end <= cell.col);
        let place = row.start + n_before;
        let is_free = place < row.end && self.runs[place].first <= cell.col;
        self.labels.get(place).copied().filter(|_| is_free)
    }

    /// Cells of each component.
    pub fn sizes(&self) -> &[u32] {
        &self.sizes
    }

    /// The component with the most cells, the first of several; none if all cells are blocked.
    pub fn largest(&self) -> Option<u32> {
        let sizes = self.sizes.iter().enumerate().rev();
        sizes.max_by_key(|&(_, size)| size).map(|(i, _)| i as u32)
    }

    /// True if two cells are free and in one component.
    pub fn same(&self, a: Cell, b: Cell) -> bool {
        self.label(a)
            .is_some_and(|label| self.label(b) == Some(label))
    }

    /// Numbers the sets of runs.
    fn label_runs(&mut self, sets: &mut [u32], goes_on: &mut dyn FnMut() -> bool) {
        for (i, run) in self.runs.iter().enumerate() {
            if i.is_multiple_of(RUNS_PER_LOOK) && !goes_on() {
                return;
            }
            // The leader is the set's first run, so it is labeled before the others.
            let root = find(sets, i as u32) as usize;
            let label = self.labels.get(root).copied().unwrap_or_else(|| {
                self.sizes.push(0);
                self.sizes.len() as u32 - 1
            });
            self.labels.push(label);
            self.sizes[label as usize] += run.end - run.first;
        }
    }
}

/// All runs row by row, and where each row's runs start, with the end of the last.
fn free_runs(blocked: &BitGrid, goes_on: &mut dyn FnMut() -> bool) -> (Vec<Run>, Vec<usize>) {
    let mut runs = Vec::new();
    let mut row_starts = vec![0];
    for row in 0..blocked.n_rows() {
        if row.is_multiple_of(ROWS_PER_LOOK) && !goes_on() {
            break;
        }
        runs.extend(blocked.gaps(row).map(|gap| Run {
            first: gap.start as u32,
            end: gap.end as u32,
        }));
        row_starts.push(runs.len());
    }
    (runs, row_starts)
}

/// Joins the runs of two rows, each from left to right, where they are next to each other.
fn join_rows(
    runs: &[Run],
    sets: &mut [u32],
    (below, above): (Range<usize>, Range<usize>),
    connectivity: Connectivity,
) {
    let reach = match connectivity {
        Connectivity::Four => 0,
        Connectivity::Eight => 1,
    };
    let (mut i, mut j) = (below.start, above.start);
    while i < below.end && j < above.end {
        let (lower, upper) = (runs[i], runs[j]);
        if lower.first < upper.end + reach && upper.first < lower.end + reach {
            let (a, b) = (find(sets, i as u32), find(sets, j as u32));
            // The earlier run leads, so that numbering is by first cells.
            sets[a.max(b) as usize] = a.min(b);
        }
        if lower.end < upper.end {
            i += 1;
        } else {
            j += 1;
        }
    }
}

/// The leader of a run's set; halves the way to it.
fn find(sets: &mut [u32], run: u32) -> u32 {
    let mut i = run as usize;
    while sets[i] as usize != i {
        sets[i] = sets[sets[i] as usize];
        i = sets[i] as usize;
    }
    i as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::OccupancyGrid;
    use proptest::prelude::*;

    fn components(rows: &[&str], connectivity: Connectivity) -> Components {
        let map = OccupancyGrid::from_rows(rows, 1.0).unwrap();
        Components::new(&map.lethal_cells(), connectivity)
    }

    #[test]
    fn corners_join_eight_but_not_four() {
        let rows = ["..#.", "##.#", "...."];
        let (four, eight) = (
            components(&rows, Connectivity::Four),
            components(&rows, Connectivity::Eight),
        );
        assert_eq!(four.sizes(), [5, 2, 1]);
        assert_eq!(eight.sizes(), [8]);
        assert_eq!(four.largest(), Some(0));
        assert!(four.same(Cell::new(0, 0), Cell::new(2, 1)));
        assert!(!four.same(Cell::new(0, 0), Cell::new(0, 2)));
        assert!(!eight.same(Cell::new(2, 2), Cell::new(2, 2)), "blocked");
    }

    /// Spreads from every free cell that has no label yet.
    fn flooded(blocked: &BitGrid, connectivity: Connectivity) -> Vec<Option<u32>> {
        let (n_cols, n_rows) = (blocked.n_cols(), blocked.n_rows());
        let place = |c: Cell| c.row as usize * n_cols + c.col as usize;
        let mut labels = vec![None; n_cols * n_rows];
        let mut n_labels = 0;
        for i in 0..n_cols * n_rows {
            let cell = Cell::new((i % n_cols) as u32, (i / n_cols) as u32);
            let mut open = vec![cell];
            let n_before = labels.iter().flatten().count();
            while let Some(cell) = open.pop() {
                let is_new = labels[place(cell)].is_none();
                if is_new && !blocked.get(cell.col as usize, cell.row as usize) {
                    labels[place(cell)] = Some(n_labels);
                    open.extend(connectivity.neighbors(cell, n_cols, n_rows));
                }
            }
            n_labels += u32::from(labels.iter().flatten().count() > n_before);
        }
        labels
    }

    proptest! {
        #[test]
        fn equals_a_flood(
            n_cols in 1_usize..140,
            bits in prop::collection::vec(prop::bool::weighted(0.4), 1..400),
        ) {
            let n_rows = bits.len().div_ceil(n_cols);
            let mut blocked = BitGrid::new(n_cols, n_rows);
            for (i, _) in bits.iter().enumerate().filter(|(_, is_set)| **is_set) {
                blocked.insert(Cell::new((i % n_cols) as u32, (i / n_cols) as u32));
            }
            for connectivity in [Connectivity::Four, Connectivity::Eight] {
                let components = Components::new(&blocked, connectivity);
                let cells = (0..n_cols * n_rows).map(|i| Cell::new((i % n_cols) as u32, (i / n_cols) as u32));
                let labels: Vec<_> = cells.map(|cell| components.label(cell)).collect();
                prop_assert_eq!(labels, flooded(&blocked, connectivity));
                let n_free = components.sizes().iter().sum::<u32>() as usize;
                prop_assert_eq!(n_free + blocked.count(), n_cols * n_rows);
            }
        }
    }
}
