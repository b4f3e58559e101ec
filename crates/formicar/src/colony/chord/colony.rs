//! A colony whose ants step by chords: Algorithm 1 of Li 2024.

use super::ant::ChordWorker;
use super::config::ChordConfig;
use super::graph::ChordGraph;
use super::problem::ChordProblem;
use super::shared::ChordShared;
use crate::colony::engine::{Colony, Engine, LoopParameters};
use crate::colony::error::RunError;
use crate::colony::generation::{Generation, StepSpace};
use crate::colony::initial::PheromoneUnit;
use crate::colony::memory::Memory;
use crate::colony::run::ColonyRun;
use crate::map::Cell;
use crate::numeric::Seed;
use crate::objective::PolylineCost;
use crate::progress::{History, Limits, Pheromone, Stop};
use std::sync::Arc;

/// Pheromone counts as gone below this; a floor keeps arithmetic off denormal numbers.
const NOTHING: f32 = 1e-30;

/// Runs a colony that steps by chords.
///
/// Same problem, configuration and seed: same run, to the last bit, on any number of threads. A
/// step of the limits is a step of an ant; deadline and cancel are looked at every few steps.
/// Set-up takes time in proportion to the cells of the map, a generation to the steps walked and
/// to the cells of the corridor.
///
/// # Errors
/// Parameters out of range, a start or goal off the map or blocked.
pub fn run_chords(
    problem: &ChordProblem,
    config: &ChordConfig,
    seed: Seed,
    n_threads: usize,
    limits: &mut Limits,
) -> Result<ColonyRun, RunError> {
    config.check()?;
    let Some(graph) = ChordGraph::new(problem, config, limits)? else {
        return Ok(ColonyRun {
            best: None,
            earlier: Vec::new(),
            history: History::default(),
            stop: Stop::NoWay,
            pheromone: vec![f32::NAN; problem.moves.as_slice().len()],
        });
    };
    let worker = || ChordWorker::new(&graph, seed);
    Ok(Engine::new(ChordColony::new(&graph)).run(worker, n_threads, limits))
}

/// A colony on the cells of a corridor.
struct ChordColony<'a> {
    graph: &'a ChordGraph<'a>,
    shared: Arc<ChordShared>,
    /// The cells of the corridor as indices, row by row.
    cells: Vec<u32>,
}

impl<'a> ChordColony<'a> {
    fn new(graph: &'a ChordGraph<'a>) -> Self {
        let (config, cells) = (graph.config, &graph.cells);
        let unit = match config.initial.unit {
            PheromoneUnit::Absolute => 1.0,
            PheromoneUnit::Deposit => config.deposit.unit(),
        };
        let path = graph.shortest.cells.iter();
        let path = path.filter_map(|&cell| cells.number(cell));
        let tau = config.initial.values(cells.len(), path).into_iter();
        let tau = tau.map(|tau| (unit * tau) as f32).collect();
        let n_cols = graph.problem.moves.n_cols() as u32;
        Self {
            shared: Arc::new(ChordShared {
                tau,
                known: vec![[0.0, f32::INFINITY]; cells.len()],
                factor: 0.0,
            }),
            cells: cells.iter().map(|c| c.row * n_cols + c.col).collect(),
            graph,
        }
    }
}

impl<'a> Colony for ChordColony<'a> {
    type Cost = PolylineCost;
    type Worker = ChordWorker<'a>;

    const PATIENCE_WITHOUT_PATH: Option<u32> = Some(2);

    fn parameters(&self) -> LoopParameters<'_> {
        LoopParameters {
            n_ants: self.graph.config.n_ants,
            n_iterations: self.graph.config.n_iterations,
            evaporation: &self.graph.config.evaporation,
            stopping: &self.graph.config.stopping,
        }
    }

    fn space(&self) -> StepSpace<'_> {
        self.graph.space()
    }

    fn prepare(&mut self, iteration: u32, _goes_on: &mut dyn FnMut() -> bool) -> &Arc<ChordShared> {
        let n_iterations = self.graph.config.n_iterations;
        Arc::make_mut(&mut self.shared).factor = factor(iteration, n_iterations);
        &self.shared
    }

    /// Learns how long paths are, evaporates, deposits: Li 2024 (20), (22-24).
    fn update(
        &mut self,
        _iteration: u32,
        rho: f64,
        generation: &Generation<PolylineCost>,
        _memory: &Memory<PolylineCost>,
    ) {
        let (graph, deposit) = (self.graph, &self.graph.config.deposit);
        let shared = Arc::make_mut(&mut self.shared);
        for ant in generation.arrived() {
            learn_lengths(graph, generation.steps_of(ant), &mut shared.known);
        }
        let kept = (1.0 - rho) as f32;
        for tau in &mut shared.tau {
            *tau = (*tau * kept).max(NOTHING);
        }
        for ant in deposit.depositors(generation) {
            let amount = deposit.amount(generation.cost(ant), &graph.reference) as f32;
            for cell in graph.space().path(generation.steps_of(ant)).cells {
                if let Some(number) = graph.cells.number(cell) {
                    shared.tau[number] += amount;
                }
            }
        }
    }

    fn pheromone(&self) -> Pheromone<'_> {
        Pheromone::Listed(&self.cells, &self.shared.tau)
    }

    fn pheromone_range(&self) -> (f32, f32) {
        let tau = self.shared.tau.iter();
        tau.fold((f32::INFINITY, 0.0), |(low, high), &tau| {
            (low.min(tau), high.max(tau))
        })
    }

    fn length_cells(&self, length: f64) -> f64 {
        length / self.graph.resolution_m
    }
}

/// (N - k) / k of the generation after `iteration` others, k = 1 for the first.
fn factor(iteration: u32, n_iterations: u32) -> f64 {
    let (k, n) = (f64::from(iteration) + 1.0, f64::from(n_iterations));
    (n - k) / k
}

/// Widens the range of known distances to the goal by a path that reached it.
fn learn_lengths(graph: &ChordGraph, steps: &[u8], known: &mut [[f32; 2]]) {
    let cells: Vec<Cell> = graph.space().path(steps).cells;
    let mut to_go = 0.0;
    for pair in cells.windows(2).rev() {
        let (dx, dy) = (
            f64::from(pair[1].col) - f64::from(pair[0].col),
            f64::from(pair[1].row) - f64::from(pair[0].row),
        );
        to_go += (dx * dx + dy * dy).sqrt();
        if let Some(number) = graph.cells.number(pair[0]) {
            let [longest, shortest] = known[number];
            let to_go = to_go as f32;
            known[number] = [longest.max(to_go), shortest.min(to_go)];
        }
    }
}
