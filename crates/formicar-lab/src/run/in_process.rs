//! Runs in this process, of planners that are handed over too.

use super::job::Job;
use super::ours::{Begun, run_planner};
use super::record::Run;
use super::scenario::{LoadedScenario, Sources};
use anyhow::{Result, anyhow};
use formicar::planner::{PathSearch, PlanError, Planner};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Makes a planner for a scenario.
type Make<'a> = Box<dyn Fn(&LoadedScenario) -> Result<Planner, PlanError> + Sync + 'a>;

/// Carries out runs in this process. Processor time and memory are those of the whole process, so
/// that they mean little where several runs share it.
pub struct InProcess<'a> {
    sources: &'a dyn Sources,
    planners: BTreeMap<String, Make<'a>>,
}

impl<'a> InProcess<'a> {
    /// Runs of the built-in planners.
    pub fn new(sources: &'a dyn Sources) -> Self {
        Self {
            sources,
            planners: BTreeMap::new(),
        }
    }

    /// Adds a planner of the caller under the name of a contender that is
    /// [in process](super::Contender::in_process).
    #[must_use]
    pub fn with_planner(
        mut self,
        name: &str,
        make: impl Fn(&LoadedScenario) -> Result<Planner, PlanError> + Sync + 'a,
    ) -> Self {
        self.planners.insert(name.to_owned(), Box::new(make));
        self
    }

    /// Adds a search of the caller under its own name.
    #[must_use]
    pub fn with_search(self, search: Arc<dyn PathSearch>) -> Self {
        let name = search.name().to_owned();
        self.with_planner(&name, move |scenario| {
            let vehicle = scenario.vehicle.clone();
            Ok(Planner::with_search(&scenario.map, vehicle, search.clone()))
        })
    }

    /// Carries out one run.
    ///
    /// # Errors
    /// A scenario that cannot be read, and a planner that was not handed over.
    pub fn run(&self, job: &Job) -> Result<Run> {
        let (contender, begun) = (&job.contender, Begun::now());
        if !contender.is_in_process {
            return super::carry_out(job, self.sources, begun);
        }
        let make = self.planners.get(&contender.name);
        let make = make.ok_or_else(|| anyhow!("no planner {:?} was added", contender.name))?;
        let scenario = self.sources.load(&job.task, job.vehicle_source())?;
        run_planner(job, scenario, begun, make)
    }
}
