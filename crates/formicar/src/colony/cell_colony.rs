//! A colony whose ants step from cell to cell.

use super::ant::CellWorker;
use super::config::ColonyConfig;
use super::cost::CellCost;
use super::engine::{Colony, Engine, LoopParameters};
use super::error::RunError;
use super::generation::{Generation, StepSpace};
use super::graph::StepGraph;
use super::initial::{InitialTrails, PheromoneUnit};
use super::limits::Bounds;
use super::memory::Memory;
use super::node::Node;
use super::problem::ColonyProblem;
use super::run::ColonyRun;
use super::trails::Trails;
use crate::map::STEPS;
use crate::numeric::Seed;
use crate::objective::StepCounts;
use crate::progress::{Limits, Pheromone, Stop};
use std::sync::Arc;

/// Runs a colony on a problem.
///
/// Same problem, configuration and seed: same run, to the last bit, on any number of threads. A
/// step of the limits is a step of an ant; deadline and cancel are looked at every few steps.
/// An iteration takes time in proportion to the cells that can be reached and to the steps walked.
///
/// # Errors
/// Parameters out of range, a start or goal off the map or blocked, too many cells to reach.
pub fn run(
    problem: &ColonyProblem,
    config: &ColonyConfig,
    seed: Seed,
    n_threads: usize,
    limits: &mut Limits,
) -> Result<ColonyRun, RunError> {
    config.check()?;
    problem.check_ends()?;
    let (graph, nodes) = StepGraph::new(problem, config, limits)?;
    let initial = config.initial.lay(problem, &graph.cells, limits)?;
    let engine = Engine::new(CellColony::new(problem, config, &graph, nodes, initial));
    if !graph.has_way() {
        return Ok(engine.finish(Stop::NoWay));
    }
    let worker = || CellWorker::new(&graph, config, seed);
    Ok(engine.run(worker, n_threads, limits))
}

/// A colony on the cells of a graph.
struct CellColony<'a> {
    problem: &'a ColonyProblem,
    config: &'a ColonyConfig,
    graph: &'a StepGraph,
    nodes: Arc<Vec<Node>>,
    trails: Trails,
    bounds: Bounds,
}

impl<'a> CellColony<'a> {
    fn new(
        problem: &'a ColonyProblem,
        config: &'a ColonyConfig,
        graph: &'a StepGraph,
        nodes: Vec<Node>,
        mut initial: InitialTrails,
    ) -> Self {
        if config.initial.unit() == PheromoneUnit::Deposit {
            initial.scale(config.deposit.expected(config.n_ants) / straight_cost(problem, config));
        }
        Self {
            bounds: Bounds::new(initial.least, &nodes),
            trails: Trails::new(config.trails, &initial.values, graph, &nodes),
            nodes: Arc::new(nodes),
            problem,
            config,
            graph,
        }
    }
}

impl<'a> Colony for CellColony<'a> {
    type Cost = CellCost;
    type Worker = CellWorker<'a>;

    const PATIENCE_WITHOUT_PATH: Option<u32> = None;

    fn parameters(&self) -> LoopParameters<'_> {
        LoopParameters {
            n_ants: self.config.n_ants,
            n_iterations: self.config.n_iterations,
            evaporation: &self.config.evaporation,
            stopping: &self.config.stopping,
        }
    }

    fn space(&self) -> StepSpace<'_> {
        StepSpace {
            start: self.problem.start(),
            goal: self.problem.goal(),
            moves: &STEPS,
            n_cols: self.graph.n_cols,
            n_rows: self.graph.n_rows,
        }
    }

    fn prepare(&mut self, _iteration: u32, goes_on: &mut dyn FnMut() -> bool) -> &Arc<Vec<Node>> {
        let nodes = Arc::make_mut(&mut self.nodes);
        self.trails
            .weigh(self.config.alpha, self.graph, nodes, goes_on);
        &self.nodes
    }

    fn update(
        &mut self,
        iteration: u32,
        rho: f64,
        generation: &Generation<CellCost>,
        memory: &Memory<CellCost>,
    ) {
        self.trails.evaporate(rho);
        let deposit = &self.config.deposit;
        for (steps, amount) in deposit.deposits(iteration, generation, memory) {
            self.trails.deposit(self.graph, steps, amount);
        }
        let lasting = deposit.expected(1) / rho;
        let limits = &self.config.limits;
        let (low, high) = limits.range(&self.bounds, lasting, memory.best());
        self.trails.clamp(low, high);
    }

    fn pheromone(&self) -> Pheromone<'_> {
        self.trails.view()
    }

    fn pheromone_range(&self) -> (f32, f32) {
        self.trails.range()
    }

    fn length_cells(&self, length: f64) -> f64 {
        length
    }
}

/// The cost of the path from start to goal without obstacles and turns; at least that of one step.
fn straight_cost(problem: &ColonyProblem, config: &ColonyConfig) -> f64 {
    let (start, goal) = (problem.start(), problem.goal());
    let (dx, dy) = (start.col.abs_diff(goal.col), start.row.abs_diff(goal.row));
    config.cost.cost(StepCounts {
        n_straight: dx.abs_diff(dy).max(u32::from(dx == 0 && dy == 0)) as usize,
        n_diagonal: dx.min(dy) as usize,
        n_turns: 0,
    })
}
