//! The cost of the way to a goal from every cell (Dijkstra 1959, in buckets).

use super::cost::{DIAGONAL_COST, MAX_COST, STEP_COSTS, STRAIGHT_COST};
use super::grid_search::{GridSearch, SearchError, check_end};
use crate::map::{Cell, MoveMasks};
use crate::progress::{Limits, Status};

/// Cost to go from each cell to the nearest of some goals along allowed moves.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GoalField {
    costs: Vec<u32>,
    n_cols: usize,
}

/// Cost of a cell from which no goal is reached.
const UNREACHED: u32 = u32::MAX;

/// Cells expanded between two checks of room in the buckets.
const CHUNK: usize = 256;

impl GoalField {
    /// Measures the way to `goals` from every cell that reaches one.
    ///
    /// Costs are sorted into buckets as wide as a straight step, the shortest there is: no cell of
    /// a bucket can improve another of the same one (Dinitz 1978). A step of the limits is a cell
    /// expanded. Four bytes per cell.
    ///
    /// # Errors
    /// A goal off the map or blocked; budget, deadline or cancel; ways longer than about four
    /// million cells.
    pub fn new(
        moves: &MoveMasks,
        goals: &[Cell],
        limits: &mut Limits,
    ) -> Result<Self, SearchError> {
        let mut costs = vec![UNREACHED; moves.as_slice().len()];
        let mut wave = Bucket::default();
        for &goal in goals {
            check_end(moves, "goal", goal)?;
            costs[moves.index(goal)] = 0;
            wave.reserve(1);
            wave.push_if(true, moves.index(goal));
        }
        let mut spread = Spread {
            costs,
            masks: moves.as_slice(),
            offsets: moves.offsets(),
        };
        let (mut next, mut after_next) = (Bucket::default(), Bucket::default());
        let mut floor = 0;
        while wave.n_cells + next.n_cells > 0 {
            for cells in wave.cells[..wave.n_cells].chunks(CHUNK) {
                next.reserve(8 * CHUNK);
                after_next.reserve(4 * CHUNK);
                for &cell in cells {
                    limits.step()?;
                    spread.expand(cell as usize, floor, &mut next, &mut after_next);
                }
            }
            if floor > MAX_COST - 2 * STRAIGHT_COST {
                return Err(SearchError::TOO_LONG);
            }
            floor += STRAIGHT_COST;
            wave.n_cells = 0;
            (wave, next, after_next) = (next, after_next, wave);
        }
        Ok(Self {
            costs: spread.costs,
            n_cols: moves.n_cols(),
        })
    }

    /// Cost to go from a cell in units of [`STRAIGHT_COST`] per cell; none if no goal is reached.
    pub fn cost(&self, cell: Cell) -> Option<u32> {
        let cost = self.costs[cell.row as usize * self.n_cols + cell.col as usize];
        (cost != UNREACHED).then_some(cost)
    }

    /// Length of the shortest way from a cell to a goal in cells, to 3e-7 of itself.
    pub fn distance_cells(&self, cell: Cell) -> Option<f64> {
        self.cost(cell)
            .map(|cost| f64::from(cost) / f64::from(STRAIGHT_COST))
    }

    /// Costs of all cells, row by row; `u32::MAX` where no goal is reached.
    pub fn costs(&self) -> &[u32] {
        &self.costs
    }

    /// A shortest path from a cell to its nearest goal: downhill along allowed moves, straight on
    /// where possible.
    ///
    /// `moves` are those that the field was made with.
    ///
    /// # Errors
    /// A start off the map or blocked, or no way to a goal.
    pub fn path(&self, moves: &MoveMasks, start: Cell) -> Result<GridSearch, SearchError> {
        check_end(moves, "start", start)?;
        let offsets = moves.offsets();
        let mut search = GridSearch::default();
        let (mut index, mut last_step) = (moves.index(start), 0);
        search.path.cells.push(start);
        while self.costs[index] != 0 {
            let step = self
                .downhill(moves, &offsets, index, last_step)
                .ok_or(Status::NoPath)?;
            index = index.wrapping_add_signed(offsets[step]);
            search.count_step(step);
            search.path.cells.push(moves.cell(index));
            last_step = step;
        }
        Ok(search)
    }

    /// A step that lowers the cost to go by its own cost: the preferred one, else the first.
    fn downhill(
        &self,
        moves: &MoveMasks,
        offsets: &[isize; 8],
        index: usize,
        preferred: usize,
    ) -> Option<usize> {
        let here = self.costs[index];
        let leads_down = |&step: &usize| {
            let is_allowed = moves.as_slice()[index] >> step & 1 == 1;
            is_allowed && here != UNREACHED && {
                let there = self.costs[index.wrapping_add_signed(offsets[step])];
                there != UNREACHED && there + STEP_COSTS[step] == here
            }
        };
        std::iter::once(preferred).chain(0..8).find(leads_down)
    }
}

/// Cells waiting, with room kept behind them so that a push is a plain write.
#[derive(Default)]
struct Bucket {
    cells: Vec<u32>,
    n_cells: usize,
}

impl Bucket {
    fn reserve(&mut self, n_more: usize) {
        if self.cells.len() < self.n_cells + n_more {
            let n_room = (self.n_cells + n_more).next_power_of_two();
            self.cells.resize(n_room, 0);
        }
    }

    /// Writes the cell and keeps it if it is wanted; there must be room.
    fn push_if(&mut self, is_wanted: bool, cell: usize) {
        self.cells[self.n_cells] = cell as u32;
        self.n_cells += usize::from(is_wanted);
    }
}

/// The front as it moves outward.
struct Spread<'a> {
    costs: Vec<u32>,
    masks: &'a [u8],
    offsets: [isize; 8],
}

impl Spread<'_> {
    /// Offers a way through a cell of the bucket from `floor` on to its neighbors.
    fn expand(&mut self, index: usize, floor: u32, next: &mut Bucket, after_next: &mut Bucket) {
        let (cost, mask) = (self.costs[index], self.masks[index]);
        if cost < floor {
            // Reached by a shorter way since it was queued, and expanded then.
            return;
        }
        // Branchless: a step that is not allowed leads from the cell to itself, which is no gain.
        let target = |step: usize| {
            let is_allowed = isize::from(mask >> step & 1 == 1);
            index.wrapping_add_signed(self.offsets[step] & -is_allowed)
        };
        let straight = [0, 2, 4, 6].map(target);
        let diagonal = [1, 3, 5, 7].map(target);
        self.offer(straight, cost + STRAIGHT_COST, next);
        let is_next = cost + DIAGONAL_COST < floor + 2 * STRAIGHT_COST;
        let bucket = if is_next { next } else { after_next };
        self.offer(diagonal, cost + DIAGONAL_COST, bucket);
    }

    #[inline]
    fn offer(&mut self, targets: [usize; 4], cost: u32, bucket: &mut Bucket) {
        for to in targets {
            let known = self.costs[to];
            self.costs[to] = known.min(cost);
            bucket.push_if(cost < known, to);
        }
    }
}
