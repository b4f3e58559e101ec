//! What a page needs to know before it asks for anything.

use crate::options::Limits;
use formicar::map::builtin;
use formicar::planner::{PlannerConfig, PlannerName};
use formicar::vehicle::{PRESET_NAMES, Vehicle, VehicleParameters};
use serde_json::{Value as Json, json};

/// Maps, vehicles and planners with their parameters, and the schemas of both.
pub(crate) fn catalog(limits: &Limits) -> Json {
    let map = |map: &builtin::BuiltinMap| {
        json!({
            "name": map.name,
            "about": map.about,
            "kind": map.kind,
            "vehicle": map.vehicle,
        })
    };
    let vehicle = |name: &&str| {
        let vehicle = Vehicle::preset(name).ok()?;
        Some(json!({ "name": name, "parameters": vehicle.parameters() }))
    };
    let planner = |planner: PlannerName| {
        json!({
            "name": planner.name(),
            "about": planner.about(),
            "has_ants": planner.has_ants(),
            "config": PlannerConfig::of(planner),
        })
    };
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "maps": builtin::all().iter().map(map).collect::<Vec<_>>(),
        "vehicles": PRESET_NAMES.iter().filter_map(vehicle).collect::<Vec<_>>(),
        "planners": PlannerName::ALL.map(planner),
        "config_schema": schemars::schema_for!(PlannerConfig),
        "vehicle_schema": schemars::schema_for!(VehicleParameters),
        "limits": {
            "max_upload_bytes": limits.max_upload_bytes,
            "max_cells": limits.max_cells,
        },
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_everything_there_is() {
        let catalog = catalog(&Limits::default());
        let n = |key: &str| catalog[key].as_array().unwrap().len();
        assert_eq!(n("maps"), builtin::all().len());
        assert_eq!(n("vehicles"), PRESET_NAMES.len());
        assert_eq!(n("planners"), PlannerName::ALL.len());
        assert!(catalog["config_schema"]["properties"]["colony"].is_object());
    }
}
