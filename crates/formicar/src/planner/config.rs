//! Every parameter of every planner, with its range: one definition for files, flags and docs.

use super::replan::ReplanConfig;
use super::sections;
use crate::colony::chord::ChordConfig;
use crate::colony::drive::DriveConfig;
use crate::colony::{ColonyConfig, presets};
use crate::evolution::EvolutionConfig;
use crate::layers::{Expansion, LayersConfig, UShapes};
use crate::map::DiagonalRule;
use crate::objective::DriveCost;
use crate::parameters::{self, OutOfRange, Parameter, Parameters};
use crate::search::{HybridAstarConfig, ImprovedAstarConfig};
use crate::smoothing::{Corners, ImproveConfig, RedundantNodes, SmoothingConfig};
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
    /// Parameters of `hybrid-astar`, with the lattice and the costs of motions that `formicar`
    /// shares.
    pub hybrid_astar: HybridAstarConfig,
    /// The ants that drive, of `formicar`.
    pub drive: DriveConfig,
    /// What a driven path costs that `formicar` improves.
    pub cost: DriveCost,
    /// How `formicar` improves a driven path.
    pub improve: ImproveConfig,
    /// How `formicar` weighs a previous path when it replans.
    pub replan: ReplanConfig,
    /// Which steps the planners over cells take: `astar`, `dijkstra`, `improved-astar`, and `ga`
    /// and `aga`, which measure themselves by the shortest path over cells.
    pub grid_search: GridSearchConfig,
    /// What is laid over the map before ants walk on it.
    pub layers: LayersConfig,
    /// The colony.
    pub colony: ColonyConfig,
    /// The colony that steps by chords, `faco2024`.
    pub chords: ChordConfig,
    /// How a path over cells becomes one that a car can drive.
    pub smoothing: SmoothingConfig,
    /// Parameters of `improved-astar`.
    pub improved_astar: ImprovedAstarConfig,
    /// Parameters of `ga` and `aga`.
    pub evolution: EvolutionConfig,
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
    /// Ants that drive race hybrid A* to a first path.
    #[default]
    Formicar,
    /// Hybrid A* over motion primitives with analytic shots.
    HybridAstar,
    /// A* over cells, 8-connected.
    Astar,
    /// Descent of the goal field (Dijkstra from the goal), 8-connected.
    Dijkstra,
    /// A* over cells whose estimate weighs more far from the goal (after Niu 2021).
    ImprovedAstar,
    /// A genetic algorithm over via points, its first population at random.
    Ga,
    /// The same, a third of its first population about the path of A*.
    Aga,
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
    /// The fractional-order colony of Li et al. 2024.
    Faco2024,
    /// The Ant System that Li et al. 2024 compare with.
    Aco,
    /// The same with A*-seeded pheromone and a B-spline.
    Acof,
}

impl PlannerName {
    /// All planners, the default first.
    pub const ALL: [Self; 17] = [
        Self::Formicar,
        Self::HybridAstar,
        Self::Astar,
        Self::Dijkstra,
        Self::ImprovedAstar,
        Self::Ga,
        Self::Aga,
        Self::AntSystem,
        Self::Elitist,
        Self::MaxMin,
        Self::Lei2020,
        Self::Wang2019,
        Self::Zhang2016,
        Self::Joshy2016,
        Self::Faco2024,
        Self::Aco,
        Self::Acof,
    ];

    /// The word used in files and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Formicar => "formicar",
            Self::HybridAstar => "hybrid-astar",
            Self::Astar => "astar",
            Self::Dijkstra => "dijkstra",
            Self::ImprovedAstar => "improved-astar",
            Self::Ga => "ga",
            Self::Aga => "aga",
            Self::AntSystem => "ant-system",
            Self::Elitist => "elitist",
            Self::MaxMin => "max-min",
            Self::Lei2020 => "lei2020",
            Self::Wang2019 => "wang2019",
            Self::Zhang2016 => "zhang2016",
            Self::Joshy2016 => "joshy2016",
            Self::Faco2024 => "faco2024",
            Self::Aco => "aco",
            Self::Acof => "acof",
        }
    }

    /// What it does, in a line.
    pub fn about(self) -> &'static str {
        match self {
            Self::Formicar => {
                "ants that drive race hybrid A* to a first path, which is then improved"
            }
            Self::HybridAstar => {
                "hybrid A* over motion primitives, forward and in reverse, with analytic shots"
            }
            Self::Astar => "A* over cells, 8-connected: a shortest path; corners rounded",
            Self::Dijkstra => {
                "descent of the goal field over cells: a shortest path; corners rounded"
            }
            Self::ImprovedAstar => {
                "A* that trusts its estimate more far from the goal, at most twice the shortest path"
            }
            Self::Ga => "genetic algorithm over via points, begun at random; corners rounded",
            Self::Aga => "genetic algorithm over via points, begun about the path of A*",
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
            Self::Faco2024 => {
                "Li et al. 2024: ants that step by chords as a suspended car steers, fractional order"
            }
            Self::Aco => "Ant System as Li et al. 2024 compare with it: few ants in a corridor",
            Self::Acof => "the same with A*-seeded pheromone and a B-spline that nobody checks",
        }
    }

    /// Whether it sends ants.
    pub fn has_ants(self) -> bool {
        self == Self::Faco2024 || self.colony().is_some()
    }

    /// Whether it weighs soft costs; the others pass over them.
    pub fn heeds_soft_costs(self) -> bool {
        matches!(self, Self::Formicar | Self::HybridAstar)
    }

    /// The colony over cells of this name; none if it is no such colony.
    pub fn colony(self) -> Option<ColonyConfig> {
        match self {
            Self::Formicar
            | Self::HybridAstar
            | Self::Astar
            | Self::Dijkstra
            | Self::ImprovedAstar
            | Self::Ga
            | Self::Aga
            | Self::Faco2024 => None,
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

parameters::parameters! {
    /// Parameters of searches over cells.
    #[derive(Default)]
    pub struct GridSearchConfig {
        /// Which diagonal steps are allowed beside obstacles.
        pub diagonal_rule: DiagonalRule,
    }
}

/// What is wrong with a configuration.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum ConfigError {
    /// A parameter outside its range.
    #[error(transparent)]
    OutOfRange(#[from] OutOfRange),
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
            drive: DriveConfig::default(),
            cost: DriveCost::default(),
            improve: ImproveConfig::default(),
            replan: ReplanConfig::default(),
            grid_search: GridSearchConfig::default(),
            layers: LayersConfig {
                expansion: Expansion::HalfWidth,
                u_shapes,
            },
            colony: planner.colony().unwrap_or_default(),
            chords: ChordConfig::default(),
            smoothing: smoothing(planner),
            improved_astar: ImprovedAstarConfig::default(),
            evolution: match planner {
                PlannerName::Aga => EvolutionConfig::aga(),
                _ => EvolutionConfig::ga(),
            },
        }
    }

    /// Every parameter that a configuration may have, for every rule.
    pub fn parameters() -> Vec<Parameter> {
        parameters::list(&schemars::schema_for!(Self))
    }

    /// Checks every parameter.
    ///
    /// # Errors
    /// The first parameter that is not, with value and range.
    pub fn check(&self) -> Result<(), ConfigError> {
        let sections: [(&str, &dyn Parameters); 11] = [
            ("hybrid_astar", &self.hybrid_astar),
            ("drive", &self.drive),
            ("cost", &self.cost),
            ("improve", &self.improve),
            ("replan", &self.replan),
            ("layers", &self.layers),
            ("colony", &self.colony),
            ("chords", &self.chords),
            ("smoothing", &self.smoothing),
            ("improved_astar", &self.improved_astar),
            ("evolution", &self.evolution),
        ];
        for (name, section) in sections {
            section.check().map_err(|error| error.within(name))?;
        }
        Ok(())
    }
}

/// How the paths of a planner are made drivable.
fn smoothing(planner: PlannerName) -> SmoothingConfig {
    let default = SmoothingConfig::default();
    match planner {
        PlannerName::Astar | PlannerName::Dijkstra | PlannerName::Ga | PlannerName::Aga => {
            SmoothingConfig {
                redundant_nodes: RedundantNodes::Collinear,
                ..default
            }
        }
        PlannerName::Acof => SmoothingConfig {
            corners: Corners::BSpline,
            ..default
        },
        PlannerName::Faco2024 => SmoothingConfig {
            redundant_nodes: RedundantNodes::Keep,
            corners: Corners::WideArcs,
            direction_switching_cost: 10.0,
            ..default
        },
        _ => default,
    }
}
