//! The parameters of a planner: how they are reached, checked, and read from documents.

use super::catalog::{PlannerConfig, PlannerName};
use super::{Abilities, ColonyParameters, Found, Halt, Hints, PathSearch, Task};
use crate::objective::DriveCost;
use crate::parameters::OutOfRange;
use crate::path::CurvePath;
use crate::progress::Limits;
use std::any::Any;
use thiserror::Error;

/// An error in a configuration.
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

impl Default for PlannerConfig {
    fn default() -> Self {
        Self::of(PlannerName::default())
    }
}

impl PlannerConfig {
    /// The parameters of its family, where that is `P`: [`ColonyParameters`] for instance.
    ///
    /// ```
    /// use formicar::planner::{ColonyParameters, PlannerConfig, PlannerName};
    ///
    /// let mut config = PlannerConfig::of(PlannerName::Lei2020);
    /// if let Some(parameters) = config.family_mut::<ColonyParameters>() {
    ///     parameters.colony.n_ants = 50;
    /// }
    /// assert_eq!(config.colony().map(|of| of.colony.n_ants), Some(50));
    /// ```
    pub fn family<P: Any>(&self) -> Option<&P> {
        self.parameters_any().downcast_ref()
    }

    /// The same, to be changed.
    pub fn family_mut<P: Any>(&mut self) -> Option<&mut P> {
        self.parameters_any_mut().downcast_mut()
    }

    /// The parameters of a colony over cells; none of other planners.
    pub fn colony(&self) -> Option<&ColonyParameters> {
        self.family()
    }

    /// The same, to be changed.
    pub fn colony_mut(&mut self) -> Option<&mut ColonyParameters> {
        self.family_mut()
    }

    /// The cost of a driven path: `formicar` improves by it, and transitions of continuous
    /// curvature are weighed by it, whichever planner found the path.
    pub fn cost(&self) -> &DriveCost {
        self.search().cost()
    }
}

impl PathSearch for PlannerConfig {
    fn name(&self) -> &str {
        self.planner().name()
    }

    fn find(&self, task: &mut Task<'_>, limits: &mut Limits<'_>) -> Result<Found, Halt> {
        self.search().find(task, limits)
    }

    fn abilities(&self) -> Abilities {
        self.search().abilities()
    }

    fn replan(
        &self,
        task: &mut Task<'_>,
        previous: &CurvePath,
        limits: &mut Limits<'_>,
    ) -> Result<Found, Halt> {
        self.search().replan(task, previous, limits)
    }

    fn hints(&self) -> Hints {
        self.search().hints()
    }

    fn config(&self) -> Option<&PlannerConfig> {
        Some(self)
    }
}
