//! The graph that ants walk on: cells and the steps between them.
//!
//! Cells that ants can reach are numbered in ascending order, and all data that ants read are
//! stored by these numbers: the size of the map does not slow down a colony in a corridor.

use super::config::{AdjacentGoal, ColonyConfig};
use super::corridor::Corridor;
use super::error::RunError;
use super::heuristic::LogDesire;
use super::node::Node;
use super::problem::ColonyProblem;
use super::visited::VisitedCells;
use crate::map::{STEP_COSTS, STEPS};
use crate::progress::{Limits, Status};
use crate::search::{GoalField, STRAIGHT_COST, SearchError};
use std::ops::Range;

/// A problem prepared for a configuration: everything that stays the same over all iterations.
pub(super) struct StepGraph {
    pub(super) n_cols: usize,
    pub(super) n_rows: usize,
    /// The index of the start, row by row.
    pub(super) start: usize,
    pub(super) offsets: [isize; 8],
    /// Cells that ants can reach, in ascending order.
    pub(super) cells: Vec<u32>,
    /// The same as ranges.
    pub(super) spans: Vec<Range<usize>>,
    /// Numbers of start and goal; none for a goal that cannot be reached.
    pub(super) ends: (usize, Option<usize>),
    /// By number the desire of each step, at most 1.
    pub(super) desire: Vec<[f32; 8]>,
}

impl StepGraph {
    /// The graph with the nodes of its cells, whose weights are not yet set.
    pub(super) fn new(
        problem: &ColonyProblem,
        config: &ColonyConfig,
        limits: &mut Limits,
    ) -> Result<(Self, Vec<Node>), RunError> {
        let moves = problem.moves();
        let (start, goal) = (moves.index(problem.start()), moves.index(problem.goal()));
        let region = Region::new(problem, config, limits)?;
        let mut limits = limits.without_budget();
        let cells = region.reachable(start, &mut limits)?;
        let number = |cell: usize| cells.binary_search(&(cell as u32)).ok();
        let ends = (number(start).unwrap_or_default(), number(goal));
        let mut nodes = nodes(problem, config, &region, &cells, &mut limits)?;
        let log = log_desire(problem, config, (&region, &cells), &mut limits)?;
        let mut desire = Vec::with_capacity(nodes.len());
        for (at, node) in nodes.iter().enumerate() {
            limits.step()?;
            desire.push(desires(&log, node, at));
        }
        let graph = Self {
            n_cols: moves.n_cols(),
            n_rows: moves.n_rows(),
            start,
            offsets: moves.offsets(),
            spans: spans(&cells),
            ends,
            desire,
            cells,
        };
        if let (AdjacentGoal::Taken, Some(goal)) = (config.adjacent_goal, ends.1) {
            take_goal(&mut nodes, goal);
        }
        Ok((graph, nodes))
    }

    /// Whether ants can reach the goal.
    pub(super) fn has_way(&self) -> bool {
        self.ends.1.is_some()
    }
}

/// The allowed steps of each cell.
struct Region<'a> {
    masks: &'a [u8],
    offsets: [isize; 8],
    directions: u8,
    /// The distance to the goal, where a rule needs it.
    to_goal: Option<GoalField>,
    /// The distance to the start from the cells of the corridor, if there is one.
    corridor: Option<GoalField>,
    /// The largest detour of a step in the corridor, in units of the fields.
    most_loss: i64,
}

impl<'a> Region<'a> {
    fn new(
        problem: &'a ColonyProblem,
        config: &ColonyConfig,
        limits: &mut Limits,
    ) -> Result<Self, SearchError> {
        let moves = problem.moves();
        let mut region = Self {
            masks: moves.as_slice(),
            offsets: moves.offsets(),
            directions: problem.directions(config.directions),
            to_goal: None,
            corridor: None,
            most_loss: i64::MAX,
        };
        if config.guidance == super::heuristic::Guidance::None && config.corridor == Corridor::None
        {
            return Ok(region);
        }
        let mut limits = limits.without_budget();
        let to_goal = GoalField::new(moves, &[problem.goal()], &mut limits)?;
        if let (Corridor::Ratio(rule), Some(_)) = (&config.corridor, to_goal.cost(problem.start()))
        {
            let corridor = to_goal.corridor(moves, problem.start(), rule.ratio, &mut limits)?;
            region.corridor = Some(corridor);
            region.most_loss = (rule.step_loss_cells * f64::from(STRAIGHT_COST)) as i64;
        }
        region.to_goal = Some(to_goal);
        Ok(region)
    }

    /// The allowed steps of a cell, a bit each.
    fn steps(&self, cell: usize) -> u8 {
        let allowed = self.masks[cell] & self.directions;
        let (Some(to_start), Some(to_goal)) = (&self.corridor, &self.to_goal) else {
            return allowed;
        };
        let stays = |&step: &usize| {
            let to = cell.wrapping_add_signed(self.offsets[step]);
            let [before, after] = [cell, to].map(|cell| i64::from(to_goal.costs()[cell]));
            let is_in = to_start.costs()[to] != u32::MAX;
            is_in && i64::from(STEP_COSTS[step]) + after - before <= self.most_loss
        };
        steps_in(allowed).filter(stays).map(|step| 1 << step).sum()
    }

    /// The cells that allowed steps lead to, in ascending order.
    fn reachable(&self, start: usize, limits: &mut Limits) -> Result<Vec<u32>, RunError> {
        let max = ColonyProblem::MAX_CELLS;
        let mut is_reached = vec![false; self.masks.len()];
        is_reached[start] = true;
        let mut cells = vec![start as u32];
        let mut next = 0;
        while let Some(&cell) = cells.get(next) {
            next += 1;
            limits.step()?;
            for step in steps_in(self.steps(cell as usize)) {
                let to = (cell as usize).wrapping_add_signed(self.offsets[step]);
                if !std::mem::replace(&mut is_reached[to], true) {
                    cells.push(to as u32);
                }
            }
            if cells.len() > max {
                let n_cells = self.masks.len();
                return Err(RunError::TooLarge { n_cells, max });
            }
        }
        let all = is_reached.iter().zip(0..);
        Ok(all.filter(|(is, _)| **is).map(|(_, cell)| cell).collect())
    }
}

/// The steps in a set of bits.
pub(super) fn steps_in(mut bits: u8) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        (bits != 0).then(|| {
            let step = bits.trailing_zeros() as usize;
            bits &= bits - 1;
            step
        })
    })
}

/// Ascending cells as ranges.
fn spans(cells: &[u32]) -> Vec<Range<usize>> {
    let runs = cells.chunk_by(|a, b| a + 1 == *b);
    runs.map(|run| run[0] as usize..run[0] as usize + run.len())
        .collect()
}

fn nodes(
    problem: &ColonyProblem,
    config: &ColonyConfig,
    region: &Region,
    cells: &[u32],
    limits: &mut Limits,
) -> Result<Vec<Node>, Status> {
    let moves = problem.moves();
    let n_cols = moves.n_cols() as i64;
    let (mut below, mut above) = (Row::new(cells), Row::new(cells));
    let node = |&index: &u32| {
        limits.step()?;
        let cell = moves.cell(index as usize);
        let west = i64::from(index) - 1;
        let mut node = Node::new(
            VisitedCells::address(moves.n_cols(), cell.col as usize, cell.row as usize),
            region.steps(index as usize),
            config.transition.first_class(problem.to_goal(cell)),
        );
        node.link(
            below.three_from(west - n_cols),
            above.three_from(west + n_cols),
        );
        Ok(node)
    };
    cells.iter().map(node).collect()
}

/// Follows the cells of one row beside those of another.
struct Row<'a> {
    cells: &'a [u32],
    next: usize,
}

impl<'a> Row<'a> {
    fn new(cells: &'a [u32]) -> Self {
        Self { cells, next: 0 }
    }

    /// The numbers of a cell and the two east of it; a cell without a number has that of the next
    /// one. Cells must ascend from call to call.
    fn three_from(&mut self, west: i64) -> [u32; 3] {
        let lies_before = |&&cell: &&u32| i64::from(cell) < west;
        self.next += self.cells[self.next..]
            .iter()
            .take_while(lies_before)
            .count();
        let mut at = self.next;
        [west, west + 1, west + 2].map(|cell| {
            let number = at as u32;
            at += usize::from(self.cells.get(at).is_some_and(|&c| i64::from(c) == cell));
            number
        })
    }
}

/// Leaves only the step to the goal in the cells beside it.
fn take_goal(nodes: &mut [Node], goal: usize) {
    for step in steps_in(nodes[goal].allowed) {
        let beside = nodes[goal].next(goal, step);
        let back = 1 << ((step + 4) % STEPS.len());
        nodes[beside].allowed &= back;
    }
}

/// The desire of each allowed step of a node, the most desired at 1.
fn desires(log: &LogDesire, node: &Node, at: usize) -> [f32; 8] {
    let mut logs = [f64::NEG_INFINITY; 8];
    for step in steps_in(node.allowed) {
        logs[step] = log.cells[node.next(at, step)] + log.steps[step];
    }
    let most = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    logs.map(|log| (log - most).exp() as f32)
}

fn log_desire(
    problem: &ColonyProblem,
    config: &ColonyConfig,
    (region, cells): (&Region, &[u32]),
    limits: &mut Limits,
) -> Result<LogDesire, Status> {
    let mut desire = LogDesire {
        cells: vec![0.0; cells.len()],
        steps: [0.0; 8],
    };
    config
        .visibility
        .add_to(&mut desire, problem, cells, limits)?;
    if let Some(field) = &region.to_goal {
        // A cell without a path to the goal counts as the farthest of all.
        let cost = |&cell: &u32| field.costs()[cell as usize];
        let lengths = cells
            .iter()
            .map(|cell| f64::from(cost(cell)) / f64::from(STRAIGHT_COST));
        config
            .guidance
            .add_to(&mut desire, &lengths.collect::<Vec<f64>>(), limits)?;
    }
    Ok(desire)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::colony::Directions;
    use crate::colony::corridor::RatioCorridor;
    use crate::colony::heuristic::step_length;
    use crate::colony::presets;
    use crate::map::{BitGrid, Cell, DiagonalRule, MoveMasks};

    fn graph(config: &ColonyConfig, goal: Cell) -> (StepGraph, Vec<Node>) {
        let moves = MoveMasks::new(&BitGrid::new(5, 5), DiagonalRule::Always);
        let problem = ColonyProblem::new(moves, Cell::new(2, 2), goal);
        StepGraph::new(&problem, config, &mut Limits::new(&mut (), None, None)).unwrap()
    }

    #[test]
    fn step_length_is_that_of_the_steps() {
        for (step, (dx, dy)) in STEPS.into_iter().enumerate() {
            assert_eq!(step_length(step), f64::from(dx * dx + dy * dy).sqrt());
        }
    }

    #[test]
    fn six_directions_follow_the_diagonal_of_the_goal() {
        let config = ColonyConfig {
            directions: Directions::Six,
            ..presets::ant_system()
        };
        let (up, down) = (Cell::new(4, 4), Cell::new(4, 0));
        assert_eq!(graph(&config, up).1[12].allowed, 0b0111_0111);
        assert_eq!(graph(&config, down).1[12].allowed, 0b1101_1101);
    }

    #[test]
    fn beside_the_goal_only_the_step_to_it_is_left() {
        let (_, nodes) = graph(&presets::ant_system(), Cell::new(3, 3));
        assert_eq!(nodes[12].allowed, 0b0000_0010);
        let weighed = ColonyConfig {
            adjacent_goal: AdjacentGoal::Weighed,
            ..presets::ant_system()
        };
        assert_eq!(graph(&weighed, Cell::new(3, 3)).1[12].allowed, u8::MAX);
    }

    #[test]
    fn a_corridor_holds_the_cells_of_ways_that_are_short_enough() {
        let within = |ratio: f64| {
            let config = ColonyConfig {
                corridor: Corridor::Ratio(RatioCorridor {
                    ratio,
                    ..RatioCorridor::default()
                }),
                ..presets::ant_system()
            };
            graph(&config, Cell::new(4, 2))
        };
        assert_eq!(within(1.0).0.cells, [12, 13, 14]);
        // One step aside makes the way of two cells one of 2.83, not of more.
        let (graph, nodes) = within(1.42);
        assert_eq!(graph.cells, [8, 12, 13, 14, 18]);
        assert_eq!(graph.spans, [8..9, 12..15, 18..19]);
        assert_eq!((graph.ends, nodes[1].allowed), ((1, Some(3)), 0b1000_0011));
    }

    #[test]
    fn steps_lead_to_the_numbers_of_the_cells_that_they_lead_to() {
        let mut blocked = BitGrid::new(9, 7);
        blocked.extend([10, 12, 13, 31, 40, 41, 50].map(|i: u32| Cell::new(i % 9, i / 9)));
        let moves = MoveMasks::new(&blocked, DiagonalRule::AtMostOneObstacle);
        let problem = ColonyProblem::new(moves, Cell::new(0, 0), Cell::new(8, 6));
        for corridor in [Corridor::None, Corridor::Ratio(RatioCorridor::default())] {
            let config = ColonyConfig {
                corridor,
                ..presets::ant_system()
            };
            let (graph, nodes) =
                StepGraph::new(&problem, &config, &mut Limits::new(&mut (), None, None)).unwrap();
            for (at, node) in nodes.iter().enumerate() {
                for step in steps_in(node.allowed) {
                    let to = (graph.cells[at] as usize).wrapping_add_signed(graph.offsets[step]);
                    assert_eq!(graph.cells[node.next(at, step)] as usize, to);
                }
            }
        }
    }
}
