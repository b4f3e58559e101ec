//! The cost of the way to a goal from every cell (Dijkstra 1959, in buckets).

use super::cost::{STEP_COSTS, STRAIGHT_COST};
use super::grid_search::{GridSearch, SearchError, check_end};
use super::wave::{Terrain, Wave};
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

impl GoalField {
    /// Measures the way to `goals` from every cell that reaches one.
    ///
    /// A step of the limits is a cell expanded. Four bytes per cell.
    ///
    /// # Errors
    /// A goal off the map or blocked; budget, deadline or cancel; ways longer than about four
    /// million cells.
    pub fn new(
        moves: &MoveMasks,
        goals: &[Cell],
        limits: &mut Limits,
    ) -> Result<Self, SearchError> {
        Self::spread(moves, goals, &Everywhere, limits)
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
        let within = Within { field: self, most };
        Self::spread(moves, &[start], &within, limits)
    }

    fn spread(
        moves: &MoveMasks,
        goals: &[Cell],
        terrain: &impl Terrain,
        limits: &mut Limits,
    ) -> Result<Self, SearchError> {
        let mut wave = Wave::new(moves.as_slice().len());
        for &goal in goals {
            check_end(moves, "goal", goal)?;
            wave.put(moves.index(goal), 0);
        }
        while !wave.is_exhausted() {
            wave.advance(moves, terrain, limits)?;
        }
        Ok(Self {
            costs: wave.into_costs(),
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

/// Ground that the front may cover all of.
struct Everywhere;

impl Terrain for Everywhere {}

/// Cells on ways that cost at most so much.
struct Within<'a> {
    field: &'a GoalField,
    most: u32,
}

impl Terrain for Within<'_> {
    fn keeps(&self, to: usize, cost: u32) -> bool {
        cost.saturating_add(self.field.costs[to]) <= self.most
    }
}
