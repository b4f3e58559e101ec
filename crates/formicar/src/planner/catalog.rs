//! The built-in planners: one line each.

use super::family::{Family, Sections};
use super::{
    AstarParameters, ChordParameters, ColonyParameters, DijkstraParameters, EvolutionParameters,
    FormicarParameters, HybridAstarParameters, ImprovedAstarParameters,
};
use super::{ConfigError, PathSearch};
use crate::colony::{ColonyConfig, presets};
use crate::evolution::EvolutionConfig;
use std::any::Any;

/// Declares the planners: variant, parameters, word in files, preset, and what it does in a line.
macro_rules! planners {
    ($($(#[$about:meta])* $variant:ident($parameters:ty): $word:literal, $preset:expr, $line:literal;)+) => {
        /// The planners.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
        #[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
        pub enum PlannerName {
            $($(#[$about])* $variant,)+
        }

        /// A planner with its parameters.
        ///
        /// [`PlannerConfig::of`] gives the preset of a planner. Read from a document, what is
        /// left out is that of the planner named there; written, only what the planner uses.
        #[allow(
            clippy::large_enum_variant,
            reason = "one is made per planner, and its parameters are changed in place"
        )]
        #[derive(Clone, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize))]
        #[cfg_attr(feature = "serde", serde(tag = "planner", rename_all = "kebab-case"))]
        #[non_exhaustive]
        pub enum PlannerConfig {
            $($(#[$about])* $variant($parameters),)+
        }

        impl PlannerName {
            /// All planners, the default first.
            pub const ALL: [Self; [$(Self::$variant),+].len()] = [$(Self::$variant),+];

            /// The word used in files and on the command line.
            pub fn name(self) -> &'static str {
                match self { $(Self::$variant => $word),+ }
            }

            /// Its description, in a line.
            pub fn about(self) -> &'static str {
                match self { $(Self::$variant => $line),+ }
            }
        }

        impl PlannerConfig {
            /// The preset of a planner.
            pub fn of(planner: PlannerName) -> Self {
                match planner { $(PlannerName::$variant => Self::$variant($preset)),+ }
            }

            /// The planner of these parameters.
            pub fn planner(&self) -> PlannerName {
                match self { $(Self::$variant(_) => PlannerName::$variant),+ }
            }

            /// Checks the range of every parameter.
            ///
            /// # Errors
            /// The first parameter that is not, with value and range.
            pub fn check(&self) -> Result<(), ConfigError> {
                match self { $(Self::$variant(own) => own.check()),+ }
            }

            pub(super) fn search(&self) -> &dyn Family {
                match self { $(Self::$variant(own) => own),+ }
            }

            pub(super) fn parameters_any(&self) -> &dyn Any {
                match self { $(Self::$variant(own) => own),+ }
            }

            pub(super) fn parameters_any_mut(&mut self) -> &mut dyn Any {
                match self { $(Self::$variant(own) => own),+ }
            }

            /// Names of the sections of its document.
            #[cfg(feature = "serde")]
            pub(super) fn section_names(&self) -> &'static [&'static str] {
                match self { $(Self::$variant(_) => <$parameters as Sections>::NAMES),+ }
            }

            /// Takes those sections out of a document that the planner uses.
            #[cfg(feature = "serde")]
            pub(super) fn laid<E: serde::de::Error>(
                self,
                given: &mut serde_json::Map<String, serde_json::Value>,
            ) -> Result<Self, E> {
                Ok(match self { $(Self::$variant(own) => Self::$variant(own.laid(given)?)),+ })
            }

            /// The schema of each planner's sections.
            #[cfg(feature = "schema")]
            pub(super) fn section_schemas(
                generator: &mut schemars::SchemaGenerator,
            ) -> Vec<schemars::Schema> {
                vec![$(<$parameters as schemars::JsonSchema>::json_schema(generator)),+]
            }
        }
    };
}

planners! {
    /// Ants that drive race hybrid A* to a first path.
    Formicar(FormicarParameters): "formicar", FormicarParameters::default(),
        "ants that drive race hybrid A* to a first path, which is then improved";
    /// Hybrid A* over motion primitives with analytic shots.
    HybridAstar(HybridAstarParameters): "hybrid-astar", HybridAstarParameters::default(),
        "hybrid A* over motion primitives, forward and in reverse, with analytic shots";
    /// A* over cells, 8-connected.
    Astar(AstarParameters): "astar", AstarParameters::default(),
        "A* over cells, 8-connected: a shortest path; corners rounded";
    /// Descent of the goal field (Dijkstra from the goal), 8-connected.
    Dijkstra(DijkstraParameters): "dijkstra", DijkstraParameters::default(),
        "descent of the goal field over cells: a shortest path; corners rounded";
    /// A* over cells whose estimate weighs more far from the goal (after Niu 2021).
    ImprovedAstar(ImprovedAstarParameters): "improved-astar", ImprovedAstarParameters::default(),
        "A* that trusts its estimate more far from the goal, at most twice the shortest path";
    /// A genetic algorithm over via points, its first population at random.
    Ga(EvolutionParameters): "ga", EvolutionParameters::of(EvolutionConfig::ga()),
        "genetic algorithm over via points, begun at random; corners rounded";
    /// The same, a third of its first population about the path of A*.
    Aga(EvolutionParameters): "aga", EvolutionParameters::of(EvolutionConfig::aga()),
        "genetic algorithm over via points, begun about the path of A*";
    /// The Ant System (Dorigo, Maniezzo & Colorni 1996).
    AntSystem(ColonyParameters): "ant-system", ColonyParameters::of(presets::ant_system()),
        "Ant System: uniform pheromone, all ants deposit; corners rounded";
    /// The elitist Ant System.
    Elitist(ColonyParameters): "elitist", ColonyParameters::of(presets::elitist()),
        "elitist Ant System: the best way so far gains most; corners rounded";
    /// The MAX-MIN Ant System (Stützle & Hoos 2000).
    MaxMin(ColonyParameters): "max-min", ColonyParameters::of(presets::max_min()),
        "MAX-MIN Ant System: only the best ant deposits; corners rounded";
    /// The colony of Lei & Zheng 2020.
    Lei2020(ColonyParameters): "lei2020", ColonyParameters::lei2020(),
        "Lei & Zheng 2020: U-shapes closed, steps towards the goal first, 2-turning";
    /// The colony of Wang et al. 2019.
    Wang2019(ColonyParameters): "wang2019", ColonyParameters::of(presets::wang2019()),
        "Wang et al. 2019: no squeezing between obstacles, guided by the way to the goal";
    /// The colony of Zhang 2016, as Wang et al. describe it.
    Zhang2016(ColonyParameters): "zhang2016", ColonyParameters::of(presets::zhang2016()),
        "Zhang 2016 as Wang et al. describe it: adaptive MAX-MIN Ant System";
    /// The colony of Joshy & Supriya 2016, as Wang et al. describe it.
    Joshy2016(ColonyParameters): "joshy2016", ColonyParameters::of(presets::joshy2016()),
        "Joshy & Supriya 2016 as Wang et al. describe it: six directions";
    /// The fractional-order colony of Li et al. 2024.
    Faco2024(ChordParameters): "faco2024", ChordParameters::default(),
        "Li et al. 2024: ants that step by chords as a suspended car steers, fractional order";
    /// The Ant System that Li et al. 2024 compare with.
    Aco(ColonyParameters): "aco", ColonyParameters::of(presets::aco()),
        "Ant System as Li et al. 2024 compare with it: few ants in a corridor";
    /// The same with A*-seeded pheromone and a B-spline.
    Acof(ColonyParameters): "acof", ColonyParameters::acof(),
        "the same with A*-seeded pheromone and a B-spline that nobody checks";
}

impl Default for PlannerName {
    fn default() -> Self {
        Self::ALL[0]
    }
}

impl PlannerName {
    /// True where it sends ants.
    pub fn has_ants(self) -> bool {
        PlannerConfig::of(self).abilities().sends_ants
    }

    /// True where it weighs soft costs; the others pass over them.
    pub fn heeds_soft_costs(self) -> bool {
        PlannerConfig::of(self).abilities().heeds_soft_costs
    }

    /// The colony over cells of this name; none if it is no such colony.
    pub fn colony(self) -> Option<ColonyConfig> {
        PlannerConfig::of(self).colony().map(|of| of.colony.clone())
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
