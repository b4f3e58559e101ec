//! The scene of a client: a map that it may edit, and a vehicle.

use crate::maps::{OpenMap, list};
use crate::protocol::{Region, ServerMessage, VehicleChoice};
use axum::extract::ws::Message;
use formicar::collision::ObstacleMap;
use formicar::map::{Cell, CellRegion, OCCUPIED, OccupancyGrid, UNKNOWN};
use formicar::planner::{MapRecord, Planner};
use formicar::vehicle::{Motion, Vehicle};
use std::sync::Arc;

/// The vehicle for maps that name none.
const DEFAULT_VEHICLE: &str = "warehouse_amr";
/// The name of a vehicle that is no preset.
const OWN: &str = "own";

/// A map and a vehicle.
pub(crate) struct Scene {
    pub(crate) opened: Arc<OpenMap>,
    /// The map with all edits.
    pub(crate) grid: OccupancyGrid,
    /// The same map, prepared for queries.
    pub(crate) obstacles: Arc<ObstacleMap>,
    pub(crate) is_edited: bool,
    pub(crate) vehicle: Vehicle,
    pub(crate) vehicle_name: String,
}

impl Scene {
    /// A map as it was opened, with the vehicle that it names; a map that names none takes the
    /// vehicle from before.
    pub(crate) fn new(opened: Arc<OpenMap>, before: Option<Self>) -> Self {
        let preset = |name: &str| (Vehicle::preset(name).ok(), name.to_owned());
        let (vehicle, vehicle_name) = match (opened.builtin, before) {
            (Some(map), _) => preset(map.vehicle),
            (None, Some(before)) => (Some(before.vehicle), before.vehicle_name),
            (None, None) => preset(DEFAULT_VEHICLE),
        };
        Self {
            grid: opened.grid.clone(),
            obstacles: opened.obstacles.clone(),
            is_edited: false,
            vehicle: vehicle.unwrap_or_else(Vehicle::warehouse_amr),
            vehicle_name,
            opened,
        }
    }

    /// Changes the vehicle.
    ///
    /// # Errors
    /// An unknown preset, or invalid measures.
    pub(crate) fn set_vehicle(&mut self, choice: &VehicleChoice) -> Result<(), String> {
        let (name, vehicle) = match choice {
            VehicleChoice::Preset(name) => (name.as_str(), Vehicle::preset(name)),
            VehicleChoice::Parameters(measures) => (OWN, Vehicle::new((**measures).clone())),
        };
        self.vehicle = vehicle.map_err(|error| error.to_string())?;
        name.clone_into(&mut self.vehicle_name);
        Ok(())
    }

    /// Sets the values of a rectangle, here and in the maps of planners.
    ///
    /// # Errors
    /// A rectangle off the map, a wrong number of values, or an invalid value.
    pub(crate) fn paint<'a>(
        &mut self,
        region: Region,
        values: &[i8],
        planners: impl Iterator<Item = &'a mut Planner>,
    ) -> Result<(), String> {
        let corner = Cell::new(region.col, region.row);
        let region = CellRegion::new(corner, region.n_cols as usize, region.n_rows as usize);
        let changed = self.grid.replace(&region, values);
        changed.map_err(|error| error.to_string())?;
        self.is_edited = true;
        let decide = |&value: &i8| if value == UNKNOWN { OCCUPIED } else { value };
        let decided: Vec<i8> = values.iter().map(decide).collect();
        let mut planners = planners.peekable();
        if planners.peek().is_none() {
            let obstacles = Arc::make_mut(&mut self.obstacles);
            let updated = obstacles.update(&region, &decided);
            return updated.map(|_| ()).map_err(|error| error.to_string());
        }
        for planner in planners {
            let updated = planner.update_map(region, &decided);
            updated.map_err(|error| error.to_string())?;
            self.obstacles = planner.obstacles().clone();
        }
        Ok(())
    }

    /// The record of the map for answers.
    pub(crate) fn record(&self) -> MapRecord {
        MapRecord {
            name: self.opened.name.clone(),
            unknown: "occupied".to_owned(),
            warnings: self.opened.warnings.clone(),
            ..MapRecord::default()
        }
    }

    /// The value of `--map` that stands for this map.
    pub(crate) fn file(&self) -> &str {
        match self.opened.builtin {
            Some(map) if !self.is_edited => map.name,
            _ => "map.yaml",
        }
    }

    /// The map as a message.
    pub(crate) fn map_message(&self) -> Message {
        let frame = self.grid.frame();
        let message = ServerMessage::Map {
            name: &self.opened.name,
            hash: self.opened.hash.as_deref(),
            n_cols: frame.n_cols(),
            n_rows: frame.n_rows(),
            resolution_m: frame.resolution_m(),
            origin: list(frame.origin()),
            vehicle: self.opened.builtin.map(|map| map.vehicle),
            requests: self.opened.requests(),
        };
        let values: Vec<u8> = self
            .grid
            .values()
            .iter()
            .map(|&value| value as u8)
            .collect();
        message.with_payload(&values)
    }

    /// The vehicle as a message.
    pub(crate) fn vehicle_message(&self) -> Message {
        let vehicle = &self.vehicle;
        let is_car = vehicle.motion() == Motion::Car;
        let corners = vehicle.footprint().corners().iter();
        let message = ServerMessage::Vehicle {
            name: &self.vehicle_name,
            parameters: vehicle.parameters(),
            footprint: corners.map(|corner| [corner.x, corner.y]).collect(),
            motion: if is_car { "car" } else { "point" },
            min_turning_radius_m: is_car.then(|| vehicle.min_turning_radius_m()),
            wheelbase_m: vehicle.wheelbase_m(),
            track_width_m: is_car.then(|| vehicle.track_width_m()),
            max_steer_rad: vehicle.steer_rad(vehicle.max_curvature_per_m()),
        };
        message.text()
    }
}
