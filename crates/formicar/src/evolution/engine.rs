//! The loop of an evolution: breed, evaluate, remember, report, stop.

use super::config::EvolutionConfig;
use super::fitness::{Evaluation, Score};
use super::initial::first_population;
use super::mutation::mutate;
use super::problem::EvolutionProblem;
use super::reachable::ReachableCells;
use super::selection::{crossover, elite, tournament};
use crate::map::Cell;
use crate::numeric::Seed;
use crate::parameters::OutOfRange;
use crate::progress::{Event, History, IterationRecord, Limits, PopulationView, Stop, iterate};

/// The result of an evolution.
#[derive(Clone, Debug)]
pub struct EvolutionRun {
    /// The cheapest collision-free polyline: start, via points, goal; none if there was none.
    pub best: Option<Vec<Cell>>,
    /// All generations.
    pub history: History,
    /// Why it stopped.
    pub stop: Stop,
    /// The least length of a polyline of the last generation inside blocked cells, meters.
    pub least_obstructed_m: f64,
}

/// Breeds polylines.
///
/// Same problem, configuration and seed: same run, to the last bit. A step of the limits is the
/// evaluation of an individual; deadline and cancel are looked at before each.
///
/// # Errors
/// A parameter out of its range.
pub fn run(
    problem: &EvolutionProblem,
    config: &EvolutionConfig,
    seed: Seed,
    limits: &mut Limits,
) -> Result<EvolutionRun, OutOfRange> {
    config.check()?;
    let (blocked, rule) = (problem.blocked(), problem.rule());
    let goes_on = &mut || limits.look().is_ok();
    let reachable = ReachableCells::new(blocked, rule, problem.start, goes_on);
    if let Err(status) = limits.look() {
        return Ok(EvolutionRun {
            best: None,
            history: History::default(),
            stop: Stop::of_limit(status),
            least_obstructed_m: f64::INFINITY,
        });
    }
    let mut evolution = Evolution {
        config,
        seed,
        reachable,
        evaluation: Evaluation::new(problem, config),
        population: Population::default(),
        best: None,
        n_stalled: 0,
        history: History::default(),
    };
    let first = first_population(problem, config, &evolution.reachable, seed);
    let stop = evolution.run(first, limits)?;
    let scores = evolution.population.scores.iter();
    let least = scores.map(|score| (score.obstructed_cells - 1.0).max(0.0));
    Ok(EvolutionRun {
        best: evolution.best.map(|(line, _)| line),
        history: evolution.history,
        stop,
        least_obstructed_m: least.fold(f64::INFINITY, f64::min) * problem.resolution_m,
    })
}

/// Polylines and their scores.
#[derive(Default)]
struct Population {
    lines: Vec<Vec<Cell>>,
    scores: Vec<Score>,
}

/// A run in progress.
struct Evolution<'a> {
    config: &'a EvolutionConfig,
    seed: Seed,
    reachable: ReachableCells,
    evaluation: Evaluation<'a>,
    population: Population,
    best: Option<(Vec<Cell>, Score)>,
    /// Generations since the last that brought a better one.
    n_stalled: u32,
    history: History,
}

impl Evolution<'_> {
    fn run(&mut self, first: Vec<Vec<Cell>>, limits: &mut Limits) -> Result<Stop, OutOfRange> {
        let mut first = Some(first);
        iterate(self.config.n_generations, limits, |generation, limits| {
            let born = first.take().unwrap_or_else(|| self.offspring(generation));
            self.breed(generation, born, limits)
        })
    }

    /// Lets new individuals into the population; returns why it was the last generation, if it was.
    fn breed(
        &mut self,
        generation: u32,
        mut born: Vec<Vec<Cell>>,
        limits: &mut Limits,
    ) -> Result<Option<Stop>, OutOfRange> {
        let n_evaluated = limits.take(born.len() as u64) as usize;
        let is_cut = n_evaluated < born.len();
        if n_evaluated > 0 {
            born.truncate(n_evaluated);
            if let Some(stop) = self.take_over(born, limits)? {
                return Ok(Some(stop));
            }
            self.remember();
            self.report(generation, limits);
        }
        if is_cut {
            return Ok(Some(Stop::Budget));
        }
        let patience = self.config.stall_generations;
        let is_stalled = patience > 0 && self.best.is_some() && self.n_stalled >= patience;
        Ok(is_stalled.then_some(Stop::Stall))
    }

    /// The children of the population, each with random numbers of its own.
    fn offspring(&self, generation: u32) -> Vec<Vec<Cell>> {
        let config = self.config;
        let Population { lines, scores, .. } = &self.population;
        let child = |individual: u32| {
            let place = [u64::from(generation), u64::from(individual)];
            let mut random = self.seed.stream(place);
            let mut parent = || tournament(scores, config.tournament_size, &mut random);
            let [first, second] = [parent(), parent()];
            let mut line = if random.unit() < config.crossover {
                crossover(&lines[first], &lines[second], &mut random)
            } else {
                lines[first].clone()
            };
            mutate(&mut line, config, &self.reachable, &mut random);
            line
        };
        (config.n_elite..config.n_individuals).map(child).collect()
    }

    /// Keeps the elite, and replaces the others by the new individuals after scoring these; returns
    /// why it stopped before, if it did.
    fn take_over(
        &mut self,
        born: Vec<Vec<Cell>>,
        limits: &mut Limits,
    ) -> Result<Option<Stop>, OutOfRange> {
        let old = std::mem::take(&mut self.population);
        for survivor in elite(&old.scores, self.config.n_elite as usize) {
            self.population.lines.push(old.lines[survivor].clone());
            self.population.scores.push(old.scores[survivor]);
        }
        for line in born {
            if let Err(status) = limits.look() {
                return Ok(Some(Stop::of_limit(status)));
            }
            self.population.scores.push(self.evaluation.score(&line)?);
            self.population.lines.push(line);
        }
        Ok(None)
    }

    fn remember(&mut self) {
        self.n_stalled += 1;
        let Some(best) = self.population.best() else {
            return;
        };
        let score = self.population.scores[best];
        let is_better = |(_, known): &(Vec<Cell>, Score)| score.cost < known.cost;
        if self.best.as_ref().is_none_or(is_better) {
            self.best = Some((self.population.lines[best].clone(), score));
            self.n_stalled = 0;
        }
    }

    fn report(&mut self, generation: u32, limits: &mut Limits) {
        let record = self.record(generation);
        let scores = &self.population.scores;
        let is_free: Vec<bool> = scores.iter().map(Score::is_free).collect();
        let fitness: Vec<f64> = scores.iter().map(|score| score.fitness).collect();
        limits.tell(&Event::Generation(PopulationView {
            record: &record,
            lines: &self.population.lines,
            is_free: &is_free,
            fitness: &fitness,
            best: self.population.best(),
        }));
        self.history.iterations.push(record);
    }

    fn record(&self, generation: u32) -> IterationRecord {
        let population = &self.population;
        let free = || population.scores.iter().filter(|score| score.is_free());
        let n_free = free().count();
        let mean = |of: fn(&Score) -> f64| {
            let sum: f64 = free().map(of).sum();
            (n_free > 0).then(|| sum / n_free as f64)
        };
        let best = population.best().map(|best| population.scores[best]);
        let best_so_far = self.best.as_ref().map(|(_, score)| score);
        IterationRecord {
            iteration: generation,
            n_ants: population.lines.len() as u32,
            n_arrived: n_free as u32,
            best_cost: best.map(|score| score.cost),
            mean_cost: mean(|score| score.cost),
            best_length: best.map(|score| score.length_cells),
            mean_length: mean(|score| score.length_cells),
            best_so_far_cost: best_so_far.map(|score| score.cost),
            best_so_far_length: best_so_far.map(|score| score.length_cells),
            ..IterationRecord::default()
        }
    }
}

impl Population {
    /// The cheapest individual that is free of collisions, the first among equals.
    fn best(&self) -> Option<usize> {
        let free = (0..self.scores.len()).filter(|&i| self.scores[i].is_free());
        free.min_by(|&a, &b| self.scores[a].cost.total_cmp(&self.scores[b].cost))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::{BitGrid, DiagonalRule, MoveMasks, OccupancyGrid, cells_in_sight};
    use crate::progress::Observer;
    use crate::search::{AstarWorkspace, GridSearch, astar};
    use proptest::prelude::*;

    /// Keeps the least fitness of each generation.
    #[derive(Default)]
    struct Fittest(Vec<f64>);

    impl Observer for Fittest {
        fn on_event(&mut self, event: &Event) {
            if let Event::Generation(view) = event {
                assert_eq!(view.lines.len(), view.record.n_ants as usize);
                let fitness = view.fitness.iter().copied();
                self.0.push(fitness.fold(f64::INFINITY, f64::min));
            }
        }
    }

    fn shortest(moves: &MoveMasks, ends: [Cell; 2]) -> Option<GridSearch> {
        let mut nobody = ();
        let mut limits = Limits::new(&mut nobody, None, None);
        astar(
            moves,
            ends[0],
            ends[1],
            &mut AstarWorkspace::new(),
            &mut limits,
        )
        .ok()
    }

    fn evolved(
        moves: &MoveMasks,
        ends: [Cell; 2],
        config: &EvolutionConfig,
        seed: u64,
        watch: &mut dyn Observer,
    ) -> Option<EvolutionRun> {
        let shortest = shortest(moves, ends)?;
        let problem = EvolutionProblem::new(moves, &shortest, 0.5, [2.0, 0.7]).unwrap();
        let mut limits = Limits::new(watch, None, None);
        Some(run(&problem, config, Seed(seed), &mut limits).unwrap())
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(ProptestConfig::default().cases / 10))]

        #[test]
        fn the_best_never_gets_worse_and_the_best_of_all_is_free(
            bits in prop::collection::vec(prop::bool::weighted(0.1), 40 * 30),
            seed in any::<u64>(),
            is_seeded in any::<bool>(),
            rule in prop::sample::select(&DiagonalRule::ALL[..]),
        ) {
            let mut blocked = BitGrid::new(40, 30);
            for (i, _) in bits.iter().enumerate().filter(|(_, is_set)| **is_set) {
                blocked.insert(Cell::new((i % 40) as u32, (i / 40) as u32));
            }
            let ends = [Cell::new(0, 0), Cell::new(39, 29)];
            blocked.remove_all(ends);
            let moves = MoveMasks::new(&blocked, rule);
            let base = if is_seeded { EvolutionConfig::aga() } else { EvolutionConfig::ga() };
            let config = EvolutionConfig { n_individuals: 20, n_generations: 25, ..base };
            let mut watch = Fittest::default();
            let Some(run) = evolved(&moves, ends, &config, seed, &mut watch) else {
                return Ok(());
            };
            prop_assert!(watch.0.windows(2).all(|w| w[1] <= w[0]), "{:?}", watch.0);
            let costs = run.history.iterations.iter().map(|r| r.best_so_far_cost);
            let costs: Vec<f64> = costs.flatten().collect();
            prop_assert!(costs.windows(2).all(|w| w[1] <= w[0]), "{costs:?}");
            prop_assert_eq!(run.best.is_some(), !costs.is_empty());
            if let Some(best) = run.best {
                prop_assert_eq!([best[0], best[best.len() - 1]], ends);
                prop_assert!((3..=10).contains(&best.len()));
                let is_seen = |w: &[Cell]| cells_in_sight(&blocked, rule, w[0], w[1]);
                prop_assert!(best.windows(2).all(is_seen));
            }
        }
    }

    /// A wall with a gap near the top.
    fn gap() -> MoveMasks {
        let mut rows = [".........................#........................"; 30];
        rows[3] = "..................................................";
        rows[4] = rows[3];
        let map = OccupancyGrid::from_rows(&rows, 0.5).unwrap();
        MoveMasks::new(&map.lethal_cells(), DiagonalRule::NoObstacles)
    }

    const ENDS: [Cell; 2] = [Cell::new(2, 2), Cell::new(47, 2)];

    #[test]
    fn finds_the_gap_and_comes_near_the_shortest_way() {
        let (moves, config) = (gap(), EvolutionConfig::ga());
        let found = evolved(&moves, ENDS, &config, 1, &mut ()).unwrap();
        let last = *found.history.iterations.last().unwrap();
        let shortest = shortest(&moves, ENDS).unwrap().length_cells();
        assert!(
            last.best_so_far_length.unwrap() < 1.1 * shortest,
            "{last:?}"
        );
        assert!(last.n_arrived > 50 && last.n_ants == 100);
        assert_eq!(found.stop, Stop::Iterations);
        assert_eq!(found.least_obstructed_m, 0.0);
    }

    #[test]
    fn seeds_are_free_from_the_first_generation_on() {
        let moves = gap();
        let first = |config: &EvolutionConfig| {
            let run = evolved(&moves, ENDS, config, 1, &mut ()).unwrap();
            run.history.iterations[0]
        };
        let (random, seeded) = (
            first(&EvolutionConfig::ga()),
            first(&EvolutionConfig::aga()),
        );
        assert!(seeded.n_arrived > random.n_arrived, "{seeded:?} {random:?}");
        let shortest = shortest(&moves, ENDS).unwrap().length_cells();
        assert!(seeded.best_length.unwrap() < 1.1 * shortest, "{seeded:?}");
    }

    #[test]
    fn stops_where_nothing_gets_better_and_where_the_budget_ends() {
        let moves = gap();
        let config = EvolutionConfig {
            stall_generations: 3,
            n_generations: 10_000,
            ..EvolutionConfig::aga()
        };
        let run_of = |budget| {
            let shortest = shortest(&moves, ENDS).unwrap();
            let problem = EvolutionProblem::new(&moves, &shortest, 0.5, [2.0, 0.7]).unwrap();
            let mut nobody = ();
            let mut limits = Limits::new(&mut nobody, budget, None);
            let found = run(&problem, &config, Seed(1), &mut limits).unwrap();
            (found, limits.n_steps())
        };
        assert_eq!(run_of(None).0.stop, Stop::Stall);
        let (cut, n_steps) = run_of(Some(150));
        assert_eq!((cut.stop, n_steps), (Stop::Budget, 150));
        let n_ants: Vec<u32> = cut.history.iterations.iter().map(|r| r.n_ants).collect();
        assert_eq!(n_ants, [100, 52], "two of the elite and fifty children");
    }
}
