//! Mean and lowest cost J by generation (Li 2024, figure 12).

use super::drive::{Drawn, Job};
use super::methods::Generations;
use crate::analysis::statistics::quartiles;
use crate::papers::trial::diagonal_rule;
use crate::report::{Trend, TrendPanel, Trends};
use anyhow::Result;
use formicar::geometry::Point2;
use formicar::map::{BitGrid, DiagonalRule};
use formicar::numeric::Seed;
use formicar::progress::{AntWays, Event, IterationRecord, Observer, StdClock};
use formicar::render::AxisScale;
use formicar::smoothing::RedundantNodes;
use std::time::Duration;

/// Costs of the runs of a method by generation; a run that stopped keeps its last values.
#[derive(Clone, Debug)]
pub(super) struct CostHistory {
    method: String,
    /// The lowest cost so far of each run, with paths tried and milliseconds.
    progress: Vec<Vec<Progress>>,
    /// Quartiles of the mean cost.
    mean: Vec<Option<[f64; 3]>>,
    /// Quartiles of the lowest cost so far.
    lowest: Vec<Option<[f64; 3]>>,
}

/// Mean and lowest so far.
type Generation = [Option<f64>; 2];

/// Paths tried, milliseconds, and the lowest cost so far.
type Progress = [f64; 3];

/// The origin of the costs of a generation.
enum Source<'a> {
    Record,
    Ways {
        job: Job<'a>,
        blocked: &'a BitGrid,
        rule: DiagonalRule,
    },
}

/// Runs a method again, watched, with seeds from 0 on; `None` where it has no generations.
pub(super) fn watch(
    job: Job,
    kind: Generations,
    drawn: &Drawn,
    n_seeds: u64,
) -> Result<Option<CostHistory>> {
    let layers = drawn.run.outcome.stages().layers.as_ref();
    let source = match (kind, layers.map(|layers| &layers.blocked)) {
        (Generations::Record, _) => Source::Record,
        (Generations::Ways, Some(blocked)) => Source::Ways {
            job,
            blocked,
            rule: diagonal_rule(&job.variant.config),
        },
        _ => return Ok(None),
    };
    let (mut runs, mut progress) = (Vec::new(), Vec::new());
    for seed in 0..n_seeds {
        let clock = StdClock::start();
        let mut planner = job.ground.planner(&job.variant.config)?;
        let mut watcher = Watcher {
            source: &source,
            generations: Vec::new(),
            progress: Vec::new(),
            n_tried: 0,
            clock,
            watched: Duration::ZERO,
        };
        planner.plan(&job.ground.request, Seed(seed), &mut watcher)?;
        runs.push(watcher.generations);
        progress.push(watcher.progress);
    }
    let history = CostHistory::new(&job.variant.name, &runs);
    Ok(history.map(|history| CostHistory {
        progress,
        ..history
    }))
}

struct Watcher<'a> {
    source: &'a Source<'a>,
    generations: Vec<Generation>,
    progress: Vec<Progress>,
    n_tried: u64,
    clock: StdClock,
    /// Time spent in the observer itself.
    watched: Duration,
}

impl Observer for Watcher<'_> {
    fn on_event(&mut self, event: &Event) {
        let after = self.clock.now().saturating_sub(self.watched);
        if let Some((record, costs)) = self.source.costs(event) {
            self.note(record, costs, after);
        }
        self.watched = self.clock.now().saturating_sub(after);
    }
}

impl Watcher<'_> {
    fn note(&mut self, record: &IterationRecord, [mean, best]: Generation, after: Duration) {
        if record.iteration == 0 {
            // A method that tries again begins anew.
            self.generations.clear();
            self.progress.clear();
        }
        self.n_tried += u64::from(record.n_ants);
        let before = self.generations.last().and_then(|last| last[1]);
        let lowest = [before, best].into_iter().flatten().reduce(f64::min);
        self.generations.push([mean, lowest]);
        let ms = after.as_secs_f64() * 1e3;
        let progress = lowest.map(|lowest| [self.n_tried as f64, ms, lowest]);
        self.progress.extend(progress);
    }
}

impl Source<'_> {
    /// Mean and least J of a generation, and its record; `None` for other events.
    fn costs<'b>(&self, event: &'b Event) -> Option<(&'b IterationRecord, Generation)> {
        let (record, ways) = match event {
            Event::Iteration(view) => (view.record, Some(&view.ways)),
            Event::Generation(view) => (view.record, None),
            _ => return None,
        };
        let costs = match (self, ways) {
            (Self::Ways { job, blocked, rule }, Some(ways)) => of_ways(job, ways, blocked, *rule),
            _ => [record.mean_cost, record.best_cost],
        };
        Some((record, costs))
    }
}

/// Mean and least J of the ways that arrived, without their redundant nodes.
fn of_ways(job: &Job, ways: &AntWays, blocked: &BitGrid, rule: DiagonalRule) -> Generation {
    let frame = job.ground.grid.frame();
    let cost = |ant: usize| {
        let nodes = RedundantNodes::Remove.apply(blocked, rule, &ways.way(ant));
        let points: Vec<Point2> = nodes.into_iter().map(|node| frame.center(node)).collect();
        Some(job.cost(&points).ok()??[0])
    };
    let arrived = (0..ways.n_ants()).filter(|&ant| ways.arrived[ant]);
    let costs: Vec<f64> = arrived.filter_map(cost).collect();
    let mean = costs.iter().sum::<f64>() / costs.len() as f64;
    [
        (!costs.is_empty()).then_some(mean),
        costs.into_iter().reduce(f64::min),
    ]
}

impl CostHistory {
    /// `None` where no run had a generation with a cost.
    fn new(method: &str, runs: &[Vec<Generation>]) -> Option<Self> {
        let n_generations = runs.iter().map(Vec::len).max().filter(|&n| n > 0)?;
        let over_runs = |which: usize, i: usize| {
            let value = |run: &Vec<Generation>| run.get(i).or(run.last()).and_then(|g| g[which]);
            let values: Vec<f64> = runs.iter().filter_map(value).collect();
            quartiles(&values)
        };
        let quartiles = |which: usize| (0..n_generations).map(|i| over_runs(which, i)).collect();
        let lowest: Vec<_> = quartiles(1);
        lowest.iter().any(Option::is_some).then(|| Self {
            method: method.to_owned(),
            progress: Vec::new(),
            mean: quartiles(0),
            lowest,
        })
    }

    /// The lowest cost so far over one of the measures of [`Progress`].
    fn by_progress(&self, which: usize) -> Vec<[f64; 4]> {
        let run = |run: &Vec<Progress>| run.iter().map(|at| [at[which], at[2]]).collect();
        let runs: Vec<Vec<[f64; 2]>> = self.progress.iter().map(run).collect();
        Trend::of_runs(&self.method, &runs, AxisScale::Log).points
    }
}

/// Figure 12: the mean cost of all methods by generation.
pub(super) fn means(histories: &[CostHistory]) -> Trends {
    Trends {
        caption: "Mean cost J of each generation, as in figure 12 of the paper: medians over the \
                  seeds, and quartiles as bands. A run that stopped keeps its last values."
            .to_owned(),
        quantity: "mean J of a generation".to_owned(),
        panels: vec![TrendPanel {
            x: "generation".to_owned(),
            trends: trends(histories, |history| by_generation(&history.mean)),
            ..TrendPanel::default()
        }],
        ..Trends::default()
    }
}

/// Figure 12: the lowest cost so far by generation, by paths tried and by time.
pub(super) fn lowest(histories: &[CostHistory]) -> Trends {
    let panel = |x: &str, which: usize| TrendPanel {
        x: x.to_owned(),
        x_scale: AxisScale::Log,
        trends: trends(histories, |history| history.by_progress(which)),
    };
    Trends {
        caption: "Lowest cost J so far, as in figure 12 of the paper: medians and quartiles over \
                  the seeds, by generation, by paths tried (ants, or individuals) and by time \
                  since the map set-up began, less the time that watching took."
            .to_owned(),
        quantity: "lowest J so far".to_owned(),
        panels: vec![
            TrendPanel {
                x: "generation".to_owned(),
                trends: trends(histories, |history| by_generation(&history.lowest)),
                ..TrendPanel::default()
            },
            panel("paths tried", 0),
            panel("time, ms", 1),
        ],
        ..Trends::default()
    }
}

/// A trend per method.
fn trends(histories: &[CostHistory], points: impl Fn(&CostHistory) -> Vec<[f64; 4]>) -> Vec<Trend> {
    let trend = |history: &CostHistory| Trend {
        name: history.method.clone(),
        points: points(history),
    };
    histories.iter().map(trend).collect()
}

/// Generations from 1 on that have a value.
fn by_generation(values: &[Option<[f64; 3]>]) -> Vec<[f64; 4]> {
    let numbered = values.iter().enumerate();
    let point = |(i, value): (usize, &Option<[f64; 3]>)| {
        let [low, median, high] = (*value)?;
        Some([i as f64 + 1.0, low, median, high])
    };
    numbered.filter_map(point).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_that_stop_keep_their_last_values() {
        let runs = [
            vec![[None, None], [Some(3.0), Some(2.0)]],
            vec![[Some(5.0), Some(4.0)]],
        ];
        let history = CostHistory::new("x", &runs).unwrap();
        assert_eq!(history.mean, [Some([5.0; 3]), Some([3.5, 4.0, 4.5])]);
        assert_eq!(history.lowest, [Some([4.0; 3]), Some([2.5, 3.0, 3.5])]);
        assert!(CostHistory::new("x", &[Vec::new()]).is_none());
        assert!(CostHistory::new("x", &[vec![[None, None]]]).is_none());
    }
}
