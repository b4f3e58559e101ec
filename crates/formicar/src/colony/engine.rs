//! The loop of every colony: walk, remember, update pheromone, report, stop.

use super::cost::AntCost;
use super::evaporation::Evaporation;
use super::generation::{Generation, StepSpace};
use super::memory::Memory;
use super::run::ColonyRun;
use super::stopping::Stopping;
use super::worker_pool::{AntWorker, WorkerPool, with_workers};
use crate::progress::Pheromone;
use crate::progress::{ColonyView, Event, History, IterationRecord, Limits, Stop, iterate};
use std::convert::Infallible;
use std::sync::Arc;

/// A colony that the [`Engine`] runs: its pheromone, and what its ants read.
pub(super) trait Colony {
    /// The cost of an ant's path.
    type Cost: AntCost;
    /// Walks the ants.
    type Worker: AntWorker<Batch = Generation<Self::Cost>>;

    /// A colony that has found no path yet stops after this many times the iterations after which
    /// one with a path stops; none if it never gives up.
    const PATIENCE_WITHOUT_PATH: Option<u32>;

    /// The parameters of the loop.
    fn parameters(&self) -> LoopParameters<'_>;

    /// The ends of all paths, and the steps between them.
    fn space(&self) -> StepSpace<'_>;

    /// Makes ready what the ants of an iteration read; of no use where `goes_on` said no meanwhile.
    fn prepare(
        &mut self,
        iteration: u32,
        goes_on: &mut dyn FnMut() -> bool,
    ) -> &Arc<<Self::Worker as AntWorker>::Shared>;

    /// Evaporates a share `rho` of the pheromone, and deposits what the ants of an iteration add.
    fn update(
        &mut self,
        iteration: u32,
        rho: f64,
        generation: &Generation<Self::Cost>,
        memory: &Memory<Self::Cost>,
    );

    /// All pheromone.
    fn pheromone(&self) -> Pheromone<'_>;

    /// The least and the most pheromone where ants can go.
    fn pheromone_range(&self) -> (f32, f32);

    /// A length of [`AntCost::length`] in cells.
    fn length_cells(&self, length: f64) -> f64;
}

/// The parameters of the loop.
pub(super) struct LoopParameters<'a> {
    pub(super) n_ants: u32,
    pub(super) n_iterations: u32,
    pub(super) evaporation: &'a Evaporation,
    pub(super) stopping: &'a Stopping,
}

/// Runs a colony.
pub(super) struct Engine<C: Colony> {
    colony: C,
    memory: Memory<C::Cost>,
    history: History,
}

impl<C: Colony> Engine<C> {
    pub(super) fn new(colony: C) -> Self {
        Self {
            colony,
            memory: Memory::default(),
            history: History::default(),
        }
    }

    /// Runs all iterations, with workers on at most `n_threads` threads.
    pub(super) fn run(
        mut self,
        worker: impl Fn() -> C::Worker,
        n_threads: usize,
        limits: &mut Limits,
    ) -> ColonyRun {
        let LoopParameters {
            n_ants,
            n_iterations,
            ..
        } = self.colony.parameters();
        let stop = with_workers(worker, n_ants, n_threads, |pool| {
            let mut generation = Generation::default();
            let Ok(stop) = iterate::<Infallible>(n_iterations, limits, |iteration, limits| {
                Ok(self.run_iteration(iteration, pool, &mut generation, limits))
            });
            stop
        });
        self.finish(stop)
    }

    /// The result of a run that has stopped.
    pub(super) fn finish(self, stop: Stop) -> ColonyRun {
        let space = self.colony.space();
        let paths = self.memory.improvements.iter().rev();
        let mut paths = paths.map(|path| space.path(&path.steps));
        ColonyRun {
            best: paths.next(),
            earlier: paths.collect(),
            stop,
            pheromone: self.colony.pheromone().by_cell(space.n_cols, space.n_rows),
            history: self.history,
        }
    }

    /// Runs an iteration; returns why it was the last, if it was.
    fn run_iteration(
        &mut self,
        iteration: u32,
        pool: &mut WorkerPool<C::Worker>,
        generation: &mut Generation<C::Cost>,
        limits: &mut Limits,
    ) -> Option<Stop> {
        let mut goes_on = || limits.look().is_ok();
        let shared = self.colony.prepare(iteration, &mut goes_on);
        if goes_on() {
            pool.walk_while(shared, iteration, generation, &mut goes_on);
        }
        if let Err(status) = limits.look() {
            return Some(Stop::of_limit(status));
        }
        let n_steps = limits.take(generation.n_steps());
        let is_cut = n_steps < generation.n_steps();
        generation.keep_steps(n_steps);
        self.update(iteration, generation, limits);
        if is_cut {
            return Some(Stop::Budget);
        }
        self.is_done()
    }

    /// Remembers, updates pheromone, and reports.
    fn update(&mut self, iteration: u32, generation: &Generation<C::Cost>, limits: &mut Limits) {
        let (memory, parameters) = (&mut self.memory, self.colony.parameters());
        let best = generation.best();
        memory.update(generation, best, parameters.stopping);
        let (n_iterations, n_stagnant) = (parameters.n_iterations, memory.n_stagnant);
        let rho = parameters
            .evaporation
            .rho(iteration, n_iterations, n_stagnant);
        self.colony.update(iteration, rho, generation, memory);
        let record = self.record(iteration, rho, generation, best);
        limits.tell(&Event::Iteration(ColonyView {
            record: &record,
            ways: generation.view(self.colony.space(), best),
            pheromone: self.colony.pheromone(),
        }));
        self.history.iterations.push(record);
    }

    fn record(
        &self,
        iteration: u32,
        rho: f64,
        generation: &Generation<C::Cost>,
        best: Option<usize>,
    ) -> IterationRecord {
        let n_arrived = generation.arrived().count();
        let mean = |value: fn(&C::Cost) -> f64| {
            let arrived = generation.arrived();
            let sum: f64 = arrived.map(|ant| value(generation.cost(ant))).sum();
            (n_arrived > 0).then(|| sum / n_arrived as f64)
        };
        let cells = |length: f64| self.colony.length_cells(length);
        let best = best.map(|ant| generation.cost(ant));
        let best_so_far = self.memory.best().map(|path| &path.cost);
        let (min_pheromone, max_pheromone) = self.colony.pheromone_range();
        IterationRecord {
            iteration,
            n_ants: generation.n_ants() as u32,
            n_arrived: n_arrived as u32,
            best_cost: best.map(C::Cost::cost),
            mean_cost: mean(C::Cost::cost),
            best_length: best.map(|best| cells(best.length())),
            mean_length: mean(C::Cost::length).map(cells),
            best_so_far_cost: best_so_far.map(C::Cost::cost),
            best_so_far_length: best_so_far.map(|best| cells(best.length())),
            rho,
            min_pheromone: f64::from(min_pheromone),
            max_pheromone: f64::from(max_pheromone),
        }
    }

    fn is_done(&self) -> Option<Stop> {
        let stopping = self.colony.parameters().stopping;
        let patience = match self.memory.best() {
            Some(best) if best.cost.cost() <= stopping.target_cost => {
                return Some(Stop::TargetCost);
            }
            Some(_) => stopping.stall_iterations,
            None => C::PATIENCE_WITHOUT_PATH? * stopping.stall_iterations,
        };
        (patience > 0 && self.memory.n_stalled >= patience).then_some(Stop::Stall)
    }
}
