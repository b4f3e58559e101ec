//! A* whose estimate weighs more far from the goal (after Niu 2021, as Li et al. 2024 describe it).

use super::astar::{AstarWorkspace, Guide, Queues, search};
use super::cost::{DIAGONAL_COST, STRAIGHT_COST};
use super::grid_search::{GridSearch, SearchError};
use super::open_queue::KeyHeap;
use crate::map::{Cell, MoveMasks};
use crate::parameters::parameters;
use crate::progress::Limits;

parameters! {
    /// Parameters of `improved-astar`.
    pub struct ImprovedAstarConfig {
        /// w in f = g + (1 + w r / R) h: 0 is A*, 1 the paper. Paths are at most 1 + w times as
        /// long as the shortest.
        #[range(0.0..=10.0)]
        pub distance_weight: f64 = 1.0,
    }
}

/// A path between two cells along allowed moves by f = g + (1 + w r / R) h, with r the straight
/// distance of a cell to the goal, at most R, that of the start, and h the octile distance.
///
/// Far from the goal the search hurries towards it, near the goal it looks around. The estimate is
/// not consistent, so cells whose cost falls are looked at again. Until the goal comes up, some
/// cell of a shortest path waits with f = g + (1 + w r / R) h, which is at most 1 + w times the
/// least cost: no path is longer. (Without the limit of r at R that would not hold where the way
/// leads away from the goal first.) With w = 0 it is [`astar`](super::astar), cell by cell. A step
/// of the limits is a cell expanded.
///
/// # Errors
/// As [`astar`](super::astar), and a parameter out of range.
pub fn improved_astar(
    moves: &MoveMasks,
    ends: [Cell; 2],
    config: &ImprovedAstarConfig,
    workspace: &mut AstarWorkspace,
    limits: &mut Limits,
) -> Result<GridSearch, SearchError> {
    config.check()?;
    let [start, goal] = ends;
    let guide = DistanceWeighted {
        goal,
        start_distance: distance(start, goal),
        weight: config.distance_weight,
    };
    search(moves, ends, &guide, workspace, limits)
}

/// The octile distance to the goal, times 1 + w r / R.
struct DistanceWeighted {
    goal: Cell,
    /// R, cells.
    start_distance: f64,
    /// w.
    weight: f64,
}

impl DistanceWeighted {
    fn estimate(&self, cell: Cell) -> u64 {
        let share = if self.start_distance > 0.0 {
            (distance(cell, self.goal) / self.start_distance).min(1.0)
        } else {
            0.0
        };
        (octile(cell, self.goal) as f64 * (1.0 + self.weight * share)) as u64
    }
}

impl Guide for DistanceWeighted {
    type Queue = KeyHeap;

    fn key(&self, cost: u32, cell: Cell) -> u64 {
        u64::from(cost) + self.estimate(cell)
    }

    fn cost(&self, key: u64, cell: Cell) -> u32 {
        (key - self.estimate(cell)) as u32
    }

    fn queue(queues: &mut Queues) -> &mut KeyHeap {
        &mut queues.heap
    }
}

/// Distance between the centers of two cells, cells.
fn distance(a: Cell, b: Cell) -> f64 {
    let (dx, dy) = (a.col.abs_diff(b.col), a.row.abs_diff(b.row));
    (f64::from(dx) * f64::from(dx) + f64::from(dy) * f64::from(dy)).sqrt()
}

/// Cost between two cells on free ground, however far they are apart.
fn octile(a: Cell, b: Cell) -> u64 {
    let (dx, dy) = (a.col.abs_diff(b.col), a.row.abs_diff(b.row));
    let (long, short) = (u64::from(dx.max(dy)), u64::from(dx.min(dy)));
    long * u64::from(STRAIGHT_COST) + short * u64::from(DIAGONAL_COST - STRAIGHT_COST)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::{BitGrid, DiagonalRule};

    #[test]
    fn the_estimate_weighs_most_at_the_start_and_nothing_more_at_the_goal() {
        let guide = DistanceWeighted {
            goal: Cell::new(10, 0),
            start_distance: 10.0,
            weight: 1.0,
        };
        let straight = u64::from(STRAIGHT_COST);
        let estimate = |col: u32| guide.estimate(Cell::new(col, 0));
        assert_eq!(estimate(10), 0);
        assert_eq!(estimate(0), 2 * 10 * straight);
        assert_eq!(estimate(5), 15 * 5 * straight / 10);
        // Behind the start r counts as R.
        assert_eq!(estimate(25), 2 * 15 * straight);
    }

    #[test]
    fn it_may_take_a_longer_way_that_looks_good_from_afar() {
        // A wall across the straight way.
        let mut walls = BitGrid::new(40, 30);
        walls.extend((4..=25).map(|row| Cell::new(30, row)));
        let moves = MoveMasks::new(&walls, DiagonalRule::NoObstacles);
        let ends = [Cell::new(2, 14), Cell::new(38, 16)];
        let length = |distance_weight: f64| {
            let mut nobody = ();
            let mut limits = Limits::new(&mut nobody, None, None);
            let config = ImprovedAstarConfig { distance_weight };
            let mut workspace = AstarWorkspace::new();
            let found = improved_astar(&moves, ends, &config, &mut workspace, &mut limits);
            found.unwrap().length_cells()
        };
        let (shortest, improved) = (length(0.0), length(1.0));
        assert!(
            shortest < improved && improved <= 2.0 * shortest,
            "{improved} {shortest}"
        );
    }

    #[test]
    fn a_weight_out_of_range_is_refused() {
        let config = ImprovedAstarConfig {
            distance_weight: f64::NAN,
        };
        assert!(config.check().unwrap_err().to_string().contains("0 to 10"));
    }
}
