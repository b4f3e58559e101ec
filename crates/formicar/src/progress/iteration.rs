//! The record of a colony's iteration.

use super::pheromone::pheromone_by_cell;
use crate::map::Cell;
use crate::path::GridPath;

/// The numbers of one iteration of a colony, or of one generation of a population.
///
/// Costs are those of the colony's objective; lengths are in cells, as the objective counts them.
/// In a population, ants are individuals, and those that arrived are the ones free of
/// collisions; costs are theirs without a penalty, and there is neither evaporation nor pheromone.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct IterationRecord {
    /// Its number, from 0.
    pub iteration: u32,
    /// Ants that set out.
    pub n_ants: u32,
    /// Ants that reached the goal.
    pub n_arrived: u32,
    /// Least cost in this iteration; none if no ant arrived.
    pub best_cost: Option<f64>,
    /// Mean cost of the ants that arrived.
    pub mean_cost: Option<f64>,
    /// Length of the way of least cost in this iteration.
    pub best_length: Option<f64>,
    /// Mean length of the ants that arrived.
    pub mean_length: Option<f64>,
    /// Least cost so far.
    pub best_so_far_cost: Option<f64>,
    /// Length of the way of least cost so far.
    pub best_so_far_length: Option<f64>,
    /// The evaporation that was applied, in 0 to 1.
    pub rho: f64,
    /// Least pheromone after the update.
    pub min_pheromone: f64,
    /// Most pheromone after the update.
    pub max_pheromone: f64,
}

/// The ways of the ants of an iteration, in the ants' order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AntWays<'a> {
    /// The start of all ants.
    pub start: Cell,
    /// Their goal.
    pub goal: Cell,
    /// The steps that an ant can take, columns and rows: [`STEPS`](crate::map::STEPS), or chords.
    pub moves: &'a [(i32, i32)],
    /// Steps of all ants, one ant after the other, as places in `moves`; any other leads to the
    /// goal.
    pub steps: &'a [u8],
    /// The end of each ant's steps in `steps`.
    pub ends: &'a [usize],
    /// One flag per ant, true if it reached the goal.
    pub arrived: &'a [bool],
    /// The ant whose way costs least; none if none arrived.
    pub best: Option<usize>,
}

impl AntWays<'_> {
    /// Number of ants.
    pub fn n_ants(&self) -> usize {
        self.ends.len()
    }

    /// The way of an ant, whether it arrived or not.
    pub fn way(&self, ant: usize) -> GridPath {
        path_of(self.moves, [self.start, self.goal], self.steps(ant))
    }

    /// The steps of an ant.
    pub fn steps(&self, ant: usize) -> &[u8] {
        let first = ant.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.steps[first..self.ends[ant]]
    }
}

/// The cells that steps lead through, as places in `moves`; any other leads to the goal.
pub fn path_of(moves: &[(i32, i32)], [start, goal]: [Cell; 2], steps: &[u8]) -> GridPath {
    let mut cell = start;
    let after = steps.iter().map(|&step| {
        cell = moves.get(usize::from(step)).map_or(goal, |&(dx, dy)| {
            Cell::new(
                cell.col.wrapping_add_signed(dx),
                cell.row.wrapping_add_signed(dy),
            )
        });
        cell
    });
    GridPath {
        cells: std::iter::once(start).chain(after).collect(),
    }
}

/// Pheromone at the end of an iteration.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Pheromone<'a> {
    /// By cell, row by row; not a number where no ant can go.
    Cells(&'a [f32]),
    /// By cell and step, eight to a cell; not a number where no ant can go.
    Steps(&'a [f32]),
    /// By index for some cells, row by row; no ant can go to others.
    Listed(&'a [u32], &'a [f32]),
}

impl Pheromone<'_> {
    /// Pheromone of all cells of a grid, row by row, that of a cell being the most on a step to
    /// it; not a number where no ant can go.
    pub fn by_cell(&self, n_cols: usize, n_rows: usize) -> Vec<f32> {
        match self {
            Self::Cells(values) => values.to_vec(),
            Self::Steps(values) => pheromone_by_cell(values, n_cols),
            Self::Listed(cells, values) => {
                let mut all = vec![f32::NAN; n_cols * n_rows];
                for (&cell, &value) in cells.iter().zip(*values) {
                    all[cell as usize] = value;
                }
                all
            }
        }
    }
}

/// A colony at the end of an iteration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColonyView<'a> {
    /// Its numbers.
    pub record: &'a IterationRecord,
    /// The paths of its ants.
    pub ways: AntWays<'a>,
    /// The pheromone on the map.
    pub pheromone: Pheromone<'a>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::STEPS;

    #[test]
    fn ways_of_ants_lie_one_behind_the_other() {
        let ways = AntWays {
            start: Cell::new(1, 1),
            goal: Cell::new(9, 9),
            moves: &STEPS,
            steps: &[0, 1, 4, u8::MAX],
            ends: &[2, 2, 4],
            arrived: &[true, false, true],
            best: None,
        };
        assert_eq!(ways.n_ants(), 3);
        let first = [Cell::new(1, 1), Cell::new(2, 1), Cell::new(3, 2)];
        assert_eq!(ways.way(0).cells, first);
        assert_eq!(ways.way(1).cells, [Cell::new(1, 1)]);
        let to_goal = [Cell::new(1, 1), Cell::new(0, 1), Cell::new(9, 9)];
        assert_eq!(ways.way(2).cells, to_goal);
    }
}
