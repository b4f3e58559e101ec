//! The parts of an experiment: grounds, variants, and the number of runs.

use anyhow::{Context, Result};
use formicar::map::OccupancyGrid;
use formicar::map::builtin::BuiltinMap;
use formicar::planner::{PlanError, Planner, PlannerConfig, PlannerName};
use formicar::scenario::{GoalHeading, Request, StartHeading};
use formicar::vehicle::Vehicle;
use std::any::Any;
use std::path::PathBuf;

/// The number of runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Scale {
    /// Runs of each variant on each map, with the seeds 0 to `n_seeds` - 1.
    pub n_seeds: u64,
    /// Runs of each method on further scenarios, with the seeds from 0 on.
    pub n_runs: u64,
    /// Repetitions of each timing.
    pub n_timings: usize,
    /// Runs only the smaller of several sizes and sets.
    pub is_small: bool,
}

impl Scale {
    /// As published.
    pub const FULL: Self = Self {
        n_seeds: 31,
        n_runs: 10,
        n_timings: 11,
        is_small: false,
    };
    /// Few runs, to check that everything works.
    pub const QUICK: Self = Self {
        n_seeds: 3,
        n_runs: 3,
        n_timings: 3,
        is_small: true,
    };
}

/// The number of runs, and their data.
#[derive(Clone, Debug)]
pub struct Setup {
    /// The number of runs.
    pub scale: Scale,
    /// Folder of data sets; missing ones are left out.
    pub data: PathBuf,
    /// Runs at a time. Results do not depend on it; times do.
    pub n_jobs: usize,
}

/// A configuration with a name.
#[derive(Clone, Debug)]
pub struct Variant {
    /// Its name in tables.
    pub name: String,
    /// The configuration.
    pub config: PlannerConfig,
}

impl Variant {
    /// A planner as it is.
    pub(crate) fn of(planner: PlannerName) -> Self {
        Self {
            name: planner.name().to_owned(),
            config: PlannerConfig::of(planner),
        }
    }

    /// A planner with something changed in its parameters, which are of type `P`.
    pub(crate) fn changed<P: Any>(
        planner: PlannerName,
        what: &str,
        change: impl FnOnce(&mut P),
    ) -> Self {
        let mut config = PlannerConfig::of(planner);
        let parameters = config.family_mut();
        change(parameters.expect("a variant names its planner and parameters together"));
        Self {
            name: format!("{}, {what}", planner.name()),
            config,
        }
    }
}

/// A map, a vehicle and a request.
#[derive(Clone, Debug)]
pub struct Ground {
    /// Name of the map, with that of the request where there are several.
    pub map: String,
    /// The map itself.
    pub grid: OccupancyGrid,
    /// The vehicle.
    pub vehicle: Vehicle,
    /// The query.
    pub request: Request,
}

impl Ground {
    /// A planner for its map and vehicle.
    pub(crate) fn planner(&self, config: &PlannerConfig) -> Result<Planner, PlanError> {
        Planner::new(&self.grid, self.vehicle.clone(), config.clone())
    }

    /// A built-in map with its first request and its own vehicle.
    pub(crate) fn builtin(map: &str) -> Result<Self> {
        let builtin = BuiltinMap::by_name(map)?;
        let ends = &builtin.requests[0];
        Ok(Self {
            map: map.to_owned(),
            grid: builtin.grid(),
            vehicle: Vehicle::preset(builtin.vehicle)
                .with_context(|| format!("vehicle {} of {map}", builtin.vehicle))?,
            request: Request {
                start_heading: StartHeading::Any,
                goal_heading: GoalHeading::Any,
                ..Request::new(ends.start, ends.goal)
            },
        })
    }
}
