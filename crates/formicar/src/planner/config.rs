//! Every parameter of every planner, with its range: one definition for files, flags and docs.

use super::sections;
use crate::colony::{ColonyConfig, ColonyError, presets};
use crate::layers::{Expansion, LayersConfig, UShapes};
use crate::map::DiagonalRule;
use crate::numeric::OutOfRange;
use crate::search::HybridAstarConfig;
use crate::smoothing::{Corners, SmoothingConfig};
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use thiserror::Error;

/// Which planner, and the parameters of each.
///
/// Made by [`PlannerConfig::of`], so that a colony has the parameters of its name. Read from a
/// document, what is left out is that of the planner named there; written, only what the planner
/// uses.
#[derive(Clone, Debug, PartialEq, JsonSchema)]
#[schemars(default, deny_unknown_fields)]
pub struct PlannerConfig {
    /// The planner to use.
    pub planner: PlannerName,
    /// Parameters of `hybrid-astar`.
    pub hybrid_astar: HybridAstarConfig,
    /// Parameters of the planners on the grid, `astar` and `dijkstra`.
    pub grid_search: GridSearchConfig,
    /// What is laid over the map before ants walk on it.
    pub layers: LayersConfig,
    /// The colony.
    pub colony: ColonyConfig,
    /// How the ants' path becomes one that a car can drive.
    pub smoothing: SmoothingConfig,
}

impl Default for PlannerConfig {
    fn default() -> Self {
        Self::of(PlannerName::default())
    }
}

impl Serialize for PlannerConfig {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        sections::write(self, serializer)
    }
}

impl<'de> Deserialize<'de> for PlannerConfig {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        sections::read(deserializer)
    }
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
    /// The Ant System (Dorigo, Maniezzo & Colorni 1996).
    AntSystem,
    /// The elitist Ant System.
    Elitist,
    /// The MAX-MIN Ant System (Stützle & Hoos 2000).
    MaxMin,
    /// The colony of Lei & Zheng 2020.
    Lei2020,
    /// The colony of Wang et al. 2019.
    Wang2019,
    /// The colony of Zhang 2016, as Wang et al. describe it.
    Zhang2016,
    /// The colony of Joshy & Supriya 2016, as Wang et al. describe it.
    Joshy2016,
    /// The Ant System that Li et al. 2024 compare with.
    Aco,
    /// The same with A*-seeded pheromone and a B-spline.
    Acof,
}

impl PlannerName {
    /// All planners, the default first.
    pub const ALL: [Self; 12] = [
        Self::HybridAstar,
        Self::Astar,
        Self::Dijkstra,
        Self::AntSystem,
        Self::Elitist,
        Self::MaxMin,
        Self::Lei2020,
        Self::Wang2019,
        Self::Zhang2016,
        Self::Joshy2016,
        Self::Aco,
        Self::Acof,
    ];

    /// The word used in files and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::HybridAstar => "hybrid-astar",
            Self::Astar => "astar",
            Self::Dijkstra => "dijkstra",
            Self::AntSystem => "ant-system",
            Self::Elitist => "elitist",
            Self::MaxMin => "max-min",
            Self::Lei2020 => "lei2020",
            Self::Wang2019 => "wang2019",
            Self::Zhang2016 => "zhang2016",
            Self::Joshy2016 => "joshy2016",
            Self::Aco => "aco",
            Self::Acof => "acof",
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
            Self::AntSystem => "Ant System: uniform pheromone, all ants deposit; corners rounded",
            Self::Elitist => "elitist Ant System: the best way so far gains most; corners rounded",
            Self::MaxMin => "MAX-MIN Ant System: only the best ant deposits; corners rounded",
            Self::Lei2020 => {
                "Lei & Zheng 2020: U-shapes closed, steps towards the goal first, 2-turning"
            }
            Self::Wang2019 => {
                "Wang et al. 2019: no squeezing between obstacles, guided by the way to the goal"
            }
            Self::Zhang2016 => "Zhang 2016 as Wang et al. describe it: adaptive MAX-MIN Ant System",
            Self::Joshy2016 => "Joshy & Supriya 2016 as Wang et al. describe it: six directions",
            Self::Aco => "Ant System as Li et al. 2024 compare with it: few ants in a corridor",
            Self::Acof => "the same with A*-seeded pheromone and a B-spline that nobody checks",
        }
    }

    /// The colony of this name; none if it is no colony.
    pub fn colony(self) -> Option<ColonyConfig> {
        match self {
            Self::HybridAstar | Self::Astar | Self::Dijkstra => None,
            Self::AntSystem => Some(presets::ant_system()),
            Self::Elitist => Some(presets::elitist()),
            Self::MaxMin => Some(presets::max_min()),
            Self::Lei2020 => Some(presets::lei2020()),
            Self::Wang2019 => Some(presets::wang2019()),
            Self::Zhang2016 => Some(presets::zhang2016()),
            Self::Joshy2016 => Some(presets::joshy2016()),
            Self::Aco => Some(presets::aco()),
            Self::Acof => Some(presets::acof()),
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
    #[error(transparent)]
    OutOfRange(#[from] OutOfRange),
    /// A colony that cannot be.
    #[error(transparent)]
    Colony(#[from] ColonyError),
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
        let u_shapes = match planner {
            PlannerName::Lei2020 => UShapes::Close,
            _ => UShapes::Keep,
        };
        Self {
            planner,
            hybrid_astar: HybridAstarConfig::default(),
            grid_search: GridSearchConfig::default(),
            layers: LayersConfig {
                expansion: Expansion::HalfWidth,
                u_shapes,
            },
            colony: planner.colony().unwrap_or_default(),
            smoothing: match planner {
                PlannerName::Acof => SmoothingConfig {
                    corners: Corners::BSpline,
                    ..SmoothingConfig::default()
                },
                _ => SmoothingConfig::default(),
            },
        }
    }

    /// Whether every parameter is in its range.
    ///
    /// # Errors
    /// The first parameter that is not, with value and range.
    pub fn check(&self) -> Result<(), ConfigError> {
        self.hybrid_astar.check()?;
        self.layers.check()?;
        self.colony.check()?;
        self.smoothing.check()?;
        Ok(())
    }
}
