//! A front that spreads over cells from the cheapest on, in buckets as wide as a straight step.

use super::cost::{DIAGONAL_COST, MAX_COST, STEP_COSTS, STRAIGHT_COST};
use super::grid_search::SearchError;
use crate::map::MoveMasks;
use crate::progress::Limits;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Cells expanded between two checks of room in the buckets.
const CHUNK: usize = 256;

/// Properties of cells that a wave front depends on, besides their moves.
pub(super) trait Terrain {
    /// Whether the front may come to a cell at a cost.
    fn keeps(&self, _to: usize, _cost: u32) -> bool {
        true
    }

    /// Additional cost of a cell beyond the step from it.
    fn toll(&self, _cell: usize) -> u32 {
        0
    }

    /// Whether a cell or one of its neighbors has a toll.
    fn is_rough(&self, _cell: usize) -> bool {
        false
    }
}

/// Costs of cells and the front between the settled ones and those beyond.
///
/// Buckets are as wide as a straight step, the shortest there is: no cell of a bucket can improve
/// another of the same one (Dinitz 1978). Cells whose turn is more than two buckets away wait in a
/// heap. On open ground a cell hands on only along canonical directions.
pub(super) struct Wave {
    /// One more than the cost, 0 where a cell was not reached: fresh memory is not touched.
    costs: Vec<u32>,
    /// Least cost of the next bucket; cheaper cells are settled.
    floor: u32,
    current: Level,
    later: [Level; 2],
    far: BinaryHeap<Reverse<(u32, u32)>>,
}

impl Wave {
    pub(super) fn new(n_cells: usize) -> Self {
        Self {
            costs: vec![0; n_cells],
            floor: 0,
            current: Level::default(),
            later: Default::default(),
            far: BinaryHeap::new(),
        }
    }

    /// The cost of a cell that was reached; final where it is below [`Self::floor`].
    pub(super) fn cost(&self, cell: usize) -> Option<u32> {
        self.costs[cell].checked_sub(1)
    }

    /// Cells cheaper than this are settled.
    pub(super) fn floor(&self) -> u32 {
        self.floor
    }

    /// Whether no cell waits.
    pub(super) fn is_exhausted(&self) -> bool {
        self.far.is_empty() && self.later.iter().all(Level::is_empty)
    }

    /// The costs of all cells, `u32::MAX` where not reached.
    pub(super) fn into_costs(mut self) -> Vec<u32> {
        for cost in &mut self.costs {
            *cost = cost.wrapping_sub(1);
        }
        self.costs
    }

    /// Gives a cell a cost, to be spread from when its turn comes.
    pub(super) fn put(&mut self, cell: usize, cost: u32) {
        self.costs[cell] = cost + 1;
        self.far.push(Reverse((cost, cell as u32)));
    }

    /// Takes a cell's cost away.
    pub(super) fn clear(&mut self, cell: usize) {
        self.costs[cell] = 0;
    }

    /// Lets all waiting cells wait by their cost alone, so that the front may go back.
    pub(super) fn gather(&mut self) {
        for level in &mut self.later {
            for cell in level.cells() {
                if let Some(cost) = self.costs[cell as usize].checked_sub(1)
                    && cost >= self.floor
                {
                    self.far.push(Reverse((cost, cell)));
                }
            }
            level.clear();
        }
    }

    /// Goes on, or back, to where the cheapest waiting cell is; levels must be empty.
    pub(super) fn rewind(&mut self) {
        if let Some(&Reverse((cost, _))) = self.far.peek() {
            self.floor = cost / STRAIGHT_COST * STRAIGHT_COST;
        }
    }

    /// Takes all cells below a cost as settled.
    pub(super) fn skip_to(&mut self, floor: u32) {
        self.floor = self.floor.max(floor);
    }

    /// Expands the next bucket. A step of the limits is a cell expanded.
    pub(super) fn advance(
        &mut self,
        moves: &MoveMasks,
        terrain: &impl Terrain,
        limits: &mut Limits,
    ) -> Result<(), SearchError> {
        if self.later.iter().all(Level::is_empty) {
            self.rewind();
        }
        if self.floor > MAX_COST - 2 * STRAIGHT_COST {
            return Err(SearchError::TOO_LONG);
        }
        self.current.clear();
        std::mem::swap(&mut self.current, &mut self.later[0]);
        self.later.swap(0, 1);
        let mut spread = Spread {
            costs: &mut self.costs,
            masks: moves.as_slice(),
            offsets: moves.offsets(),
            terrain,
            floor: self.floor,
            later: &mut self.later,
            far: &mut self.far,
        };
        spread.expand_far(limits)?;
        spread.expand_level(&self.current, limits)?;
        self.floor += STRAIGHT_COST;
        Ok(())
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

    fn cells(&self) -> impl Iterator<Item = u32> + '_ {
        let lists = self.lists.iter();
        lists.flat_map(|list| list.cells[..list.n_cells].iter().copied())
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

/// A bucket being expanded into the next two and the heap.
struct Spread<'a, T> {
    costs: &'a mut [u32],
    masks: &'a [u8],
    offsets: [isize; 8],
    terrain: &'a T,
    floor: u32,
    later: &'a mut [Level; 2],
    far: &'a mut BinaryHeap<Reverse<(u32, u32)>>,
}

impl<T: Terrain> Spread<'_, T> {
    fn expand_level(&mut self, level: &Level, limits: &mut Limits) -> Result<(), SearchError> {
        for (step, list) in level.lists.iter().enumerate() {
            for cells in list.cells[..list.n_cells].chunks(CHUNK) {
                self.later.iter_mut().for_each(Level::reserve);
                for &cell in cells {
                    limits.step()?;
                    self.expand_onward(cell as usize, step);
                }
            }
        }
        Ok(())
    }

    /// Expands the waiting cells whose turn it is, towards all sides.
    fn expand_far(&mut self, limits: &mut Limits) -> Result<(), SearchError> {
        while let Some(&Reverse((cost, cell))) = self.far.peek()
            && cost < self.floor + STRAIGHT_COST
        {
            self.far.pop();
            if self.costs[cell as usize] == cost + 1 {
                limits.step()?;
                self.later.iter_mut().for_each(Level::reserve);
                self.expand(cell as usize, cost);
            }
        }
        Ok(())
    }

    /// Expands a cell that was queued when a step reached it, on open ground only
    /// [`ONWARD_STEPS`](super::cost::ONWARD_STEPS).
    #[inline]
    fn expand_onward(&mut self, index: usize, step: usize) {
        let cost = self.costs[index].wrapping_sub(1);
        if cost < self.floor {
            // Reached by a shorter way since it was queued, and expanded then.
            return;
        }
        if self.masks[index] != u8::MAX || self.terrain.is_rough(index) {
            return self.expand(index, cost);
        }
        if step.is_multiple_of(2) {
            return self.offer(index, step, cost + STRAIGHT_COST, 0);
        }
        for beside in [(step + 1) % 8, step - 1] {
            self.offer(index, beside, cost + STRAIGHT_COST, 0);
        }
        let level = self.diagonal_level(cost);
        self.offer(index, step, cost + DIAGONAL_COST, level);
    }

    /// Offers a way through a cell to all its neighbors.
    fn expand(&mut self, index: usize, cost: u32) {
        let is_rough = self.terrain.is_rough(index);
        let diagonal_level = self.diagonal_level(cost);
        let mut steps = self.masks[index];
        while steps != 0 {
            let step = steps.trailing_zeros() as usize;
            steps &= steps - 1;
            let to_cost = cost + STEP_COSTS[step];
            if is_rough {
                self.offer_over_toll(index, step, to_cost);
            } else {
                let is_straight = step.is_multiple_of(2);
                self.offer(
                    index,
                    step,
                    to_cost,
                    if is_straight { 0 } else { diagonal_level },
                );
            }
        }
    }

    /// Offers a way to the neighbor that a step leads to; without branches, as nobody can foresee
    /// which offers are better than what is known.
    #[inline]
    fn offer(&mut self, index: usize, step: usize, cost: u32, level: usize) {
        let to = index.wrapping_add_signed(self.offsets[step]);
        let known = self.costs[to];
        let is_wanted = (cost < known.wrapping_sub(1)) & self.terrain.keeps(to, cost);
        self.costs[to] = if is_wanted { cost + 1 } else { known };
        self.later[level].lists[step].push_if(is_wanted, to);
    }

    /// The same where the neighbor may cost more than the step.
    fn offer_over_toll(&mut self, index: usize, step: usize, step_cost: u32) {
        let to = index.wrapping_add_signed(self.offsets[step]);
        let cost = step_cost + self.terrain.toll(to);
        match (cost - self.floor) / STRAIGHT_COST {
            n_buckets @ 1..=2 => self.offer(index, step, cost, n_buckets as usize - 1),
            _ if cost < self.costs[to].wrapping_sub(1) && self.terrain.keeps(to, cost) => {
                self.costs[to] = cost + 1;
                self.far.push(Reverse((cost, to as u32)));
            }
            _ => {}
        }
    }

    /// Whether a diagonal step from a cost of this bucket leads to the next one (0) or the one
    /// after (1).
    fn diagonal_level(&self, cost: u32) -> usize {
        usize::from(cost + DIAGONAL_COST >= self.floor + 2 * STRAIGHT_COST)
    }
}
