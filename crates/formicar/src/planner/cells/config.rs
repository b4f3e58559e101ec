//! Parameters of the planners over cells.

use crate::map::DiagonalRule;
use crate::objective::DriveCost;
use crate::parameters::parameters;
use crate::planner::family::sections;
use crate::search::ImprovedAstarConfig;
use crate::smoothing::{RedundantNodes, SmoothingConfig};

parameters! {
    /// Parameters of searches over cells.
    #[derive(Default)]
    pub struct GridSearchConfig {
        /// Diagonal steps that are allowed beside obstacles.
        pub diagonal_rule: DiagonalRule,
    }
}

sections! {
    /// Parameters of `astar`.
    AstarParameters {
        /// Steps of the planners over cells: `astar`, `dijkstra`, `improved-astar`, and `ga`
        /// and `aga`, which measure themselves by the shortest path over cells.
        grid_search: GridSearchConfig,
        /// Smoothing: from a path over cells to one that a car can drive.
        smoothing: SmoothingConfig,
        /// Weights of transitions, where a request asks for continuous curvature.
        #[cfg_attr(feature = "serde", serde(skip_serializing_if = "DriveCost::is_default"))]
        cost: DriveCost,
    }
}

sections! {
    /// Parameters of `dijkstra`.
    DijkstraParameters {
        /// Steps of the planners over cells: `astar`, `dijkstra`, `improved-astar`, and `ga`
        /// and `aga`, which measure themselves by the shortest path over cells.
        grid_search: GridSearchConfig,
        /// Smoothing: from a path over cells to one that a car can drive.
        smoothing: SmoothingConfig,
        /// Weights of transitions, where a request asks for continuous curvature.
        #[cfg_attr(feature = "serde", serde(skip_serializing_if = "DriveCost::is_default"))]
        cost: DriveCost,
    }
}

sections! {
    /// Parameters of `improved-astar`.
    #[derive(Default)]
    ImprovedAstarParameters {
        /// Steps of the planners over cells: `astar`, `dijkstra`, `improved-astar`, and `ga`
        /// and `aga`, which measure themselves by the shortest path over cells.
        grid_search: GridSearchConfig,
        /// Parameters of `improved-astar`.
        improved_astar: ImprovedAstarConfig,
        /// Smoothing: from a path over cells to one that a car can drive.
        smoothing: SmoothingConfig,
        /// Weights of transitions, where a request asks for continuous curvature.
        #[cfg_attr(feature = "serde", serde(skip_serializing_if = "DriveCost::is_default"))]
        cost: DriveCost,
    }
}

impl Default for AstarParameters {
    fn default() -> Self {
        Self {
            grid_search: GridSearchConfig::default(),
            smoothing: taut(),
            cost: DriveCost::default(),
        }
    }
}

impl Default for DijkstraParameters {
    fn default() -> Self {
        Self {
            grid_search: GridSearchConfig::default(),
            smoothing: taut(),
            cost: DriveCost::default(),
        }
    }
}

/// For shortest paths: only nodes on a straight line go.
pub(in crate::planner) fn taut() -> SmoothingConfig {
    SmoothingConfig {
        redundant_nodes: RedundantNodes::Collinear,
        ..SmoothingConfig::default()
    }
}
