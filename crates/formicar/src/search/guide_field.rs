//! A goal field for vehicles: computed only as far as it is asked for, and repaired where it leads
//! into places that the vehicle cannot drive.

use super::cost::{STEP_COSTS, STRAIGHT_COST};
use super::grid_search::{SearchError, check_end};
use super::wave::{Terrain, Wave};
use crate::map::{Cell, MoveMasks};
use crate::progress::Limits;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Cost to go from cells to the nearest of some goals, along allowed moves and over tolls.
///
/// The front spreads only as far as costs are asked for, so that a query pays for the cells between
/// its ends. [`Self::add_tolls`] makes cells more expensive and repairs only the paths that led
/// over them, as D* Lite does (Koenig & Likhachev 2002). A field belongs to one query, and its
/// repairs end with it.
pub struct GuideField<'a> {
    moves: &'a MoveMasks,
    wave: Wave,
    tolls: Tolls,
}

/// Additional costs of cells beyond the step from them.
#[derive(Default)]
struct Tolls {
    /// One per cell, none before the first toll.
    tolls: Vec<u32>,
    /// Bits of the cells that have a toll or a neighbor with one.
    rough: Vec<u64>,
}

impl Terrain for Tolls {
    fn toll(&self, cell: usize) -> u32 {
        self.tolls.get(cell).copied().unwrap_or(0)
    }

    fn is_rough(&self, cell: usize) -> bool {
        self.rough
            .get(cell / 64)
            .is_some_and(|word| word >> (cell % 64) & 1 == 1)
    }
}

impl<'a> GuideField<'a> {
    /// A field that begins to spread from goals.
    ///
    /// # Errors
    /// A goal off the map or blocked.
    pub fn new(moves: &'a MoveMasks, goals: &[Cell]) -> Result<Self, SearchError> {
        let mut wave = Wave::new(moves.as_slice().len());
        for &goal in goals {
            check_end(moves, "goal", goal)?;
            wave.put(moves.index(goal), 0);
        }
        Ok(Self {
            moves,
            wave,
            tolls: Tolls::default(),
        })
    }

    /// The cells and moves that it spreads over.
    pub fn moves(&self) -> &MoveMasks {
        self.moves
    }

    /// Measures until all cells up to a cost are settled.
    ///
    /// # Errors
    /// Deadline, cancel or budget; ways that are too long to count.
    pub fn settle(&mut self, cost: u32, limits: &mut Limits) -> Result<(), SearchError> {
        while self.wave.floor() <= cost && !self.wave.is_exhausted() {
            self.wave.advance(self.moves, &self.tolls, limits)?;
        }
        Ok(())
    }

    /// The cost to go from a cell, measured now if need be; none where no goal is reached.
    ///
    /// # Errors
    /// As [`Self::settle`].
    pub fn measure(&mut self, cell: Cell, limits: &mut Limits) -> Result<Option<u32>, SearchError> {
        while self.cost(cell).is_none() && !self.wave.is_exhausted() {
            self.wave.advance(self.moves, &self.tolls, limits)?;
        }
        Ok(self.cost(cell))
    }

    /// The cost to go from a cell in units of [`STRAIGHT_COST`] per cell; none where it is not
    /// settled.
    pub fn cost(&self, cell: Cell) -> Option<u32> {
        let cost = self.wave.cost(self.moves.index(cell))?;
        (cost < self.wave.floor()).then_some(cost)
    }

    /// All cells that are not settled cost at least this; none where there are none.
    pub fn horizon(&self) -> Option<u32> {
        (!self.wave.is_exhausted()).then(|| self.wave.floor())
    }

    /// Adds tolls to cells, each paid on leaving the cell towards the goal, and repairs the costs
    /// of the cells that are dearer for it.
    ///
    /// # Errors
    /// As [`Self::settle`].
    pub fn add_tolls(
        &mut self,
        tolls: &[(Cell, u32)],
        limits: &mut Limits,
    ) -> Result<(), SearchError> {
        let settled = self.wave.floor();
        self.wave.gather();
        let mut doubtful = BinaryHeap::new();
        let mut rough = Vec::new();
        for &(cell, toll) in tolls {
            let index = self.moves.index(cell);
            rough.extend(self.charge(index, toll));
            // A goal itself is free to reach, whatever leaving it costs.
            if let Some(cost) = self.wave.cost(index).filter(|&cost| cost > 0) {
                doubtful.push(Reverse((cost, index as u32)));
            }
        }
        rough.extend(self.clear_dearer(doubtful));
        // Where all moves are free, these left neighbors to other cells, which may now be more
        // expensive.
        for cell in rough {
            if let Some(cost) = self.wave.cost(cell) {
                self.wave.put(cell, cost);
            }
        }
        self.wave.rewind();
        self.settle(settled.saturating_sub(1), limits)?;
        // The front may have ended before it came that far again.
        self.wave.skip_to(settled);
        Ok(())
    }

    /// Raises the toll of a cell; the cells that are rough for the first time.
    fn charge(&mut self, cell: usize, toll: u32) -> Vec<usize> {
        if self.tolls.tolls.is_empty() {
            // Fresh memory: what no toll touches costs nothing.
            let n_cells = self.moves.as_slice().len();
            self.tolls = Tolls {
                tolls: vec![0; n_cells],
                rough: vec![0; n_cells.div_ceil(64)],
            };
        }
        self.tolls.tolls[cell] = self.tolls.tolls[cell].saturating_add(toll).min(MAX_TOLL);
        let around = self.neighbors(cell).map(|(to, _)| to).chain([cell]);
        let rough: Vec<usize> = around.filter(|&cell| !self.tolls.is_rough(cell)).collect();
        for cell in &rough {
            self.tolls.rough[cell / 64] |= 1 << (cell % 64);
        }
        rough
    }

    /// Gives all cells that have none of their old ways any more the best that a neighbor still
    /// offers, cheapest first, beginning with doubtful ones. Returns the cells that lost one of
    /// several ways.
    fn clear_dearer(&mut self, mut doubtful: BinaryHeap<Reverse<(u32, u32)>>) -> Vec<usize> {
        let (mut cleared, mut kept) = (Vec::new(), Vec::new());
        while let Some(Reverse((cost, cell))) = doubtful.pop() {
            let cell = cell as usize;
            if self.wave.cost(cell) != Some(cost) {
                continue;
            }
            if self.least_offer(cell) == Some(cost) {
                kept.push(cell);
                continue;
            }
            self.wave.clear(cell);
            cleared.push(cell);
            for (from, step) in self.neighbors(cell) {
                let through = cost + step + self.tolls.toll(from);
                if self.wave.cost(from).is_some_and(|cost| cost <= through) {
                    doubtful.push(Reverse((through, from as u32)));
                }
            }
        }
        let offer = |&cell: &usize| Some((cell, self.least_offer(cell)?));
        let offers: Vec<_> = cleared.iter().filter_map(offer).collect();
        for (cell, cost) in offers {
            self.wave.put(cell, cost);
        }
        kept
    }

    /// The cheapest way on over a neighbor.
    fn least_offer(&self, cell: usize) -> Option<u32> {
        let ways = self.neighbors(cell);
        let offers = ways.filter_map(|(to, step)| Some(self.wave.cost(to)? + step));
        offers.min().map(|least| least + self.tolls.toll(cell))
    }

    /// The neighbors of a cell by its moves, with the cost of the step; moves are symmetric.
    fn neighbors(&self, cell: usize) -> impl Iterator<Item = (usize, u32)> + use<> {
        let (moves, offsets) = (self.moves.as_slice()[cell], self.moves.offsets());
        let steps = (0..8).filter(move |step| moves >> step & 1 == 1);
        steps.map(move |step| {
            let to = cell.wrapping_add_signed(offsets[step]);
            (to, STEP_COSTS[step])
        })
    }
}

/// The largest toll: a thousand straight steps.
const MAX_TOLL: u32 = 1000 * STRAIGHT_COST;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::{BitGrid, DiagonalRule};
    use crate::numeric::Seed;
    use proptest::prelude::*;

    /// Costs by plain relaxation until nothing changes.
    fn by_definition(moves: &MoveMasks, goal: Cell, tolls: &[u32]) -> Vec<Option<u32>> {
        let mut costs = vec![None; tolls.len()];
        costs[moves.index(goal)] = Some(0);
        let offer = |costs: &[Option<u32>], cell: usize| {
            let steps = (0..8).filter(|step| moves.as_slice()[cell] >> step & 1 == 1);
            let ways = steps.filter_map(|step: usize| {
                let to = cell.wrapping_add_signed(moves.offsets()[step]);
                Some(costs[to]? + STEP_COSTS[step] + tolls[cell])
            });
            ways.min()
        };
        loop {
            let before = costs.clone();
            for cell in (0..tolls.len()).filter(|&cell| cell != moves.index(goal)) {
                costs[cell] = offer(&costs, cell);
            }
            if before == costs {
                return costs;
            }
        }
    }

    proptest! {
        #[test]
        fn a_repaired_field_is_the_one_computed_anew(
            (n_cols, n_rows) in (1_usize..24, 1_usize..24),
            seed in any::<u64>(),
            density in 0.0..0.4,
            horizon in 0_u32..30,
        ) {
            let mut draw = Seed(seed).stream([0, 0]);
            let mut blocked = BitGrid::new(n_cols, n_rows);
            let place = |i: usize| Cell::new((i % n_cols) as u32, (i / n_cols) as u32);
            blocked.extend((0..n_cols * n_rows).filter(|_| draw.unit() < density).map(place));
            let goal = place(draw.below(n_cols * n_rows));
            blocked.remove(goal);
            let moves = MoveMasks::new(&blocked, DiagonalRule::AtMostOneObstacle);
            let mut nobody = ();
            let mut limits = Limits::new(&mut nobody, None, None);
            let mut field = GuideField::new(&moves, &[goal]).unwrap();
            field.settle(horizon * STRAIGHT_COST, &mut limits).unwrap();
            let mut tolls = vec![0; n_cols * n_rows];
            for _ in 0..4 {
                let (col, row) = (draw.below(n_cols), draw.below(n_rows));
                let toll = 1 + draw.below(6000) as u32;
                let disc = (0..n_cols * n_rows).map(place).filter(|cell| {
                    cell.col.abs_diff(col as u32).max(cell.row.abs_diff(row as u32)) < 3
                });
                let charged: Vec<_> = disc.map(|cell| (cell, toll)).collect();
                for &(cell, toll) in &charged {
                    tolls[moves.index(cell)] += toll;
                }
                field.add_tolls(&charged, &mut limits).unwrap();
                let expected = by_definition(&moves, goal, &tolls);
                for (cell, &cost) in expected.iter().enumerate() {
                    let here = field.cost(moves.cell(cell));
                    let bound = field.horizon().unwrap_or(u32::MAX);
                    prop_assert!(here == cost || here.is_none() && cost.is_some_and(|cost| cost >= bound), "{here:?} {cost:?} {bound}");
                }
            }
            for (cell, cost) in by_definition(&moves, goal, &tolls).into_iter().enumerate() {
                prop_assert_eq!(field.measure(moves.cell(cell), &mut limits).unwrap(), cost);
            }
        }
    }
}
