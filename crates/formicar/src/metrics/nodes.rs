//! Nodes and turns of paths that are not yet driven: chains of cells and of way points.

use crate::geometry::Point2;
use crate::map::Cell;
use crate::path::{GridPath, WaypointPath};

/// The nodes of a path, and those at which it changes direction.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct NodeMetrics {
    /// Nodes, both ends included.
    pub n_nodes: usize,
    /// Nodes where the direction changes.
    pub n_turns: usize,
}

impl NodeMetrics {
    /// Directions closer than this are one, radians.
    const STRAIGHT_RAD: f64 = 1e-9;

    /// The nodes of a chain of cells.
    pub fn of_grid(path: &GridPath) -> Self {
        let center = |cell: &Cell| Point2::new(cell.col.into(), cell.row.into());
        Self::of_points(&path.cells.iter().map(center).collect::<Vec<_>>())
    }

    /// The nodes of a polyline.
    pub fn of_waypoints(path: &WaypointPath) -> Self {
        Self::of_points(&path.points)
    }

    fn of_points(points: &[Point2]) -> Self {
        let steps: Vec<Point2> = points
            .windows(2)
            .map(|w| w[1] - w[0])
            .filter(|step| step.norm() > 0.0)
            .collect();
        let is_turn =
            |w: &&[Point2]| w[0].cross(w[1]).atan2(w[0].dot(w[1])).abs() > Self::STRAIGHT_RAD;
        Self {
            n_nodes: points.len(),
            n_turns: steps.windows(2).filter(is_turn).count(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_staircase_turns_at_every_node() {
        let cells = [(0, 0), (1, 0), (1, 1), (2, 1), (3, 1), (4, 2)];
        let cells = cells.map(|(col, row)| Cell::new(col, row)).to_vec();
        let metrics = NodeMetrics::of_grid(&GridPath { cells });
        assert_eq!((metrics.n_nodes, metrics.n_turns), (6, 3));
    }

    #[test]
    fn repeated_points_do_not_turn_and_going_back_does() {
        let points = [(0., 0.), (0.1, 0.3), (0.1, 0.3), (0.2, 0.6), (0., 0.)];
        let points = points.map(|(x, y)| Point2::new(x, y)).to_vec();
        let metrics = NodeMetrics::of_waypoints(&WaypointPath { points });
        assert_eq!((metrics.n_nodes, metrics.n_turns), (5, 1));
        let none = NodeMetrics::of_waypoints(&WaypointPath::default());
        assert_eq!(none, NodeMetrics::default());
    }
}
