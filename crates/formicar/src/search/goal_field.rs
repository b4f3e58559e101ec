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
    /// a bucket can improve another of the same one (Dinitz 1978). On open ground a cell hands on
    /// only along canonical directions. A step of the limits is a cell
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
        Self::spread(moves, goals, |_, _| true, limits)
    }

    /// The way to a start from the cells of a corridor: those that lie on some way from the start
    /// to this field's goals which costs at most `ratio`, at least 1, times the least. All other
    /// cells count as not reached.
    ///
    /// `moves` are those that this field was made with. Every shortest way from the start to a cell
    /// of the corridor lies in it, so that the front need not leave it: time is in proportion to
    /// the corridor, but for clearing four bytes per cell. A step of the limits is a cell expanded.
    ///
    /// # Errors
    /// A start off the map or blocked, or without a way to a goal; budget, deadline or cancel.
    pub fn corridor(
        &self,
        moves: &MoveMasks,
        start: Cell,
        ratio: f64,
        limits: &mut Limits,
    ) -> Result<Self, SearchError> {
        check_end(moves, "start", start)?;
        let least = self.cost(start).ok_or(Status::NoPath)?;
        let most = (f64::from(least) * ratio) as u32;
        let keeps = |to: usize, cost: u32| cost.saturating_add(self.costs[to]) <= most;
        Self::spread(moves, &[start], keeps, limits)
    }

    /// Spreads from goals over the cells that `keeps` wants, given their place and their cost.
    fn spread(
        moves: &MoveMasks,
        goals: &[Cell],
        keeps: impl Fn(usize, u32) -> bool,
        limits: &mut Limits,
    ) -> Result<Self, SearchError> {
        let mut spread = Spread {
            costs: vec![UNREACHED; moves.as_slice().len()],
            masks: moves.as_slice(),
            offsets: moves.offsets(),
            keeps,
        };
        for &goal in goals {
            check_end(moves, "goal", goal)?;
            spread.costs[moves.index(goal)] = 0;
        }
        let (mut wave, mut later) = (Level::default(), <[Level; 2]>::default());
        for &goal in goals {
            limits.step()?;
            later.iter_mut().for_each(Level::reserve);
            spread.expand(moves.index(goal), 0, &mut later);
        }
        let mut floor = 0;
        while !later.iter().all(Level::is_empty) {
            if floor > MAX_COST - 2 * STRAIGHT_COST {
                return Err(SearchError::TOO_LONG);
            }
            floor += STRAIGHT_COST;
            wave.clear();
            std::mem::swap(&mut wave, &mut later[0]);
            later.swap(0, 1);
            spread.advance(&wave, floor, &mut later, limits)?;
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

/// Cells of one bucket by the step that reached them, with room behind each list so that a push is
/// a plain write.
#[derive(Default)]
struct Level {
    lists: [List; 8],
}

#[derive(Default)]
struct List {
    cells: Vec<u32>,
    n_cells: usize,
}

impl Level {
    fn is_empty(&self) -> bool {
        self.lists.iter().all(|list| list.n_cells == 0)
    }

    fn clear(&mut self) {
        for list in &mut self.lists {
            list.n_cells = 0;
        }
    }

    /// Makes room for a chunk of cells to be expanded.
    fn reserve(&mut self) {
        for list in &mut self.lists {
            let n_wanted = list.n_cells + CHUNK;
            if list.cells.len() < n_wanted {
                list.cells.resize(n_wanted.next_power_of_two(), 0);
            }
        }
    }
}

impl List {
    /// Writes the cell and keeps it if it is wanted; there must be room.
    fn push_if(&mut self, is_wanted: bool, cell: usize) {
        self.cells[self.n_cells] = cell as u32;
        self.n_cells += usize::from(is_wanted);
    }
}

/// The front as it moves outward.
struct Spread<'a, F> {
    costs: Vec<u32>,
    masks: &'a [u8],
    offsets: [isize; 8],
    keeps: F,
}

impl<F: Fn(usize, u32) -> bool> Spread<'_, F> {
    /// Expands a level whose costs begin at `floor` into the next two.
    fn advance(
        &mut self,
        wave: &Level,
        floor: u32,
        later: &mut [Level; 2],
        limits: &mut Limits,
    ) -> Result<(), Status> {
        for (step, list) in wave.lists.iter().enumerate() {
            for cells in list.cells[..list.n_cells].chunks(CHUNK) {
                later.iter_mut().for_each(Level::reserve);
                for &cell in cells {
                    limits.step()?;
                    self.expand_onward(cell as usize, step, floor, later);
                }
            }
        }
        Ok(())
    }

    /// Expands a cell that was queued when a step reached it, on open ground only
    /// [`ONWARD_STEPS`](super::cost::ONWARD_STEPS).
    #[inline]
    fn expand_onward(&mut self, index: usize, step: usize, floor: u32, later: &mut [Level; 2]) {
        let cost = self.costs[index];
        if cost < floor {
            // Reached by a shorter way since it was queued, and expanded then.
            return;
        }
        if self.masks[index] != u8::MAX {
            return self.expand(index, floor, later);
        }
        if step.is_multiple_of(2) {
            return self.offer(index, step, cost + STRAIGHT_COST, &mut later[0]);
        }
        for beside in [(step + 1) % 8, step - 1] {
            self.offer(index, beside, cost + STRAIGHT_COST, &mut later[0]);
        }
        let level = &mut later[diagonal_level(cost, floor)];
        self.offer(index, step, cost + DIAGONAL_COST, level);
    }

    /// Offers a way through a cell to all its neighbors.
    fn expand(&mut self, index: usize, floor: u32, later: &mut [Level; 2]) {
        let cost = self.costs[index];
        let [next, after_next] = later;
        let is_next = diagonal_level(cost, floor) == 0;
        let mut steps = self.masks[index];
        while steps != 0 {
            let step = steps.trailing_zeros() as usize;
            steps &= steps - 1;
            let is_straight = step.is_multiple_of(2);
            let level = if is_straight || is_next {
                &mut *next
            } else {
                &mut *after_next
            };
            self.offer(index, step, cost + STEP_COSTS[step], level);
        }
    }

    /// Offers a way to the neighbor that a step leads to; without branches, as nobody can foresee
    /// which offers are better than what is known.
    #[inline]
    fn offer(&mut self, index: usize, step: usize, cost: u32, level: &mut Level) {
        let to = index.wrapping_add_signed(self.offsets[step]);
        let known = self.costs[to];
        let is_wanted = (cost < known) & (self.keeps)(to, cost);
        self.costs[to] = if is_wanted { cost } else { known };
        level.lists[step].push_if(is_wanted, to);
    }
}

/// Whether a diagonal step from a cost of the bucket from `floor` on leads to the next bucket (0)
/// or the one after (1).
fn diagonal_level(cost: u32, floor: u32) -> usize {
    usize::from(cost + DIAGONAL_COST >= floor + 2 * STRAIGHT_COST)
}
