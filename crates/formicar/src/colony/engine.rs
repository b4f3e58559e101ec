//! The loop of a colony: walk, evaluate, remember, evaporate, deposit, limit, tell, stop.

use super::ant::Walker;
use super::config::{ColonyConfig, ColonyError};
use super::crew::{Crew, with_crew};
use super::generation::{Generation, Way};
use super::ground::Ground;
use super::history::{ColonyRun, History, Stop};
use super::initial::{Laid, PheromoneUnit};
use super::limits::Bounds;
use super::node::Node;
use super::problem::ColonyProblem;
use super::trails::Trails;
use crate::map::STEPS;
use crate::numeric::Seed;
use crate::objective::StepCounts;
use crate::progress::{ColonyView, Event, IterationRecord, Limits, Status, path_of};
use crate::search::SearchError;
use crate::vehicle::VehicleError;
use std::sync::Arc;
use thiserror::Error;

/// Why a colony did not run.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum RunError {
    /// A parameter is out of its range.
    #[error(transparent)]
    Config(#[from] ColonyError),
    /// Start or goal cannot be stood on, or the goal field ended.
    #[error(transparent)]
    Search(#[from] SearchError),
    /// A vehicle that cannot have the margin asked for.
    #[error(transparent)]
    Vehicle(#[from] VehicleError),
    /// More cells to reach than [`ColonyProblem::MAX_CELLS`].
    #[error(
        "a colony works on at most {max} cells, of the map's {n_cells} its ants can reach more; hint: colony.corridor.rule=\"ratio\", or a coarser resolution"
    )]
    TooLarge {
        /// Cells of the map.
        n_cells: usize,
        /// Cells that ants may reach.
        max: usize,
    },
}

/// Runs a colony on a problem.
///
/// Same problem, configuration and seed: same run, to the last bit, on any number of threads. A
/// step of the limits is a step of an ant; deadline and cancel are looked at between iterations.
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
    let (ground, nodes) = Ground::new(problem, config, limits)?;
    let initial = config.initial.lay(problem, &ground.cells, limits)?;
    let mut colony = Colony::new(problem, config, (&ground, nodes), initial);
    let stop = if ground.has_way() {
        let walker = || Walker::new(&ground, config, seed);
        with_crew(walker, config.n_ants, n_threads, |crew| {
            colony.run(crew, limits)
        })
    } else {
        Stop::NoWay
    };
    Ok(ColonyRun {
        best: colony
            .memory
            .best
            .map(|way| path_of(&STEPS, [problem.start(), problem.goal()], &way.steps)),
        earlier: Vec::new(),
        history: colony.history,
        stop,
        pheromone: colony.trails.by_cell(&ground),
    })
}

/// What a colony remembers from iteration to iteration.
#[derive(Default)]
pub(super) struct Memory {
    pub(super) best: Option<Way>,
    pub(super) worst: Option<Way>,
    /// Iterations so far that brought no better path.
    pub(super) n_stagnant: u32,
    /// Iterations since the last that did.
    pub(super) n_stalled: u32,
}

/// A run in progress.
struct Colony<'a> {
    problem: &'a ColonyProblem,
    config: &'a ColonyConfig,
    ground: &'a Ground,
    nodes: Arc<Vec<Node>>,
    trails: Trails,
    bounds: Bounds,
    memory: Memory,
    history: History,
}

impl<'a> Colony<'a> {
    fn new(
        problem: &'a ColonyProblem,
        config: &'a ColonyConfig,
        (ground, nodes): (&'a Ground, Vec<Node>),
        mut initial: Laid,
    ) -> Self {
        if config.initial.unit() == PheromoneUnit::Deposit {
            initial.scale(config.deposit.expected(config.n_ants) / straight_cost(problem, config));
        }
        Self {
            bounds: Bounds::new(initial.least, &nodes),
            trails: Trails::new(config.trails, &initial.values, ground, &nodes),
            nodes: Arc::new(nodes),
            memory: Memory::default(),
            history: History::default(),
            problem,
            config,
            ground,
        }
    }

    fn run(&mut self, crew: &mut Crew<Walker>, limits: &mut Limits) -> Stop {
        let mut generation = Generation::default();
        for iteration in 0..self.config.n_iterations {
            match limits.look() {
                Err(Status::Cancelled) => return Stop::Cancelled,
                Err(_) => return Stop::Deadline,
                Ok(()) => {}
            }
            let nodes = Arc::make_mut(&mut self.nodes);
            self.trails.weigh(self.config.alpha, self.ground, nodes);
            crew.walk(&self.nodes, iteration, &mut generation);
            let n_steps = limits.take(generation.n_steps());
            let is_cut = n_steps < generation.n_steps();
            generation.keep_steps(n_steps);
            generation.evaluate(&self.config.cost);
            self.remember(&generation);
            let record = self.update(iteration, &generation);
            limits.tell(&Event::Iteration(ColonyView {
                record: &record,
                ways: generation.view([self.problem.start(), self.problem.goal()]),
                pheromone: self.trails.view(),
            }));
            self.history.iterations.push(record);
            if is_cut {
                return Stop::Budget;
            }
            if let Some(stop) = self.is_done() {
                return stop;
            }
        }
        Stop::Iterations
    }

    fn remember(&mut self, generation: &Generation) {
        let (memory, stopping) = (&mut self.memory, &self.config.stopping);
        memory.n_stagnant += 1;
        memory.n_stalled += 1;
        let (Some(best), Some(worst)) = (generation.best(), generation.worst()) else {
            return;
        };
        let known = memory.best.as_ref().map(|known| known.cost);
        if known.is_none_or(|known| best.cost < known) {
            memory.best = Some(generation.way(best));
            memory.n_stagnant -= 1;
            if known.is_none_or(|known| best.cost < stopping.counts_below(known)) {
                memory.n_stalled = 0;
            }
        }
        if memory
            .worst
            .as_ref()
            .is_none_or(|known| worst.cost > known.cost)
        {
            memory.worst = Some(generation.way(worst));
        }
    }

    /// Evaporates, deposits, keeps the limits.
    fn update(&mut self, iteration: u32, generation: &Generation) -> IterationRecord {
        let rho = self.config.evaporation.rho(
            iteration,
            self.config.n_iterations,
            self.memory.n_stagnant,
        );
        self.trails.evaporate(rho);
        let deposits = self
            .config
            .deposit
            .deposits(iteration, generation, &self.memory);
        for (steps, amount) in deposits {
            self.trails.deposit(self.ground, steps, amount);
        }
        let strongest = self.config.deposit.expected(1);
        let (low, high) =
            self.config
                .limits
                .range(&self.bounds, strongest / rho, self.memory.best.as_ref());
        self.trails.clamp(low, high);
        self.record(iteration, generation, rho)
    }

    fn record(&self, iteration: u32, generation: &Generation, rho: f64) -> IterationRecord {
        let (costs, best) = (generation.costs(), self.memory.best.as_ref());
        let mean = |of: fn(&super::generation::AntCost) -> f64| {
            let sum: f64 = costs.iter().map(of).sum();
            (!costs.is_empty()).then(|| sum / costs.len() as f64)
        };
        let (min_pheromone, max_pheromone) = self.trails.range();
        IterationRecord {
            iteration,
            n_ants: generation.n_ants() as u32,
            n_arrived: costs.len() as u32,
            best_cost: generation.best().map(|ant| ant.cost),
            mean_cost: mean(|ant| ant.cost),
            best_length: generation.best().map(|ant| ant.length),
            mean_length: mean(|ant| ant.length),
            best_so_far_cost: best.map(|way| way.cost),
            best_so_far_length: best.map(|way| way.length),
            rho,
            min_pheromone: f64::from(min_pheromone),
            max_pheromone: f64::from(max_pheromone),
        }
    }

    fn is_done(&self) -> Option<Stop> {
        let stopping = &self.config.stopping;
        let cost = self.memory.best.as_ref()?.cost;
        if cost <= stopping.target_cost {
            return Some(Stop::TargetCost);
        }
        let patience = stopping.stall_iterations;
        (patience > 0 && self.memory.n_stalled >= patience).then_some(Stop::Stall)
    }
}

/// What the way from start to goal would cost if no obstacle stood there, turns aside; at least
/// that of one step.
fn straight_cost(problem: &ColonyProblem, config: &ColonyConfig) -> f64 {
    let (start, goal) = (problem.start(), problem.goal());
    let (dx, dy) = (start.col.abs_diff(goal.col), start.row.abs_diff(goal.row));
    config.cost.cost(StepCounts {
        n_straight: dx.abs_diff(dy).max(u32::from(dx == 0 && dy == 0)) as usize,
        n_diagonal: dx.min(dy) as usize,
        n_turns: 0,
    })
}
