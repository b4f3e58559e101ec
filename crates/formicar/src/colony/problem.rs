//! The ground of a colony: where its ants may go, from where to where.

use super::config::{AdjacentGoal, ColonyConfig, Directions};
use super::footmarks::Footmarks;
use super::heuristic::LogDesire;
use super::node::Node;
use crate::map::{Cell, MoveMasks, STEPS};
use crate::progress::Limits;
use crate::search::{GoalField, STRAIGHT_COST, SearchError, check_end};

/// Start and goal on a grid with its allowed moves.
#[derive(Clone, Debug)]
pub struct ColonyProblem {
    moves: MoveMasks,
    start: Cell,
    goal: Cell,
}

impl ColonyProblem {
    /// Cells that a colony can work on at most: it takes about 120 bytes for each.
    pub const MAX_CELLS: usize = 4_000_000;

    /// A problem on allowed moves; the configuration's diagonal rule should have made them.
    pub fn new(moves: MoveMasks, start: Cell, goal: Cell) -> Self {
        Self { moves, start, goal }
    }

    /// The allowed moves.
    pub fn moves(&self) -> &MoveMasks {
        &self.moves
    }

    /// Where the ants set out.
    pub fn start(&self) -> Cell {
        self.start
    }

    /// Where they go.
    pub fn goal(&self) -> Cell {
        self.goal
    }

    /// Checks that ants can stand on start and goal.
    pub(super) fn check_ends(&self) -> Result<(), SearchError> {
        check_end(&self.moves, "start", self.start)?;
        check_end(&self.moves, "goal", self.goal)
    }

    /// Columns and rows from a cell to the goal.
    fn to_goal(&self, cell: Cell) -> (i64, i64) {
        let difference = |a: u32, b: u32| i64::from(a) - i64::from(b);
        (
            difference(self.goal.col, cell.col),
            difference(self.goal.row, cell.row),
        )
    }

    /// The steps of a configuration, a bit each.
    fn directions(&self, directions: Directions) -> u8 {
        let (dx, dy) = self.to_goal(self.start);
        match directions {
            Directions::Four => 0b0101_0101,
            Directions::Six if dx * dy >= 0 => 0b0111_0111,
            Directions::Six => 0b1101_1101,
            Directions::Eight => u8::MAX,
        }
    }
}

/// A problem made ready for a configuration: what stays the same over all iterations.
pub(super) struct Ground {
    pub(super) n_cols: usize,
    pub(super) n_rows: usize,
    pub(super) start: usize,
    pub(super) goal: usize,
    pub(super) offsets: [isize; 8],
    /// Cells that ants can reach, in ascending order.
    pub(super) cells: Vec<u32>,
    /// By cell the desire of each step, at most 1.
    pub(super) desire: Vec<[f32; 8]>,
    /// Whether ants can reach the goal.
    pub(super) has_way: bool,
}

impl Ground {
    /// The ground with the nodes of its cells, whose weights are not yet set.
    pub(super) fn new(
        problem: &ColonyProblem,
        config: &ColonyConfig,
        limits: &mut Limits,
    ) -> Result<(Self, Vec<Node>), SearchError> {
        let moves = problem.moves();
        let mut ground = Self {
            n_cols: moves.n_cols(),
            n_rows: moves.n_rows(),
            start: moves.index(problem.start),
            goal: moves.index(problem.goal),
            offsets: moves.offsets(),
            cells: Vec::new(),
            desire: Vec::new(),
            has_way: false,
        };
        let mut nodes = nodes(problem, config);
        ground.cells = reachable(&nodes, ground.start, &ground.offsets);
        ground.has_way = ground.cells.binary_search(&(ground.goal as u32)).is_ok();
        let log = log_desire(problem, config, limits)?;
        ground.desire = ground.desires(&log, &nodes);
        if config.adjacent_goal == AdjacentGoal::Taken {
            take_goal(&mut nodes, ground.goal, &ground.offsets);
        }
        Ok((ground, nodes))
    }

    /// By cell the desire of each allowed step, the most desired of a cell at 1.
    fn desires(&self, log: &LogDesire, nodes: &[Node]) -> Vec<[f32; 8]> {
        let mut desire = vec![[0.0; 8]; nodes.len()];
        for &cell in &self.cells {
            let cell = cell as usize;
            let mut logs = [f64::NEG_INFINITY; 8];
            for step in steps_in(nodes[cell].allowed) {
                let to = cell.wrapping_add_signed(self.offsets[step]);
                logs[step] = log.cells[to] + log.steps[step];
            }
            let most = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            desire[cell] = logs.map(|log| (log - most).exp() as f32);
        }
        desire
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

fn nodes(problem: &ColonyProblem, config: &ColonyConfig) -> Vec<Node> {
    let (moves, directions) = (problem.moves(), problem.directions(config.directions));
    let allowed = moves.as_slice().iter().enumerate();
    let node = |(index, &allowed): (usize, &u8)| {
        let cell = moves.cell(index);
        let to_goal = problem.to_goal(cell);
        Node::new(
            Footmarks::place(moves.n_cols(), cell.col as usize, cell.row as usize),
            allowed & directions,
            config.transition.first_class(to_goal),
        )
    };
    allowed.map(node).collect()
}

/// Beside the goal the step to it is the only one.
fn take_goal(nodes: &mut [Node], goal: usize, offsets: &[isize; 8]) {
    for step in steps_in(nodes[goal].allowed) {
        let beside = goal.wrapping_add_signed(offsets[step]);
        let back = 1 << ((step + 4) % STEPS.len());
        nodes[beside].allowed &= back;
    }
}

/// The cells that allowed steps lead to, in ascending order.
fn reachable(nodes: &[Node], start: usize, offsets: &[isize; 8]) -> Vec<u32> {
    let mut is_reached = vec![false; nodes.len()];
    is_reached[start] = true;
    let mut cells = vec![start as u32];
    let mut next = 0;
    while let Some(&cell) = cells.get(next) {
        next += 1;
        for step in steps_in(nodes[cell as usize].allowed) {
            let to = (cell as usize).wrapping_add_signed(offsets[step]);
            if !std::mem::replace(&mut is_reached[to], true) {
                cells.push(to as u32);
            }
        }
    }
    cells.sort_unstable();
    cells
}

fn log_desire(
    problem: &ColonyProblem,
    config: &ColonyConfig,
    limits: &mut Limits,
) -> Result<LogDesire, SearchError> {
    let n_cells = problem.moves().as_slice().len();
    let mut desire = LogDesire {
        cells: vec![0.0; n_cells],
        steps: [0.0; 8],
    };
    config.visibility.add_to(&mut desire, problem);
    if config.guidance.needs_field() {
        let field = GoalField::new(
            problem.moves(),
            &[problem.goal],
            &mut limits.without_budget(),
        )?;
        // A cell without a way to the goal leads nowhere: the farthest that there is.
        let cells = |&cost: &u32| f64::from(cost) / f64::from(STRAIGHT_COST);
        let costs_to_go: Vec<f64> = field.costs().iter().map(cells).collect();
        config.guidance.add_to(&mut desire, &costs_to_go);
    }
    Ok(desire)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::colony::heuristic::step_length;
    use crate::colony::presets;
    use crate::map::{BitGrid, DiagonalRule};

    fn ground(config: &ColonyConfig, goal: Cell) -> (Ground, Vec<Node>) {
        let moves = MoveMasks::new(&BitGrid::new(5, 5), DiagonalRule::Always);
        let problem = ColonyProblem::new(moves, Cell::new(2, 2), goal);
        Ground::new(&problem, config, &mut Limits::new(&mut (), None, None)).unwrap()
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
        assert_eq!(ground(&config, up).1[12].allowed, 0b0111_0111);
        assert_eq!(ground(&config, down).1[12].allowed, 0b1101_1101);
    }

    #[test]
    fn beside_the_goal_only_the_step_to_it_is_left() {
        let (_, nodes) = ground(&presets::ant_system(), Cell::new(3, 3));
        assert_eq!(nodes[12].allowed, 0b0000_0010);
        let weighed = ColonyConfig {
            adjacent_goal: AdjacentGoal::Weighed,
            ..presets::ant_system()
        };
        assert_eq!(ground(&weighed, Cell::new(3, 3)).1[12].allowed, u8::MAX);
    }
}
