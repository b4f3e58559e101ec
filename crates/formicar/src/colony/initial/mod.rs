//! Pheromone before the first iteration.

mod astar_seed;
mod line_gradient;
mod uniform;
mod unit;

pub use astar_seed::AstarSeed;
pub use line_gradient::LineGradient;
pub use uniform::Uniform;
pub use unit::PheromoneUnit;

use super::ColonyProblem;
use crate::map::Cell;
use crate::parameters::rules;
use crate::progress::{Limits, Status};
use crate::search::{AstarWorkspace, SearchError, astar};

rules! {
    /// Pheromone before the first iteration.
    pub enum InitialPheromone {
        /// The same everywhere.
        Uniform(Uniform),
        /// Most on the line from start to goal.
        LineGradient(LineGradient),
        /// Most on a shortest path.
        AstarSeed(AstarSeed),
    }
}

impl InitialPheromone {
    pub(super) fn unit(&self) -> PheromoneUnit {
        match self {
            Self::Uniform(rule) => rule.unit,
            Self::LineGradient(rule) => rule.unit,
            Self::AstarSeed(rule) => rule.unit,
        }
    }

    /// Pheromone on the cells that ants can reach, in the rule's unit.
    pub(super) fn lay(
        &self,
        problem: &ColonyProblem,
        cells: &[u32],
        limits: &mut Limits,
    ) -> Result<InitialTrails, SearchError> {
        let (values, least) = match self {
            Self::Uniform(rule) => (vec![rule.tau; cells.len()], rule.tau),
            Self::LineGradient(rule) => {
                let (moves, ends) = (problem.moves(), [problem.start(), problem.goal()]);
                rule.values(moves.n_cols(), moves.n_rows(), ends, cells)
            }
            Self::AstarSeed(rule) => {
                let path = shortest_path(problem, cells, limits)?;
                (rule.values(cells.len(), path), rule.least())
            }
        };
        Ok(InitialTrails { values, least })
    }
}

/// Pheromone before the first iteration.
pub(super) struct InitialTrails {
    /// By number of the cell.
    pub(super) values: Vec<f64>,
    /// The least anywhere on the map.
    pub(super) least: f64,
}

impl InitialTrails {
    /// The same in a larger or smaller unit.
    pub(super) fn scale(&mut self, unit: f64) {
        self.values.iter_mut().for_each(|tau| *tau *= unit);
        self.least *= unit;
    }
}

/// The numbers of the cells on a shortest path; empty if there is no path.
fn shortest_path(
    problem: &ColonyProblem,
    cells: &[u32],
    limits: &mut Limits,
) -> Result<Vec<usize>, SearchError> {
    let (moves, ends) = (problem.moves(), [problem.start(), problem.goal()]);
    let mut limits = limits.without_budget();
    let found = astar(
        moves,
        ends[0],
        ends[1],
        &mut AstarWorkspace::new(),
        &mut limits,
    );
    let path = match found {
        Ok(found) => found.path.cells,
        Err(error) if error.status() == Some(Status::NoPath) => Vec::new(),
        Err(error) => return Err(error),
    };
    let number = |&cell: &Cell| cells.binary_search(&(moves.index(cell) as u32)).ok();
    Ok(path.iter().filter_map(number).collect())
}
