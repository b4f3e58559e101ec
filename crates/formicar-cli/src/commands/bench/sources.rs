//! Scenarios, vehicles and parameters that runs name, read from files.

use crate::scene::{self, SceneArgs};
use crate::settings;
use anyhow::{Context, Result};
use formicar::planner::{MapRecord, PlannerConfig};
use formicar_lab::run::{
    BARN_VEHICLE, BarnWorlds, Contender, LoadedScenario, Place, Sources, Task,
};
use std::path::Path;

/// Reads built-in maps and files, as `plan` does.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Files;

impl Sources for Files {
    fn load(&self, task: &Task, vehicle: Option<&str>) -> Result<LoadedScenario> {
        if let Place::Barn {
            path,
            world,
            resolution_m,
        } = &task.place
        {
            return barn(path, (*world, *resolution_m), vehicle);
        }
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

/// A world of BARN, with the vehicle that is named or the default one.
fn barn(
    path: &Path,
    (world, resolution_m): (u32, f64),
    vehicle: Option<&str>,
) -> Result<LoadedScenario> {
    let worlds = BarnWorlds::read(path)?;
    let worlds = worlds.with_context(|| format!("{}: no worlds of BARN", path.display()))?;
    let map = worlds.grid(world, resolution_m);
    let vehicle = scene::vehicle(vehicle.unwrap_or(BARN_VEHICLE))?;
    Ok(LoadedScenario {
        map: map.with_context(|| path.display().to_string())?,
        map_record: MapRecord {
            name: path.display().to_string(),
            ..MapRecord::default()
        },
        vehicle: vehicle.vehicle,
        vehicle_name: vehicle.name,
        ends: Some(worlds.ends()),
    })
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
        // Loaded without flags.
        Place::Barn { .. } => blank,
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
