//! Pockets: the free cells between an obstacle and its convex hull.

use super::hull::{Span, hull_spans};
use crate::map::{BitGrid, Cell, Components, Connectivity};
use std::ops::Range;

/// Cells of a row from column `first` up to, but not including, `end`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Run {
    pub(super) row: u32,
    pub(super) first: u32,
    pub(super) end: u32,
}

impl Run {
    pub(super) fn cells(self) -> impl Iterator<Item = Cell> {
        (self.first..self.end).map(move |col| Cell::new(col, self.row))
    }

    pub(super) fn contains(self, cell: Cell) -> bool {
        cell.row == self.row && (self.first..self.end).contains(&cell.col)
    }

    fn n_cells(self) -> u32 {
        self.end - self.first
    }
}

/// All pockets of a map.
#[derive(Clone, Debug, Default)]
pub(super) struct Pockets {
    runs: Vec<Run>,
    /// Per pocket its number of cells and its runs.
    pockets: Vec<(u32, Range<usize>)>,
}

impl Pockets {
    /// Looks at every 8-connected obstacle: its pockets are the 4-connected free cells whose
    /// centers lie in the convex hull of its cell centers.
    ///
    /// Cost is proportional to the cells of the map and of the boxes around its obstacles. Every
    /// obstacle `goes_on` is asked whether to go on.
    pub(super) fn find(blocked: &BitGrid, goes_on: &mut dyn FnMut() -> bool) -> Self {
        let obstacles = Components::new(&blocked.complement(), Connectivity::Eight);
        let outlines = Outlines::new(blocked, &obstacles);
        let mut pockets = Self::default();
        for (label, &n_cells) in obstacles.sizes().iter().enumerate() {
            if !goes_on() {
                break;
            }
            let hull = hull_spans(outlines.of(label));
            let n_in_hull: usize = hull.iter().map(|span| span.n_cells()).sum();
            if n_in_hull > n_cells as usize {
                pockets.add_free_cells(blocked, outlines.first_rows[label], &hull);
            }
        }
        pockets
    }

    /// The runs of every pocket, the largest pocket first, among equals by first cell.
    pub(super) fn largest_first(mut self) -> impl Iterator<Item = Vec<Run>> {
        let Self { runs, pockets } = &mut self;
        pockets.sort_by(|(a, a_runs), (b, b_runs)| {
            b.cmp(a).then(runs[a_runs.start].cmp(&runs[b_runs.start]))
        });
        let Self { runs, pockets } = self;
        pockets
            .into_iter()
            .map(move |(_, range)| runs[range].to_vec())
    }

    /// Adds the 4-connected components of the free cells in a hull.
    fn add_free_cells(&mut self, blocked: &BitGrid, first_row: u32, hull: &[Span]) {
        let first_col = hull.iter().map(|span| span.first).min().unwrap_or(0);
        let shut = shut_in_box(blocked, Cell::new(first_col, first_row), hull);
        let pockets = Components::new(&shut, Connectivity::Four);
        let mut labeled: Vec<(u32, Run)> = Vec::new();
        for row in 0..shut.n_rows() {
            labeled.extend(shut.gaps(row).filter_map(|gap| {
                let label = pockets.label(Cell::new(gap.start as u32, row as u32))?;
                let run = Run {
                    row: first_row + row as u32,
                    first: first_col + gap.start as u32,
                    end: first_col + gap.end as u32,
                };
                Some((label, run))
            }));
        }
        labeled.sort_unstable();
        for pocket in labeled.chunk_by(|a, b| a.0 == b.0) {
            let first_run = self.runs.len();
            self.runs.extend(pocket.iter().map(|(_, run)| *run));
            let n_cells = pocket.iter().map(|(_, run)| run.n_cells()).sum();
            self.pockets.push((n_cells, first_run..self.runs.len()));
        }
    }
}

/// The box around a hull, from its lowest column and row on; free cells in the hull are open.
fn shut_in_box(blocked: &BitGrid, corner: Cell, hull: &[Span]) -> BitGrid {
    let end = hull.iter().map(|span| span.last + 1).max().unwrap_or(0);
    let mut shut = BitGrid::new((end - corner.col) as usize, hull.len());
    for (i, span) in hull.iter().enumerate() {
        let row = blocked.row(corner.row as usize + i);
        let (first, last) = (span.first - corner.col, span.last - corner.col);
        for (w, word) in shut.row_mut(i).iter_mut().enumerate() {
            let in_hull = ones_from(first, w) & !ones_from(last + 1, w);
            *word = word_at(row, corner.col as usize + 64 * w) | !in_hull;
        }
    }
    shut.clear_padding();
    shut
}

/// The bits of word `w` of a row from a column on.
fn ones_from(col: u32, w: usize) -> u64 {
    let place = i64::from(col) - 64 * w as i64;
    match place {
        64.. => 0,
        1.. => u64::MAX << place,
        _ => u64::MAX,
    }
}

/// 64 bits of a row from a column on; zeros past its end.
fn word_at(row: &[u64], col: usize) -> u64 {
    let word = |w: usize| row.get(w).copied().unwrap_or(0);
    let (w, shift) = (col / 64, col % 64);
    match shift {
        0 => word(w),
        _ => word(w) >> shift | word(w + 1) << (64 - shift),
    }
}

/// First and last column of every obstacle in each of its rows.
struct Outlines {
    first_rows: Vec<u32>,
    /// Start of the spans of each obstacle, with the end of the last.
    starts: Vec<usize>,
    spans: Vec<Span>,
}

impl Outlines {
    fn new(blocked: &BitGrid, obstacles: &Components) -> Self {
        let runs = || labeled_runs(blocked, obstacles);
        let n = obstacles.n_components();
        let mut rows = vec![(u32::MAX, 0); n];
        for (label, run) in runs() {
            let (first, last) = rows[label];
            rows[label] = (run.row.min(first), run.row.max(last));
        }
        let mut starts = vec![0];
        for (first, last) in &rows {
            starts.push(starts[starts.len() - 1] + (last - first + 1) as usize);
        }
        let nothing = Span {
            first: u32::MAX,
            last: 0,
        };
        let mut spans = vec![nothing; starts[n]];
        for (label, run) in runs() {
            let span = &mut spans[starts[label] + (run.row - rows[label].0) as usize];
            span.first = span.first.min(run.first);
            span.last = span.last.max(run.end - 1);
        }
        Self {
            first_rows: rows.into_iter().map(|(first, _)| first).collect(),
            starts,
            spans,
        }
    }

    fn of(&self, label: usize) -> &[Span] {
        &self.spans[self.starts[label]..self.starts[label + 1]]
    }
}

/// Every run of blocked cells with the obstacle that it belongs to.
fn labeled_runs<'a>(
    blocked: &'a BitGrid,
    obstacles: &'a Components,
) -> impl Iterator<Item = (usize, Run)> + 'a {
    (0..blocked.n_rows()).flat_map(move |row| {
        blocked.runs(row).filter_map(move |run| {
            let run = Run {
                row: row as u32,
                first: run.start as u32,
                end: run.end as u32,
            };
            let label = obstacles.label(Cell::new(run.first, run.row))?;
            Some((label as usize, run))
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::OccupancyGrid;

    /// The map with the cells of each pocket lettered, the largest `a`.
    fn pockets(rows: &[&str]) -> Vec<String> {
        let map = OccupancyGrid::from_rows(rows, 1.0).unwrap();
        let mut drawn: Vec<Vec<char>> = rows.iter().map(|row| row.chars().collect()).collect();
        let found = Pockets::find(&map.lethal_cells(), &mut || true);
        for (pocket, letter) in found.largest_first().zip('a'..) {
            for cell in pocket.into_iter().flat_map(Run::cells) {
                drawn[rows.len() - 1 - cell.row as usize][cell.col as usize] = letter;
            }
        }
        drawn.into_iter().map(String::from_iter).collect()
    }

    #[test]
    fn pockets_lie_between_the_arms_and_on_the_line_between_their_ends() {
        let found = pockets(&[
            "..........", //
            ".#........",
            ".#........",
            ".#...#....",
            ".#...#..#.",
            ".#####.#..",
            "........#.",
        ]);
        let expected = [
            "..........", //
            ".#........",
            ".#aa......",
            ".#aaa#....",
            ".#aaa#..#.",
            ".#####.#b.",
            "........#.",
        ];
        assert_eq!(found, expected);
    }

    #[test]
    fn an_obstacle_in_a_pocket_is_no_part_of_it() {
        let found = pockets(&["#.....#", "#..#..#", "#.....#", "#######"]);
        assert_eq!(found, ["#aaaaa#", "#aa#aa#", "#aaaaa#", "#######"]);
    }

    #[test]
    fn equals_the_definition_on_wide_maps() {
        // The box of the U begins and ends within words.
        let mut blocked = BitGrid::new(300, 5);
        for col in 70..=250 {
            blocked.insert(Cell::new(col, 1));
        }
        for (col, row) in [(70, 2), (250, 2), (250, 3), (70, 3)] {
            blocked.insert(Cell::new(col, row));
        }
        let found: Vec<_> = Pockets::find(&blocked, &mut || true)
            .largest_first()
            .collect();
        let run = |row| Run {
            row,
            first: 71,
            end: 250,
        };
        assert_eq!(found, [vec![run(2), run(3)]]);
    }
}
