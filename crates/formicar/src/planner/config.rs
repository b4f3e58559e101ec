//! Every parameter of every planner, with its range: one definition for files, flags and docs.

use crate::map::DiagonalRule;
use crate::search::HybridAstarConfig;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Which planner, and the parameters of each.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct PlannerConfig {
    /// The planner to use.
    pub planner: PlannerName,
    /// Parameters of `hybrid-astar`.
    pub hybrid_astar: HybridAstarConfig,
    /// Parameters of the planners on the grid, `astar` and `dijkstra`.
    pub grid_search: GridSearchConfig,
}

/// The planners.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum PlannerName {
    /// Hybrid A* over motion primitives with analytic shots.
    #[default]
    HybridAstar,
    /// A* over cells, 8-connected; its path is a polyline.
    Astar,
    /// Descent of the goal field (Dijkstra from the goal), 8-connected; its path is a polyline.
    Dijkstra,
}

impl PlannerName {
    /// All planners, the default first.
    pub const ALL: [Self; 3] = [Self::HybridAstar, Self::Astar, Self::Dijkstra];

    /// The word used in files and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::HybridAstar => "hybrid-astar",
            Self::Astar => "astar",
            Self::Dijkstra => "dijkstra",
        }
    }

    /// What it does, in a line.
    pub fn about(self) -> &'static str {
        match self {
            Self::HybridAstar => {
                "hybrid A* over motion primitives, forward and in reverse, with analytic shots"
            }
            Self::Astar => "A* over cells, 8-connected; a polyline, certified for point vehicles",
            Self::Dijkstra => {
                "descent of the goal field over cells; a polyline, certified for point vehicles"
            }
        }
    }
}

impl std::str::FromStr for PlannerName {
    type Err = ConfigError;
    fn from_str(name: &str) -> Result<Self, ConfigError> {
        let known = Self::ALL.into_iter().find(|planner| planner.name() == name);
        known.ok_or_else(|| ConfigError::UnknownPlanner {
            name: name.to_owned(),
            known: Self::ALL.map(Self::name).join(", "),
        })
    }
}

/// Parameters of searches over cells.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct GridSearchConfig {
    /// Which diagonal steps are allowed beside obstacles.
    pub diagonal_rule: DiagonalRule,
}

/// What is wrong with a configuration.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum ConfigError {
    /// A parameter outside its range.
    #[error("{key} = {value}; it must be {range}")]
    OutOfRange {
        /// The parameter.
        key: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed.
        range: String,
    },
    /// No such planner.
    #[error("no planner is named {name:?}; there are {known}")]
    UnknownPlanner {
        /// The name asked for.
        name: String,
        /// The names there are.
        known: String,
    },
}

impl PlannerConfig {
    /// The defaults of a planner.
    pub fn of(planner: PlannerName) -> Self {
        Self {
            planner,
            ..Self::default()
        }
    }

    /// Whether every parameter is in its range.
    ///
    /// # Errors
    /// The first parameter that is not, with value and range.
    pub fn check(&self) -> Result<(), ConfigError> {
        let h = &self.hybrid_astar;
        let checks = [
            ("hybrid_astar.weight", h.weight, 1.0, 10.0),
            (
                "hybrid_astar.angle_quantization_bins",
                f64::from(h.angle_quantization_bins),
                16.0,
                360.0,
            ),
            (
                "hybrid_astar.max_iterations",
                h.max_iterations as f64,
                1.0,
                1e9,
            ),
            ("hybrid_astar.step_radii", h.step_radii, 0.05, 1.0),
            (
                "hybrid_astar.reverse_penalty",
                h.reverse_penalty,
                1.0,
                100.0,
            ),
            (
                "hybrid_astar.direction_switching_cost",
                h.direction_switching_cost,
                0.0,
                1000.0,
            ),
            ("hybrid_astar.change_penalty", h.change_penalty, 0.0, 100.0),
            (
                "hybrid_astar.non_straight_penalty",
                h.non_straight_penalty,
                1.0,
                100.0,
            ),
            ("hybrid_astar.cost_penalty", h.cost_penalty, 0.0, 100.0),
            (
                "hybrid_astar.clearance_wish_m",
                h.clearance_wish_m,
                0.0,
                100.0,
            ),
        ];
        let bad = checks
            .into_iter()
            .find(|(_, value, low, high)| !(low..=high).contains(&value));
        bad.map_or(Ok(()), |(key, value, low, high)| {
            Err(ConfigError::OutOfRange {
                key,
                value,
                range: format!("in {low} to {high}"),
            })
        })
    }
}
