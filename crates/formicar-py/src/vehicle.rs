//! Vehicles.

use crate::errors::{self, Outcome};
use crate::values;
use formicar::planner::VehicleRecord;
use formicar::vehicle::{Motion, PRESET_NAMES, Vehicle, VehicleParameters};
use formicar_cli::reading;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;

/// A vehicle and the name that it goes by.
#[pyclass(frozen, module = "formicar._formicar")]
#[derive(Clone, Debug)]
pub(crate) struct Car {
    pub(crate) vehicle: Vehicle,
    pub(crate) name: String,
}

#[pymethods]
impl Car {
    /// A built-in vehicle.
    #[staticmethod]
    fn preset(name: &str) -> Outcome<Self> {
        Ok(Self {
            vehicle: Vehicle::preset(name)?,
            name: name.to_owned(),
        })
    }

    /// Names of the built-in vehicles.
    #[staticmethod]
    fn presets() -> Vec<&'static str> {
        PRESET_NAMES.to_vec()
    }

    /// A vehicle from a TOML or JSON file.
    #[staticmethod]
    fn load(path: PathBuf) -> PyResult<Self> {
        let name = path.display().to_string();
        let is_document = path.extension().is_some_and(|extension| {
            extension.eq_ignore_ascii_case("toml") || extension.eq_ignore_ascii_case("json")
        });
        if !is_document {
            return Err(errors::vehicle(format!(
                "{name}: a vehicle file is .toml or .json; hint: Vehicle.preset for a built-in one"
            )));
        }
        let read = reading::vehicle(&name);
        let vehicle =
            read.map_err(|error| errors::file(&path, errors::vehicle(format!("{error:#}"))))?;
        Ok(Self { vehicle, name })
    }

    /// A vehicle from its measures.
    #[staticmethod]
    fn of_measures(measures: &Bound<'_, PyDict>) -> Outcome<Self> {
        let value = values::to_json(measures, "vehicle", of_measure)?;
        let parameters: VehicleParameters = values::document(value, "vehicle", of_measure)?;
        Ok(Self {
            vehicle: Vehicle::new(parameters)?,
            name: "vehicle".to_owned(),
        })
    }

    /// The same with another safety margin.
    fn with_margin(&self, margin_m: f64) -> Outcome<Self> {
        Ok(Self {
            vehicle: self.vehicle.with_safety_margin(margin_m)?,
            name: self.name.clone(),
        })
    }

    /// The measures that were given.
    fn measures<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        values::to_python(py, self.vehicle.parameters())
    }

    #[getter]
    fn name(&self) -> &str {
        &self.name
    }

    #[getter]
    fn is_point(&self) -> bool {
        self.vehicle.motion() == Motion::Point
    }

    /// Corners of the body with its margin, around the rear axle.
    #[getter]
    fn footprint(&self) -> Vec<[f64; 2]> {
        let corners = self.vehicle.footprint().corners().iter();
        corners.map(|corner| [corner.x, corner.y]).collect()
    }

    #[getter]
    fn width_m(&self) -> f64 {
        self.vehicle.width_m()
    }

    #[getter]
    fn length_m(&self) -> f64 {
        let (low, high) = self.vehicle.footprint().bounds();
        high.x - low.x
    }

    #[getter]
    fn wheelbase_m(&self) -> Option<f64> {
        self.vehicle.wheelbase_m()
    }

    #[getter]
    fn max_curvature_per_m(&self) -> f64 {
        self.vehicle.max_curvature_per_m()
    }

    #[getter]
    fn min_turning_radius_m(&self) -> f64 {
        self.vehicle.min_turning_radius_m()
    }

    #[getter]
    fn max_steer_rad(&self) -> Option<f64> {
        self.vehicle.steer_rad(self.vehicle.max_curvature_per_m())
    }

    #[getter]
    fn hash(&self) -> String {
        format!("{:032x}", self.vehicle.hash())
    }

    fn same_as(&self, other: &Self) -> bool {
        self.vehicle == other.vehicle
    }

    /// Everything, as JSON.
    fn state(&self) -> PyResult<String> {
        let record = VehicleRecord {
            name: self.name.clone(),
            motion: self.vehicle.motion(),
            parameters: self.vehicle.parameters().clone(),
        };
        serde_json::to_string(&record).map_err(values::broken)
    }

    /// The vehicle of such a state.
    #[staticmethod]
    fn of_state(state: &str) -> Outcome<Self> {
        let record: VehicleRecord = serde_json::from_str(state).map_err(errors::vehicle)?;
        let vehicle = match record.motion {
            Motion::Point => Vehicle::point(),
            _ => Vehicle::new(record.parameters)?,
        };
        Ok(Self {
            vehicle,
            name: record.name,
        })
    }
}

/// A measure that cannot be.
fn of_measure(message: String) -> PyErr {
    errors::vehicle(format!("vehicle {message}"))
}

/// Every measure that a vehicle may have.
#[pyfunction]
pub(crate) fn vehicle_keys() -> Vec<String> {
    let keys = formicar::parameters::list(&formicar_schema());
    keys.into_iter().map(|parameter| parameter.key).collect()
}

fn formicar_schema() -> schemars::Schema {
    schemars::schema_for!(VehicleParameters)
}
