//! The score of an individual: its cost and its obstructed length.

use super::config::EvolutionConfig;
use super::obstruction::blocked_length;
use super::problem::EvolutionProblem;
use crate::geometry::Point2;
use crate::map::{Cell, cells_in_sight};
use crate::objective::SteeredLine;
use crate::parameters::OutOfRange;

/// The score of a polyline; the least fitness is the best.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Score {
    /// J of Li 2024 (15).
    pub(super) cost: f64,
    /// Length, cells.
    pub(super) length_cells: f64,
    /// Length inside blocked cells, and a cell for each segment that is not free; 0 where all are.
    pub(super) obstructed_cells: f64,
    /// The cost and the penalty.
    pub(super) fitness: f64,
}

impl Score {
    pub(super) fn is_free(&self) -> bool {
        self.obstructed_cells == 0.0
    }
}

/// Evaluates polylines, one after the other.
pub(super) struct Evaluation<'a> {
    problem: &'a EvolutionProblem<'a>,
    config: &'a EvolutionConfig,
    points: Vec<Point2>,
}

impl<'a> Evaluation<'a> {
    pub(super) fn new(problem: &'a EvolutionProblem<'a>, config: &'a EvolutionConfig) -> Self {
        Self {
            problem,
            config,
            points: Vec::new(),
        }
    }

    /// The score of a polyline.
    pub(super) fn score(&mut self, line: &[Cell]) -> Result<Score, OutOfRange> {
        let (problem, config) = (self.problem, self.config);
        let center = |cell: &Cell| {
            Point2::new(f64::from(cell.col) + 0.5, f64::from(cell.row) + 0.5) * problem.resolution_m
        };
        self.points.clear();
        self.points.extend(line.iter().map(center));
        let reference_m = problem.reference_m();
        let cost = config.cost.of(&SteeredLine {
            points: &self.points,
            start_heading_rad: problem.start_heading_rad,
            steering: problem.steering,
            suspension: &config.suspension,
            reference_m,
        })?;
        let legs = line.windows(2);
        let obstructed_cells = legs.map(|leg| obstruction(problem, leg[0], leg[1])).sum();
        let share = obstructed_cells * problem.resolution_m / reference_m;
        Ok(Score {
            cost: cost.cost,
            length_cells: cost.length_m / problem.resolution_m,
            obstructed_cells,
            fitness: cost.cost + config.collision_weight * share,
        })
    }
}

/// Length of a segment inside blocked cells, plus one cell; 0 for a free segment. The extra cell
/// makes a segment count as obstructed that only touches a forbidden corner.
pub(super) fn obstruction(problem: &EvolutionProblem, from: Cell, to: Cell) -> f64 {
    let blocked = problem.blocked();
    if cells_in_sight(blocked, problem.rule(), from, to) {
        return 0.0;
    }
    1.0 + blocked_length(blocked, from, to)
}
