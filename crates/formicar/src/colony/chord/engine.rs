//! The loop of a colony that steps by chords: Algorithm 1 of Li 2024.

use super::ant::{ChordWalker, Shared};
use super::config::ChordConfig;
use super::generation::ChordGeneration;
use super::ground::Ground;
use super::problem::ChordProblem;
use crate::colony::crew::{Crew, with_crew};
use crate::colony::engine::RunError;
use crate::colony::history::{ColonyRun, History, Stop};
use crate::colony::initial::PheromoneUnit;
use crate::map::Cell;
use crate::numeric::Seed;
use crate::objective::PolylineCost;
use crate::path::GridPath;
use crate::progress::{
    AntWays, ColonyView, Event, IterationRecord, Limits, Pheromone, Status, path_of,
};
use std::sync::Arc;

/// Pheromone counts as gone below this; a floor keeps arithmetic off denormal numbers.
const NOTHING: f32 = 1e-30;

/// Runs a colony that steps by chords.
///
/// Same problem, configuration and seed: same run, to the last bit, on any number of threads. A
/// step of the limits is a step of an ant; deadline and cancel are looked at between generations.
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
    let Some(ground) = Ground::new(problem, config, limits)? else {
        return Ok(ColonyRun {
            best: None,
            earlier: Vec::new(),
            history: History::default(),
            stop: Stop::NoWay,
            pheromone: vec![f32::NAN; problem.moves.as_slice().len()],
        });
    };
    let mut colony = Colony::new(&ground);
    let walker = || ChordWalker::new(&ground, seed);
    let stop = with_crew(walker, config.n_ants, n_threads, |crew| {
        colony.run(crew, limits)
    });
    let mut best = colony.best.iter().rev().map(|way| way.path(&ground));
    Ok(ColonyRun {
        best: best.next(),
        earlier: best.collect(),
        stop,
        pheromone: colony
            .pheromone()
            .by_cell(problem.moves.n_cols(), problem.moves.n_rows()),
        history: colony.history,
    })
}

/// A way that was the best of all when it was found.
struct Best {
    steps: Vec<u8>,
    cost: PolylineCost,
}

impl Best {
    fn path(&self, ground: &Ground) -> GridPath {
        path_of(&ground.ring.moves, [ground.start, ground.goal], &self.steps)
    }
}

/// A run in progress.
struct Colony<'a> {
    ground: &'a Ground<'a>,
    shared: Arc<Shared>,
    /// The cells of the corridor, by place row by row.
    places: Vec<u32>,
    /// The best ways, each better than the one before.
    best: Vec<Best>,
    /// Generations that brought no better way: in all, and since the last that did.
    n_stagnant: u32,
    n_stalled: u32,
    history: History,
}

impl<'a> Colony<'a> {
    fn new(ground: &'a Ground<'a>) -> Self {
        let (config, cells) = (ground.config, &ground.cells);
        let unit = match config.initial.unit {
            PheromoneUnit::Absolute => 1.0,
            PheromoneUnit::Deposit => config.deposit.unit(),
        };
        let path = ground.shortest.cells.iter();
        let path = path.filter_map(|&cell| cells.number(cell));
        let tau = config.initial.values(cells.len(), path).into_iter();
        let tau = tau.map(|tau| (unit * tau) as f32).collect();
        let n_cols = ground.problem.moves.n_cols() as u32;
        Self {
            shared: Arc::new(Shared {
                tau,
                known: vec![[0.0, f32::INFINITY]; cells.len()],
                factor: 0.0,
            }),
            places: cells.iter().map(|c| c.row * n_cols + c.col).collect(),
            best: Vec::new(),
            n_stagnant: 0,
            n_stalled: 0,
            history: History::default(),
            ground,
        }
    }

    fn run(&mut self, crew: &mut Crew<ChordWalker>, limits: &mut Limits) -> Stop {
        let config = self.ground.config;
        let mut generation = ChordGeneration::default();
        for iteration in 0..config.n_iterations {
            match limits.look() {
                Err(Status::Cancelled) => return Stop::Cancelled,
                Err(_) => return Stop::Deadline,
                Ok(()) => {}
            }
            Arc::make_mut(&mut self.shared).factor = factor(iteration, config.n_iterations);
            crew.walk(&self.shared, iteration, &mut generation);
            let n_steps = limits.take(generation.n_steps());
            let is_cut = n_steps < generation.n_steps();
            generation.keep_steps(n_steps);
            self.remember(&generation);
            let record = self.update(iteration, &generation);
            limits.tell(&Event::Iteration(ColonyView {
                record: &record,
                ways: self.view(&generation),
                pheromone: self.pheromone(),
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

    /// Keeps a way that is better than all before.
    fn remember(&mut self, generation: &ChordGeneration) {
        self.n_stagnant += 1;
        self.n_stalled += 1;
        let Some(ant) = generation.best() else {
            return;
        };
        let cost = generation.costs[ant];
        let known = self.best.last().map(|known| known.cost.cost);
        if known.is_some_and(|known| cost.cost >= known) {
            return;
        }
        self.n_stagnant -= 1;
        let stopping = &self.ground.config.stopping;
        if known.is_none_or(|known| cost.cost < stopping.counts_below(known)) {
            self.n_stalled = 0;
        }
        self.best.push(Best {
            steps: generation.steps_of(ant).to_vec(),
            cost,
        });
    }

    /// Learns how long ways are, evaporates, deposits: Li 2024 (20), (22-24).
    fn update(&mut self, iteration: u32, generation: &ChordGeneration) -> IterationRecord {
        let (ground, config) = (self.ground, self.ground.config);
        let shared = Arc::make_mut(&mut self.shared);
        for ant in generation.arrived() {
            learn_lengths(ground, generation.steps_of(ant), &mut shared.known);
        }
        let rho = config
            .evaporation
            .rho(iteration, config.n_iterations, self.n_stagnant);
        let kept = (1.0 - rho) as f32;
        for tau in &mut shared.tau {
            *tau = (*tau * kept).max(NOTHING);
        }
        for ant in config.deposit.depositors(generation) {
            let cost = &generation.costs[ant];
            let amount = config.deposit.amount(cost, &ground.reference) as f32;
            for cell in ground.cells_of(generation.steps_of(ant)) {
                if let Some(number) = ground.cells.number(cell) {
                    shared.tau[number] += amount;
                }
            }
        }
        self.record(iteration, generation, rho)
    }

    fn record(&self, iteration: u32, generation: &ChordGeneration, rho: f64) -> IterationRecord {
        let n_arrived = generation.arrived().count();
        let mean = |of: fn(&PolylineCost) -> f64| {
            let sum: f64 = generation
                .arrived()
                .map(|ant| of(&generation.costs[ant]))
                .sum();
            (n_arrived > 0).then(|| sum / n_arrived as f64)
        };
        let cells = |length_m: f64| length_m / self.ground.resolution_m;
        let best = generation.best().map(|ant| &generation.costs[ant]);
        let so_far = self.best.last().map(|way| &way.cost);
        let tau = self.shared.tau.iter();
        let (low, high) = tau.fold((f32::INFINITY, 0.0_f32), |(low, high), &tau| {
            (low.min(tau), high.max(tau))
        });
        IterationRecord {
            iteration,
            n_ants: generation.ends.len() as u32,
            n_arrived: n_arrived as u32,
            best_cost: best.map(|cost| cost.cost),
            mean_cost: mean(|cost| cost.cost),
            best_length: best.map(|cost| cells(cost.length_m)),
            mean_length: mean(|cost| cost.length_m).map(cells),
            best_so_far_cost: so_far.map(|cost| cost.cost),
            best_so_far_length: so_far.map(|cost| cells(cost.length_m)),
            rho,
            min_pheromone: f64::from(low),
            max_pheromone: f64::from(high),
        }
    }

    fn is_done(&self) -> Option<Stop> {
        let stopping = &self.ground.config.stopping;
        let patience = stopping.stall_iterations;
        let Some(best) = self.best.last() else {
            // Without a way there is more to hope for, but not for ever.
            let has_waited = self.n_stalled >= 2 * patience;
            return (patience > 0 && has_waited).then_some(Stop::Stall);
        };
        if best.cost.cost <= stopping.target_cost {
            return Some(Stop::TargetCost);
        }
        (patience > 0 && self.n_stalled >= patience).then_some(Stop::Stall)
    }

    fn view<'b>(&'b self, generation: &'b ChordGeneration) -> AntWays<'b> {
        AntWays {
            start: self.ground.start,
            goal: self.ground.goal,
            moves: &self.ground.ring.moves,
            steps: &generation.steps,
            ends: &generation.ends,
            arrived: &generation.arrived,
            best: generation.best(),
        }
    }

    fn pheromone(&self) -> Pheromone<'_> {
        Pheromone::Listed(&self.places, &self.shared.tau)
    }
}

/// (N - k) / k of the generation after `iteration` others, k = 1 for the first.
fn factor(iteration: u32, n_iterations: u32) -> f64 {
    let (k, n) = (f64::from(iteration) + 1.0, f64::from(n_iterations));
    (n - k) / k
}

/// Widens the range of known ways to the goal by a way that reached it.
fn learn_lengths(ground: &Ground, steps: &[u8], known: &mut [[f32; 2]]) {
    let cells: Vec<Cell> = ground.cells_of(steps).collect();
    let mut to_go = 0.0;
    for pair in cells.windows(2).rev() {
        let (dx, dy) = (
            f64::from(pair[1].col) - f64::from(pair[0].col),
            f64::from(pair[1].row) - f64::from(pair[0].row),
        );
        to_go += (dx * dx + dy * dy).sqrt();
        if let Some(number) = ground.cells.number(pair[0]) {
            let [longest, shortest] = known[number];
            let to_go = to_go as f32;
            known[number] = [longest.max(to_go), shortest.min(to_go)];
        }
    }
}
