//! Drives in time: moving obstacles, the speed along a path among them, and the judge's word on it.

use crate::errors::{self, Outcome};
use crate::grid::Grid;
use crate::path::Track;
use crate::values;
use crate::vehicle::Car;
use formicar::motion::{MotionConfig, MotionError, MotionStatus};
use formicar::path::{CurvePath, Phase, Spacing, SpeedLimits, TimedPath};
use formicar::planner::{
    DriveError, DriveQuestion, MotionRecord, MovingDocument, PathDocument, PoseRecord, TimedPlan,
    drive_in_time,
};
use formicar::scenario::{Predicted, Predictions};
use formicar::validation::judge_in_time;
use formicar::vehicle::Vehicle;
use formicar_cli::reading;
use numpy::ndarray::Array3;
use numpy::{IntoPyArray, PyArray1, PyArray3, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::Value;
use std::path::PathBuf;
use std::sync::OnceLock;

/// Moving obstacles and how far they are predicted.
#[pyclass(frozen, module = "formicar._formicar")]
pub(crate) struct Moving {
    predictions: Predictions,
}

#[pymethods]
impl Moving {
    /// The predictions of a document.
    #[new]
    fn new(document: &Bound<'_, PyDict>) -> Outcome<Self> {
        let value = values::to_json(document, "predictions", errors::obstacle)?;
        let document: MovingDocument = values::document(value, "predictions", errors::obstacle)?;
        Ok(Self {
            predictions: document.predictions()?,
        })
    }

    /// Those of a file.
    #[staticmethod]
    fn load(path: PathBuf) -> PyResult<Self> {
        let read = reading::moving(&path);
        let predictions =
            read.map_err(|error| errors::file(&path, errors::obstacle(format!("{error:#}"))))?;
        Ok(Self { predictions })
    }

    /// The document.
    fn to_json(&self) -> PyResult<String> {
        let document = MovingDocument::from(&self.predictions);
        serde_json::to_string(&document).map_err(values::broken)
    }

    #[getter]
    fn horizon_s(&self) -> f64 {
        self.predictions.horizon_s()
    }

    #[getter]
    fn names(&self) -> Vec<&str> {
        let obstacles = self.predictions.obstacles().iter();
        obstacles.map(Predicted::name).collect()
    }

    /// Poses of all obstacles at all times.
    fn poses<'py>(
        &self,
        times: PyReadonlyArray1<'_, f64>,
        py: Python<'py>,
    ) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let times = times.as_array();
        let obstacles = self.predictions.obstacles();
        let mut flat = Vec::with_capacity(obstacles.len() * times.len() * 3);
        for obstacle in obstacles {
            for &t_s in times {
                let pose = obstacle.pose_at(t_s).wrapped();
                flat.extend([pose.x, pose.y, pose.heading]);
            }
        }
        let shape = (obstacles.len(), times.len(), 3);
        let array = Array3::from_shape_vec(shape, flat).map_err(values::broken)?;
        Ok(array.into_pyarray(py))
    }
}

/// A closed stretch of the path: obstacle, from and to in seconds, from and to in meters.
type Closed = (usize, f64, f64, f64, f64);

/// A path with the speed at which it is driven, or the reason why it cannot be.
#[pyclass(frozen, module = "formicar._formicar")]
pub(crate) struct Motion {
    path: PathDocument,
    curve: CurvePath,
    record: MotionRecord,
    regions: Vec<Closed>,
    grid: Py<Grid>,
    car: Car,
    timed: OnceLock<PathDocument>,
}

#[pymethods]
impl Motion {
    /// Plans the speed along a path.
    #[new]
    fn new(
        track: &Track,
        scene: (Py<Grid>, Py<Car>),
        moving: &Moving,
        limits: &Bound<'_, PyDict>,
        settings: &Bound<'_, PyDict>,
    ) -> Outcome<Self> {
        let py = limits.py();
        let (grid, car) = (scene.0, scene.1.get().clone());
        let config = config(&car.vehicle, limits, settings)?;
        let (track, obstacles) = (track.clone(), grid.get().obstacles());
        let question = DriveQuestion {
            predictions: &moving.predictions,
            zones: None,
            config: &config,
        };
        let planned = py.detach(|| {
            let curve = track.certified(&obstacles, &car.vehicle)?;
            let path = PathDocument::new(&curve, &obstacles, &car.vehicle, Spacing::default());
            let drive = drive_in_time(obstacles.frame(), &car.vehicle, &curve, &question);
            Ok::<_, errors::Failed>((path, drive))
        });
        let (path, drive) = planned?;
        let (record, regions) = recorded(drive, &question)?;
        Ok(Self::made(path, record, regions, (grid, car))?)
    }

    /// The record, as the command line writes it.
    fn to_json(&self) -> PyResult<String> {
        serde_json::to_string(&self.record).map_err(values::broken)
    }

    /// A member of the record by name; all of it by another one.
    fn member<'py>(&self, name: &str, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        match name {
            "config" => values::to_python(py, &self.record.config),
            "certificate" => values::to_python(py, &self.record.certificate),
            "profile" => values::to_python(py, &self.record.profile),
            _ => values::to_python(py, &self.record),
        }
    }

    #[getter]
    fn status(&self) -> Option<&'static str> {
        self.record.status.map(MotionStatus::name)
    }

    #[getter]
    fn reason(&self) -> Option<&str> {
        self.record.reason.as_deref()
    }

    /// The obstacles that were planned with.
    fn moving(&self) -> Outcome<Moving> {
        Ok(Moving {
            predictions: self.record.moving.predictions()?,
        })
    }

    /// The poses in time as far as they are reached, a list for each column.
    fn columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let poses = py.detach(|| self.timed_poses());
        let reached: Vec<_> = poses.iter().filter(|pose| pose.time.is_some()).collect();
        let columns = PyDict::new(py);
        let column = |of: &dyn Fn(&PoseRecord) -> Option<f64>| {
            let values = reached.iter().map(|pose| of(pose).unwrap_or(f64::NAN));
            values.collect::<Vec<_>>().into_pyarray(py)
        };
        columns.set_item("t", column(&|p| p.time))?;
        columns.set_item("s", column(&|p| Some(p.s)))?;
        columns.set_item("x", column(&|p| Some(p.x)))?;
        columns.set_item("y", column(&|p| Some(p.y)))?;
        columns.set_item("heading", column(&|p| Some(p.heading)))?;
        columns.set_item("direction", column(&|p| Some(p.direction.sign())))?;
        columns.set_item("speed", column(&|p| p.speed))?;
        columns.set_item("acceleration", column(&|p| p.acceleration))?;
        columns.set_item("curvature", column(&|p| Some(p.curvature)))?;
        columns.set_item("steer", column(&|p| p.steer))?;
        columns.set_item("steer_rate", column(&|p| p.steer_rate))?;
        columns.set_item("clearance", column(&|p| Some(p.clearance)))?;
        Ok(columns)
    }

    /// The motion at given times, a list for each column.
    fn at<'py>(
        &self,
        times: PyReadonlyArray1<'_, f64>,
        py: Python<'py>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let timed = self.timed_path()?;
        let states: Vec<_> = times.as_array().iter().map(|&t_s| timed.at(t_s)).collect();
        let at = states.iter();
        let poses: Vec<_> = at
            .map(|state| timed.path().pose_at(state.s_m).wrapped())
            .collect();
        let columns = PyDict::new(py);
        let list = |values: Vec<f64>| -> Bound<'py, PyArray1<f64>> { values.into_pyarray(py) };
        columns.set_item("t", list(states.iter().map(|at| at.t_s).collect()))?;
        columns.set_item("s", list(states.iter().map(|at| at.s_m).collect()))?;
        columns.set_item("x", list(poses.iter().map(|pose| pose.x).collect()))?;
        columns.set_item("y", list(poses.iter().map(|pose| pose.y).collect()))?;
        let headings = poses.iter().map(|pose| pose.heading).collect();
        columns.set_item("heading", list(headings))?;
        let speeds = states.iter().map(|at| at.speed_mps).collect();
        columns.set_item("speed", list(speeds))?;
        let accelerations = states.iter().map(|at| at.acceleration_mps2).collect();
        columns.set_item("acceleration", list(accelerations))?;
        Ok(columns)
    }

    /// Closed stretches: obstacle, from and to in seconds, from and to in meters.
    fn regions(&self) -> Vec<Closed> {
        self.regions.clone()
    }

    /// The judge's report on a profile along the path: its own, or given phases of time, arc length,
    /// speed, acceleration, jerk and duration.
    fn judged<'py>(
        &self,
        moving: &Moving,
        limits: &Bound<'py, PyDict>,
        settings: &Bound<'py, PyDict>,
        phases: Option<Vec<[f64; 6]>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let py = limits.py();
        let config = config(&self.car.vehicle, limits, settings)?;
        let timed = match phases {
            None => self.timed_path()?,
            Some(rows) => TimedPath::new(self.curve.clone(), rows.iter().map(phase).collect()),
        };
        let question = DriveQuestion {
            predictions: &moving.predictions,
            zones: None,
            config: &config,
        };
        let vehicle = &self.car.vehicle;
        let report = py.detach(|| judge_in_time(&question.rules(vehicle), &timed));
        values::to_python(py, &report)
    }

    fn grid(&self, py: Python<'_>) -> Py<Grid> {
        self.grid.clone_ref(py)
    }

    fn car(&self, py: Python<'_>) -> PyResult<Py<Car>> {
        Py::new(py, self.car.clone())
    }

    /// Everything, as JSON, rows and handles.
    fn state(&self, py: Python<'_>) -> PyResult<State> {
        let path = serde_json::to_string(&self.path).map_err(values::broken)?;
        let scene = (self.grid(py), self.car(py)?);
        Ok((path, self.to_json()?, self.regions(), scene.0, scene.1))
    }

    /// The motion of such a state.
    #[staticmethod]
    fn of_state(
        path: &str,
        record: &str,
        regions: Vec<Closed>,
        grid: Py<Grid>,
        car: &Car,
    ) -> PyResult<Self> {
        let path = serde_json::from_str(path).map_err(errors::path)?;
        let record = serde_json::from_str(record).map_err(errors::path)?;
        Self::made(path, record, regions, (grid, car.clone()))
    }
}

/// Path and record as JSON, closed stretches, map and vehicle.
type State = (String, String, Vec<Closed>, Py<Grid>, Py<Car>);

impl Motion {
    fn made(
        path: PathDocument,
        record: MotionRecord,
        regions: Vec<Closed>,
        (grid, car): (Py<Grid>, Car),
    ) -> PyResult<Self> {
        let curve = path.curve_path();
        Ok(Self {
            curve: curve.ok_or_else(|| errors::path("the path has no segments"))?,
            path,
            record,
            regions,
            grid,
            car,
            timed: OnceLock::new(),
        })
    }

    /// The path with its times.
    pub(crate) fn timed_path(&self) -> PyResult<TimedPath> {
        let timed = self.record.timed(&self.curve);
        timed.ok_or_else(|| {
            let reason = self.reason().unwrap_or("it has no profile");
            errors::path(format!("the path is not driven: {reason}"))
        })
    }

    pub(crate) fn scene(&self, py: Python<'_>) -> (Py<Grid>, Car) {
        (self.grid(py), self.car.clone())
    }

    fn timed_poses(&self) -> &[PoseRecord] {
        let Some(timed) = self.record.timed(&self.curve) else {
            return &[];
        };
        let timed = self.timed.get_or_init(|| {
            let obstacles = self.grid.get().obstacles();
            self.path.timed(&timed, &obstacles, &self.car.vehicle)
        });
        &timed.poses
    }
}

/// The record of a drive with what was closed meanwhile, or of there being none.
fn recorded(
    drive: Result<TimedPlan, DriveError>,
    question: &DriveQuestion,
) -> Outcome<(MotionRecord, Vec<Closed>)> {
    match drive {
        Ok(plan) => {
            let regions = plan.motion.regions.iter();
            let closed = regions.map(|r| (r.obstacle, r.from_s, r.to_s, r.from_m, r.to_m));
            Ok((MotionRecord::new(question, &plan), closed.collect()))
        }
        Err(
            error @ (DriveError::Motion(MotionError::Unavoidable { .. }) | DriveError::Refused(_)),
        ) => {
            let reason = Some(error.to_string());
            Ok((MotionRecord::refused(question, reason), Vec::new()))
        }
        Err(error) => Err(error.into()),
    }
}

/// A phase of a row: time, arc length, speed, acceleration, jerk and duration.
fn phase(
    &[
        t_s,
        s_m,
        speed_mps,
        acceleration_mps2,
        jerk_mps3,
        duration_s,
    ]: &[f64; 6],
) -> Phase {
    Phase {
        t_s,
        s_m,
        speed_mps,
        acceleration_mps2,
        jerk_mps3,
        duration_s,
    }
}

/// Limits and settings; what is left out is that of the vehicle, as on the command line.
fn config(
    vehicle: &Vehicle,
    limits: &Bound<'_, PyDict>,
    settings: &Bound<'_, PyDict>,
) -> PyResult<MotionConfig> {
    let mut members = serde_json::to_value(usual_limits(vehicle)).map_err(values::broken)?;
    let given = values::to_json(limits, "limits", errors::config)?;
    if let (Value::Object(members), Value::Object(given)) = (&mut members, given) {
        members.extend(given);
    }
    let limits: SpeedLimits = values::document(members, "limits", errors::config)?;
    let rest = values::to_json(settings, "settings", errors::config)?;
    let rest: MotionConfig = values::document(rest, "settings", errors::config)?;
    let config = MotionConfig { limits, ..rest };
    config.check().map_err(errors::config)?;
    Ok(config)
}

/// The limits of a vehicle, also of one that does not say how fast it drives.
fn usual_limits(vehicle: &Vehicle) -> SpeedLimits {
    SpeedLimits::of(vehicle).unwrap_or_else(|| {
        let (own, usual) = (vehicle.parameters(), SpeedLimits::default());
        SpeedLimits {
            max_acceleration_mps2: own
                .max_acceleration_mps2
                .unwrap_or(usual.max_acceleration_mps2),
            max_steer_rate_rad_per_s: own.max_steer_rate_rad_per_s,
            ..usual
        }
    })
}
