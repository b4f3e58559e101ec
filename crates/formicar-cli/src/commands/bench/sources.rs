//! Scenarios, vehicles and parameters that runs name, read from files.

use crate::scene::{self, SceneArgs};
use crate::settings;
use anyhow::Result;
use formicar::planner::PlannerConfig;
use formicar_lab::run::{Contender, LoadedScenario, Place, Sources, Task};

/// Reads built-in maps and files, as `plan` does.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Files;

impl Sources for Files {
    fn load(&self, task: &Task, vehicle: Option<&str>) -> Result<LoadedScenario> {
        let scene = scene::load(&scene_args(task, vehicle))?;
        Ok(LoadedScenario {
            map: scene.map,
            map_record: scene.record,
            vehicle: scene.vehicle.vehicle,
            vehicle_name: scene.vehicle.name,
            ends: scene.ends,
        })
    }

    fn config(&self, contender: &Contender) -> Result<PlannerConfig> {
        let table = contender.config.clone();
        let table = settings::merge(table, &contender.name, &[], Some(contender.planner))?;
        settings::typed(&table)
    }
}

/// The flags of `plan` for the scenario of a task.
fn scene_args(task: &Task, vehicle: Option<&str>) -> SceneArgs {
    let blank = SceneArgs {
        vehicle: vehicle.map(str::to_owned),
        ..SceneArgs::default()
    };
    match &task.place {
        Place::File {
            path,
            id,
            resolution_m,
        } => SceneArgs {
            scenario: Some(path.clone()),
            id: id.clone(),
            resolution: *resolution_m,
            ..blank
        },
        Place::Builtin { map, request } => SceneArgs {
            map: Some(map.clone()),
            request: Some(request.clone()),
            ..blank
        },
        Place::Cells { map, .. } => SceneArgs {
            map: Some(map.display().to_string()),
            vehicle: Some(vehicle.unwrap_or("point").to_owned()),
            ..blank
        },
    }
}
