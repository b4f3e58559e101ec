//! The catalog that a page loads first: maps, vehicles, planners and schemas.

use crate::options::Limits;
use formicar::map::builtin::{self, BuiltinKind};
use formicar::planner::{PlannerConfig, PlannerName};
use formicar::vehicle::{PRESET_NAMES, Vehicle, VehicleParameters};
use schemars::Schema;
use serde::Serialize;

/// Maps, vehicles and planners with their parameters, and the schemas of both.
#[derive(Debug, Serialize)]
pub(crate) struct Catalog {
    version: &'static str,
    maps: Vec<MapEntry>,
    vehicles: Vec<VehicleEntry>,
    planners: Vec<PlannerEntry>,
    config_schema: Schema,
    vehicle_schema: Schema,
    limits: UploadLimits,
}

#[derive(Debug, Serialize)]
struct MapEntry {
    name: &'static str,
    about: &'static str,
    kind: BuiltinKind,
    vehicle: &'static str,
}

#[derive(Debug, Serialize)]
struct VehicleEntry {
    name: &'static str,
    parameters: VehicleParameters,
}

#[derive(Debug, Serialize)]
struct PlannerEntry {
    name: &'static str,
    about: &'static str,
    has_ants: bool,
    config: PlannerConfig,
}

#[derive(Debug, Serialize)]
struct UploadLimits {
    max_upload_bytes: usize,
    max_cells: usize,
}

impl Catalog {
    /// The catalog of everything built in.
    pub(crate) fn new(limits: &Limits) -> Self {
        let map = |map: &builtin::BuiltinMap| MapEntry {
            name: map.name,
            about: map.about,
            kind: map.kind,
            vehicle: map.vehicle,
        };
        let vehicle = |name: &'static str| {
            let vehicle = Vehicle::preset(name).ok()?;
            let parameters = vehicle.parameters().clone();
            Some(VehicleEntry { name, parameters })
        };
        let planner = |planner: PlannerName| PlannerEntry {
            name: planner.name(),
            about: planner.about(),
            has_ants: planner.has_ants(),
            config: PlannerConfig::of(planner),
        };
        Self {
            version: env!("CARGO_PKG_VERSION"),
            maps: builtin::all().iter().map(map).collect(),
            vehicles: PRESET_NAMES.into_iter().filter_map(vehicle).collect(),
            planners: PlannerName::ALL.into_iter().map(planner).collect(),
            config_schema: schemars::schema_for!(PlannerConfig),
            vehicle_schema: schemars::schema_for!(VehicleParameters),
            limits: UploadLimits {
                max_upload_bytes: limits.max_upload_bytes,
                max_cells: limits.max_cells,
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_all_that_is_built_in() {
        let catalog = serde_json::to_value(Catalog::new(&Limits::default())).unwrap();
        let n = |key: &str| catalog[key].as_array().unwrap().len();
        assert_eq!(n("maps"), builtin::all().len());
        assert_eq!(n("vehicles"), PRESET_NAMES.len());
        assert_eq!(n("planners"), PlannerName::ALL.len());
        assert!(catalog["config_schema"]["properties"]["colony"].is_object());
    }
}
