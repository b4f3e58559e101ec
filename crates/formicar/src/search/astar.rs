//! A* from cell to cell (Hart, Nilsson & Raphael 1968) on flat arrays.

use super::bucket_queue::BucketQueue;
use super::cost::{MAX_COST, NO_STEP, ONWARD_STEPS, STEP_COSTS, octile};
use super::grid_search::{GridSearch, SearchError, check_end};
use super::open_queue::{KeyHeap, OpenQueue};
use crate::map::{Cell, MoveMasks, STEPS};
use crate::progress::{Limits, Status};

/// Memory of A*, reused from query to query: nothing is cleared in between.
///
/// Eight bytes per cell, touched only where a search comes by, and eight per cell ever waiting at
/// once. It grows with the largest map it was used on.
#[derive(Clone, Debug)]
pub struct AstarWorkspace {
    /// Per cell the query that reached it last, the cost from its start, and the last step.
    states: Vec<u64>,
    queues: Queues,
    query: u64,
}

/// The kinds of queues; the choice depends on the keys.
#[derive(Clone, Debug)]
pub(super) struct Queues {
    /// For keys that only grow.
    pub(super) buckets: BucketQueue,
    /// For all others.
    pub(super) heap: KeyHeap,
}

/// The order of a search: the key of a cell by its cost from the start, least first.
pub(super) trait Guide {
    /// The queue of open cells.
    type Queue: OpenQueue;

    /// The key of a cell reached at a cost.
    fn key(&self, cost: u32, cell: Cell) -> <Self::Queue as OpenQueue>::Key;

    /// The cost at which a cell was reached, by its key.
    fn cost(&self, key: <Self::Queue as OpenQueue>::Key, cell: Cell) -> u32;

    /// The queue for such keys.
    fn queue(queues: &mut Queues) -> &mut Self::Queue;
}

/// The octile distance to the goal: consistent, so that keys only grow.
struct Octile {
    goal: Cell,
}

impl Guide for Octile {
    type Queue = BucketQueue;

    fn key(&self, cost: u32, cell: Cell) -> u32 {
        cost.wrapping_add(octile(cell, self.goal))
    }

    fn cost(&self, key: u32, cell: Cell) -> u32 {
        key.wrapping_sub(octile(cell, self.goal))
    }

    fn queue(queues: &mut Queues) -> &mut BucketQueue {
        &mut queues.buckets
    }
}

/// Bits of a state: the query's number on top, then the cost from the start, complemented, then
/// the step by which the cell was reached. A better state is a larger number, and any state of
/// this query is larger than those of queries before.
const STEP_BITS: u32 = 4;
const QUERY_SHIFT: u32 = STEP_BITS + 32;
const MAX_QUERY: u64 = u64::MAX >> QUERY_SHIFT;
const STEP_MASK: u64 = (1 << STEP_BITS) - 1;

impl Default for AstarWorkspace {
    fn default() -> Self {
        Self::new()
    }
}

impl AstarWorkspace {
    /// A workspace that holds nothing yet.
    pub fn new() -> Self {
        Self {
            states: Vec::new(),
            queues: Queues {
                buckets: BucketQueue::new(),
                heap: KeyHeap::default(),
            },
            query: 0,
        }
    }

    fn begin(&mut self, n_cells: usize) {
        if self.states.len() < n_cells || self.query == MAX_QUERY {
            self.states = vec![0; n_cells.max(self.states.len())];
            self.query = 0;
        }
        self.query += 1;
    }

    /// The state of a cell reached at a cost, with room for the step.
    fn state(&self, cost: u32) -> u64 {
        self.query << QUERY_SHIFT | u64::from(!cost) << STEP_BITS
    }

    /// Follows the steps back from the goal.
    fn path(&self, moves: &MoveMasks, start: Cell, goal: Cell) -> GridSearch {
        let mut search = GridSearch::default();
        let mut cell = goal;
        search.path.cells.push(goal);
        while cell != start {
            let step = (self.states[moves.index(cell)] & STEP_MASK) as usize;
            search.count_step(step);
            cell = moved(cell, (step + 4) % 8);
            search.path.cells.push(cell);
        }
        search.path.cells.reverse();
        search
    }
}

/// A shortest path between two cells along allowed moves.
///
/// The heuristic is the octile distance; among equal estimates the cell reached last goes first.
/// A step of the limits is a cell expanded.
///
/// # Errors
/// Start or goal off the map or blocked; no path; budget, deadline or cancel; a path longer than
/// about four million cells.
pub fn astar(
    moves: &MoveMasks,
    start: Cell,
    goal: Cell,
    workspace: &mut AstarWorkspace,
    limits: &mut Limits,
) -> Result<GridSearch, SearchError> {
    search(moves, [start, goal], &Octile { goal }, workspace, limits)
}

/// A path between two cells along allowed moves, by the keys of a guide.
///
/// A cell that is reached at less cost than before waits again, so that every guide is served:
/// until the goal comes up, some cell of a shortest path, reached at the least cost there is,
/// waits. On open ground that holds for [`ONWARD_STEPS`] too: whichever of the last steps of
/// shortest ways to a cell is straight, or else diagonal, is dropped at the cell before it only
/// where a strictly shorter way exists.
pub(super) fn search<G: Guide>(
    moves: &MoveMasks,
    [start, goal]: [Cell; 2],
    guide: &G,
    workspace: &mut AstarWorkspace,
    limits: &mut Limits,
) -> Result<GridSearch, SearchError> {
    check_end(moves, "start", start)?;
    check_end(moves, "goal", goal)?;
    workspace.begin(moves.as_slice().len());
    let (first, first_key) = (moves.index(start), guide.key(0, start));
    workspace.states[first] = workspace.state(0) | NO_STEP as u64;
    let queue = G::queue(&mut workspace.queues);
    queue.reset(first_key);
    queue.push(first as u32, first_key);
    let expansion = Expansion {
        masks: moves.as_slice(),
        offsets: moves.offsets(),
        guide,
    };
    while let Some((index, key)) = G::queue(&mut workspace.queues).pop() {
        let cell = moves.cell(index as usize);
        let cost = guide.cost(key, cell);
        if workspace.states[index as usize] & !STEP_MASK != workspace.state(cost) {
            continue;
        }
        if cell == goal {
            return Ok(workspace.path(moves, start, goal));
        }
        limits.step()?;
        if cost > MAX_COST {
            return Err(SearchError::TOO_LONG);
        }
        expansion.expand(workspace, index as usize, cell, cost);
    }
    Err(Status::NoPath.into())
}

/// Everything that is the same for every cell of a query.
struct Expansion<'a, G> {
    masks: &'a [u8],
    offsets: [isize; 8],
    guide: &'a G,
}

impl<G: Guide> Expansion<'_, G> {
    /// Reaches out from a cell to its neighbors.
    fn expand(&self, workspace: &mut AstarWorkspace, index: usize, cell: Cell, cost: u32) {
        let mut steps = self.masks[index];
        if steps == u8::MAX {
            let last_step = workspace.states[index] & STEP_MASK;
            steps = ONWARD_STEPS[last_step as usize];
        }
        while steps != 0 {
            let step = steps.trailing_zeros() as usize;
            steps &= steps - 1;
            let next = index.wrapping_add_signed(self.offsets[step]);
            let next_cost = cost + STEP_COSTS[step];
            let state = workspace.state(next_cost);
            if state > workspace.states[next] | STEP_MASK {
                workspace.states[next] = state | step as u64;
                let key = self.guide.key(next_cost, moved(cell, step));
                G::queue(&mut workspace.queues).push(next as u32, key);
            }
        }
    }
}

/// The cell that an allowed step leads to.
fn moved(cell: Cell, step: usize) -> Cell {
    let (dx, dy) = STEPS[step];
    Cell::new(
        cell.col.wrapping_add_signed(dx),
        cell.row.wrapping_add_signed(dy),
    )
}
