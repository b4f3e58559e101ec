//! The scenario of a run, loaded: map, vehicle, start and goal.

use super::job::{Contender, Job, Place, Task};
use anyhow::{Context, Result, bail};
use formicar::geometry::Pose2;
use formicar::map::builtin::BuiltinMap;
use formicar::map::{Cell, OccupancyGrid};
use formicar::planner::{MapRecord, PlannerConfig, RequestDocument};
use formicar::vehicle::Vehicle;

/// Map and vehicle of a scenario.
#[derive(Clone, Debug)]
pub struct LoadedScenario {
    /// The map, every cell free or occupied.
    pub map: OccupancyGrid,
    /// The origin of the map.
    pub map_record: MapRecord,
    /// The vehicle.
    pub vehicle: Vehicle,
    /// The vehicle's preset, file or scenario.
    pub vehicle_name: String,
    /// Start and goal; a scenario over cells has its own.
    pub ends: Option<[Pose2; 2]>,
}

/// Reads what jobs name: scenarios, vehicles and planner parameters.
pub trait Sources: Sync {
    /// Loads the scenario of a task, with a vehicle instead of its own where one is named.
    ///
    /// # Errors
    /// A map or a vehicle that cannot be read.
    fn load(&self, task: &Task, vehicle: Option<&str>) -> Result<LoadedScenario>;

    /// The parameters of a planner.
    ///
    /// # Errors
    /// Parameters that do not exist or are out of range.
    fn config(&self, contender: &Contender) -> Result<PlannerConfig>;
}

impl LoadedScenario {
    /// Start and goal of a task on this map.
    ///
    /// # Errors
    /// A scenario without a start and a goal.
    pub fn ends(&self, task: &Task) -> Result<[Pose2; 2]> {
        let frame = self.map.frame();
        let center = |[col, row]: [u32; 2]| Pose2::at(frame.center(Cell::new(col, row)), 0.0);
        match task.place {
            Place::Cells { start, goal, .. } => Ok([center(start), center(goal)]),
            _ => self.ends.context("the scenario has no start and goal"),
        }
    }

    /// The request of a job on this map.
    ///
    /// # Errors
    /// A scenario without a start and a goal.
    pub fn request(&self, job: &Job) -> Result<RequestDocument> {
        let [start, goal] = self.ends(&job.task)?;
        let list = |pose: Pose2| Some([pose.x, pose.y, pose.heading]);
        Ok(RequestDocument {
            start: list(start),
            goal: list(goal),
            motion: job.limits.motion,
            deadline_ms: job.limits.deadline_ms,
            budget_steps: job.limits.budget_steps,
            ..RequestDocument::default()
        })
    }
}

/// Built-in maps with their own vehicles or presets, and planners with their default parameters:
/// sources that read no files.
#[derive(Clone, Copy, Debug)]
pub struct BuiltinSources;

impl Sources for BuiltinSources {
    fn load(&self, task: &Task, vehicle: Option<&str>) -> Result<LoadedScenario> {
        let Place::Builtin { map, request } = &task.place else {
            bail!("scenario {:?}: it is on no built-in map", task.scenario);
        };
        let builtin = BuiltinMap::by_name(map)?;
        let ends = builtin.request(request)?;
        let vehicle_name = vehicle.unwrap_or(builtin.vehicle).to_owned();
        Ok(LoadedScenario {
            map: builtin.grid(),
            map_record: MapRecord {
                name: map.clone(),
                ..MapRecord::default()
            },
            vehicle: Vehicle::preset(&vehicle_name)?,
            vehicle_name,
            ends: Some([ends.start, ends.goal]),
        })
    }

    fn config(&self, contender: &Contender) -> Result<PlannerConfig> {
        let mut config = contender.config.clone();
        config.insert("planner".to_owned(), contender.planner.name().into());
        Ok(config.try_into()?)
    }
}
