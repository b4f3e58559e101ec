//! Simulated drives along a path.

use crate::errors::{self, Outcome};
use crate::grid::Grid;
use crate::motion::Motion;
use crate::path::Track;
use crate::values;
use crate::vehicle::Car;
use formicar::path::CurvePath;
use formicar::tracking::{
    DrivenClearance, TracePoint, Tracking, TrackingConfig, track, track_in_time,
};
use numpy::IntoPyArray;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// A simulated drive.
#[pyclass(frozen, module = "formicar._formicar")]
pub(crate) struct Drive {
    planned: CurvePath,
    tracking: Tracking,
    clearance: DrivenClearance,
    grid: Py<Grid>,
    car: Car,
}

#[pymethods]
impl Drive {
    /// Drives a vehicle along a path.
    #[new]
    fn new(path: &Track, grid: Py<Grid>, car: &Car, settings: &Bound<'_, PyDict>) -> Outcome<Self> {
        let py = settings.py();
        let config = config(settings, car)?;
        let obstacles = grid.get().obstacles();
        let (path, vehicle) = (path.clone(), car.vehicle.clone());
        let (planned, tracking, clearance) = py.detach(|| {
            let planned = path.driven(&obstacles, &vehicle);
            let tracking = track(&planned, &vehicle, &config)?;
            let clearance = tracking.clearance(&obstacles, &vehicle);
            Ok::<_, errors::Failed>((planned, tracking, clearance))
        })?;
        Ok(Self {
            planned,
            tracking,
            clearance,
            grid,
            car: car.clone(),
        })
    }

    /// Drives a vehicle along a path with its times.
    #[staticmethod]
    fn in_time(motion: &Motion, settings: &Bound<'_, PyDict>) -> Outcome<Self> {
        let py = settings.py();
        let (grid, car) = motion.scene(py);
        let config = config(settings, &car)?;
        let timed = motion.timed_path()?;
        let obstacles = grid.get().obstacles();
        let (tracking, clearance) = py.detach(|| {
            let tracking = track_in_time(&timed, Some(&obstacles), &car.vehicle, &config)?;
            let clearance = tracking.clearance(&obstacles, &car.vehicle);
            Ok::<_, errors::Failed>((tracking, clearance))
        })?;
        Ok(Self {
            planned: timed.path().clone(),
            tracking,
            clearance,
            grid,
            car,
        })
    }

    /// The document without its trace.
    fn document<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let document = self.tracking.document(&self.clearance);
        let mut value = serde_json::to_value(&document).map_err(values::broken)?;
        if let Some(members) = value.as_object_mut() {
            members.remove("trace");
        }
        values::from_json(py, &value)
    }

    /// The vehicle over time, a list for each column.
    fn columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let columns = PyDict::new(py);
        let column = |of: &dyn Fn(&TracePoint) -> f64| {
            let values = self.tracking.trace.iter().map(of).collect::<Vec<_>>();
            values.into_pyarray(py)
        };
        columns.set_item("t", column(&|p| p.t_s))?;
        columns.set_item("x", column(&|p| p.pose.x))?;
        columns.set_item("y", column(&|p| p.pose.y))?;
        columns.set_item("heading", column(&|p| p.pose.heading))?;
        columns.set_item("driven", column(&|p| p.driven_m))?;
        columns.set_item("s", column(&|p| p.s_m))?;
        columns.set_item("direction", column(&|p| p.direction.sign()))?;
        columns.set_item("steer", column(&|p| p.steer_rad))?;
        columns.set_item("left_wheel", column(&|p| p.left_wheel_rad))?;
        columns.set_item("right_wheel", column(&|p| p.right_wheel_rad))?;
        columns.set_item("cross_track_error", column(&|p| p.cross_track_error_m))?;
        columns.set_item("heading_error", column(&|p| p.heading_error_rad))?;
        if self.tracking.trace.iter().any(|p| p.speed_mps.is_some()) {
            columns.set_item("speed", column(&|p| p.speed_mps.unwrap_or(f64::NAN)))?;
        }
        Ok(columns)
    }

    /// The trace as CSV.
    fn to_csv(&self) -> String {
        self.tracking.trace_csv()
    }

    /// The picture that the command line draws.
    fn svg(&self, title: &str, caption: &str, py: Python<'_>) -> String {
        let grid = self.grid.get();
        py.detach(|| {
            let obstacles = grid.obstacles();
            let clearance = &self.clearance;
            let nearest_at = clearance
                .contact
                .as_ref()
                .map_or(clearance.tightest, |c| c.pose);
            let place = obstacles.contact(&self.car.vehicle, nearest_at);
            let picture = formicar::render::DrivePicture {
                map: &grid.map,
                vehicle: &self.car.vehicle,
                planned: &self.planned,
                drive: &self.tracking,
                tightest: Some((place, clearance.min_clearance_m)),
                title,
                caption,
            };
            formicar::render::drive_picture(&picture).to_svg()
        })
    }
}

/// The parameters of a drive, completed by the vehicle.
fn config(settings: &Bound<'_, PyDict>, car: &Car) -> Outcome<TrackingConfig> {
    let settings = values::to_json(settings, "track", errors::config)?;
    let config: TrackingConfig = values::document(settings, "track", errors::config)?;
    Ok(config.for_vehicle(&car.vehicle)?)
}
