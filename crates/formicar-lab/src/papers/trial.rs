//! One run of a colony, from the map to the judge.

use crate::papers::experiment::{Ground, Variant};
use crate::run::{TimedIteration, measure};
use anyhow::Result;
use formicar::map::{BitGrid, Cell, DiagonalRule, MoveMasks};
use formicar::numeric::Seed;
use formicar::path::GridPath;
use formicar::planner::{Outcome, PlannerConfig, Stages};
use formicar::progress::{History, IterationRecord, Limits};
use formicar::search::GoalField;
use serde::Serialize;
use std::f64::consts::SQRT_2;

/// The result of a run; lengths of the ants' way are in cells, a diagonal step counting sqrt(2).
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Trial {
    /// The map.
    pub map: String,
    /// The configuration.
    pub variant: String,
    /// The seed.
    pub seed: u64,
    /// An ant reached the goal.
    pub arrived: bool,
    /// The judge certified the smoothed path.
    pub certified: bool,
    /// Length of the ants' best way.
    pub length_cells: Option<f64>,
    /// Length of the shortest way under the same layers and moves.
    pub optimum_cells: Option<f64>,
    /// Changes of direction on the ants' best way.
    pub n_turns: Option<usize>,
    /// Its cells.
    pub n_nodes_before: Option<usize>,
    /// Nodes that are left of them.
    pub n_nodes_after: Option<usize>,
    /// Diagonal steps of it between two obstacles that meet at a corner.
    pub n_squeezes: Option<usize>,
    /// Iterations until the best way was found.
    pub n_to_best: Option<u32>,
    /// Iterations until a way at most 1 % dearer was found.
    pub n_to_1_percent: Option<u32>,
    /// Iterations in all.
    pub n_iterations: usize,
    /// Share of all ants that arrived.
    pub arrived_share: f64,
    /// Length of the certified path, meters.
    pub length_m: Option<f64>,
    /// Its least clearance, meters.
    pub min_clearance_m: Option<f64>,
    /// Length of the best way after a tenth of the iterations that a run may have.
    pub early_length_cells: Option<f64>,
    /// Standard deviation of the lengths of each iteration's best way over the second half of the
    /// run: how much the ants still try.
    pub late_spread_cells: Option<f64>,
    /// The query in all: layers, colony, smoothing, judge; milliseconds.
    pub query_ms: f64,
    /// The colony alone, milliseconds.
    pub search_ms: f64,
}

/// A run with its moments.
#[derive(Clone, Debug)]
pub(crate) struct Run {
    /// Its result.
    pub(crate) trial: Trial,
    /// The state after each iteration.
    pub(crate) moments: Vec<Moment>,
}

/// The state after an iteration; lengths in cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Moment {
    /// Iterations done.
    pub(crate) iteration: u32,
    /// Ants sent out so far.
    pub(crate) n_ants: u64,
    /// Time since the colony set out.
    pub(crate) ms: f64,
    /// Length of the best way so far.
    pub(crate) best_so_far_length: Option<f64>,
    /// Length of the iteration's best way.
    pub(crate) best_length: Option<f64>,
    /// Mean length of the ways that arrived.
    pub(crate) mean_length: Option<f64>,
    /// Evaporation.
    pub(crate) rho: f64,
}

impl Moment {
    /// The states after all iterations.
    fn all(iterations: &[TimedIteration]) -> Vec<Self> {
        let mut n_ants = 0;
        let moment = |TimedIteration { at_s, record }: &TimedIteration| {
            n_ants += u64::from(record.n_ants);
            Self {
                iteration: record.iteration + 1,
                n_ants,
                ms: 1e3 * at_s,
                best_so_far_length: record.best_so_far_length,
                best_length: record.best_length,
                mean_length: record.mean_length,
                rho: record.rho,
            }
        };
        iterations.iter().map(moment).collect()
    }
}

impl Trial {
    /// Runs a variant on a ground.
    pub(crate) fn run(ground: &Ground, variant: &Variant, seed: u64) -> Result<Run> {
        let mut planner = ground.planner(&variant.config)?;
        let colony = variant.config.colony();
        let n_tenth = colony.map_or(0, |of| of.colony.n_iterations.div_ceil(10));
        let measured = measure(&mut (), |observer| {
            planner.plan(&ground.request, Seed(seed), observer)
        });
        let outcome = measured.answer?;
        let stages = outcome.stages();
        // Where obstacle expansion covers an end no colony sets out.
        let nothing = History::default();
        let history = stages.colony.as_ref().map_or(&nothing, |run| &run.history);
        let path = stages.grid_path.as_ref();
        let plan = match &outcome {
            Outcome::Found(plan) => Some(plan),
            Outcome::NotFound(_) => None,
        };
        let obstacles = ground.grid.lethal_cells();
        let moments = Moment::all(&measured.iterations);
        let trial = Self {
            map: ground.map.clone(),
            variant: variant.name.clone(),
            seed,
            arrived: path.is_some(),
            certified: plan.is_some(),
            length_cells: path.map(length_cells),
            optimum_cells: path.and_then(|path| optimum_cells(variant, stages, path)),
            n_turns: path.map(n_turns),
            n_nodes_before: path.map(|path| path.cells.len()),
            n_nodes_after: path.map(|_| stages.nodes.len()),
            n_squeezes: path.map(|path| n_squeezes(&obstacles, path)),
            n_to_best: history.converged_after(),
            n_to_1_percent: n_to_1_percent(history),
            n_iterations: history.iterations.len(),
            arrived_share: arrived_share(history),
            length_m: plan.map(|plan| plan.metrics.length_m),
            min_clearance_m: plan.map(|plan| plan.certificate.min_clearance_m),
            early_length_cells: early_length(&moments, n_tenth),
            late_spread_cells: late_spread(&moments),
            query_ms: 1e3 * measured.query_s,
            search_ms: moments.last().map_or(0.0, |last| last.ms),
        };
        Ok(Run { trial, moments })
    }
}

/// The best length after so many iterations, or at the end of a shorter run.
fn early_length(moments: &[Moment], n_iterations: u32) -> Option<f64> {
    let n_noted = moments.partition_point(|moment| moment.iteration <= n_iterations);
    moments.get(n_noted.checked_sub(1)?)?.best_so_far_length
}

fn late_spread(moments: &[Moment]) -> Option<f64> {
    let late = moments[moments.len() / 2..].iter();
    let lengths: Vec<f64> = late.filter_map(|moment| moment.best_length).collect();
    let n = lengths.len() as f64;
    let mean = lengths.iter().sum::<f64>() / n;
    let squares: f64 = lengths.iter().map(|length| (length - mean).powi(2)).sum();
    (lengths.len() > 1).then(|| (squares / (n - 1.0)).sqrt())
}

fn steps(path: &GridPath) -> impl Iterator<Item = (i64, i64)> + '_ {
    path.cells.windows(2).map(|pair| {
        let difference = |a: u32, b: u32| i64::from(b) - i64::from(a);
        (
            difference(pair[0].col, pair[1].col),
            difference(pair[0].row, pair[1].row),
        )
    })
}

fn length_cells(path: &GridPath) -> f64 {
    steps(path)
        .map(|(dx, dy)| if dx != 0 && dy != 0 { SQRT_2 } else { 1.0 })
        .sum()
}

fn n_turns(path: &GridPath) -> usize {
    let following = steps(path).skip(1);
    steps(path).zip(following).filter(|(a, b)| a != b).count()
}

/// Diagonal steps between two obstacles.
fn n_squeezes(obstacles: &BitGrid, path: &GridPath) -> usize {
    let is_obstacle = |col: u32, row: u32| obstacles.get(col as usize, row as usize);
    let squeezes = |pair: &&[Cell]| {
        let (a, b) = (pair[0], pair[1]);
        let is_diagonal = a.col != b.col && a.row != b.row;
        is_diagonal && is_obstacle(a.col, b.row) && is_obstacle(b.col, a.row)
    };
    path.cells.windows(2).filter(squeezes).count()
}

/// The rule by which the ants of a colony over cells pass corners.
pub(crate) fn diagonal_rule(config: &PlannerConfig) -> DiagonalRule {
    let colony = config.colony();
    colony.map_or_else(DiagonalRule::default, |of| of.colony.diagonal_rule)
}

/// The shortest way between the ends of a path under the layers and the moves of its colony.
fn optimum_cells(variant: &Variant, stages: &Stages, path: &GridPath) -> Option<f64> {
    let (start, goal) = (path.cells.first()?, path.cells.last()?);
    let blocked = &stages.layers.as_ref()?.blocked;
    let moves = MoveMasks::new(blocked, diagonal_rule(&variant.config));
    let mut nobody = ();
    let field = GoalField::new(&moves, &[*goal], &mut Limits::new(&mut nobody, None, None));
    field.ok()?.distance_cells(*start)
}

fn n_to_1_percent(history: &History) -> Option<u32> {
    let best = history.iterations.last()?.best_so_far_cost?;
    let is_near = |cost: Option<f64>| cost.is_some_and(|cost| cost <= 1.01 * best);
    let first = history
        .iterations
        .iter()
        .find(|record| is_near(record.best_so_far_cost))?;
    Some(first.iteration + 1)
}

fn arrived_share(history: &History) -> f64 {
    let sum = |of: fn(&IterationRecord) -> u32| {
        let values = history.iterations.iter().map(of).map(f64::from);
        values.sum::<f64>()
    };
    sum(|record| record.n_arrived) / sum(|record| record.n_ants).max(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_are_measured() {
        let moment = |iteration: u32, best: f64, length: f64| Moment {
            iteration,
            n_ants: 0,
            ms: 0.0,
            best_so_far_length: Some(best),
            best_length: Some(length),
            mean_length: None,
            rho: 0.5,
        };
        let moments = [
            moment(1, 9.0, 9.0),
            moment(2, 7.0, 7.0),
            moment(3, 6.0, 6.0),
            moment(4, 6.0, 8.0),
        ];
        assert_eq!(early_length(&moments, 2), Some(7.0));
        assert_eq!(early_length(&moments, 9), Some(6.0));
        assert_eq!(early_length(&[], 2), None);
        // Of 6 and 8.
        assert_eq!(late_spread(&moments), Some(2.0_f64.sqrt()));
        assert_eq!(late_spread(&moments[..1]), None);
    }

    #[test]
    fn paths_are_measured() {
        let cells = [(0, 0), (1, 1), (2, 2), (3, 2)];
        let path = GridPath {
            cells: cells.map(|(col, row)| Cell::new(col, row)).to_vec(),
        };
        assert!((length_cells(&path) - 1.0 - 2.0 * SQRT_2).abs() < 1e-12);
        assert_eq!(n_turns(&path), 1);
        let mut obstacles = BitGrid::new(4, 4);
        obstacles.insert(Cell::new(1, 0));
        assert_eq!(n_squeezes(&obstacles, &path), 0);
        obstacles.insert(Cell::new(0, 1));
        assert_eq!(n_squeezes(&obstacles, &path), 1);
    }
}
