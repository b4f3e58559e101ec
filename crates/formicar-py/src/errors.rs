//! Exceptions, and which error of the library becomes which of them.

use formicar::map::MapError;
use formicar::map::format::FormatError;
use formicar::motion::MotionError;
use formicar::planner::{DriveError, PlanError};
use formicar::scenario::{MovingError, ScenarioError};
use formicar::tracking::TrackingError;
use formicar::tuning::TuningError;
use formicar::vehicle::VehicleError;
use formicar_mapping::MappingError;
use pyo3::create_exception;
use pyo3::exceptions::{PyFileNotFoundError, PyValueError};
use pyo3::prelude::*;
use std::fmt::Display;
use std::path::Path;

create_exception!(
    formicar,
    InvalidRequest,
    PyValueError,
    "A request that cannot be asked on its map: the message names thing, value, limit and hint."
);
create_exception!(
    formicar,
    ConfigError,
    PyValueError,
    "A parameter that does not exist, is of another type, or lies outside its range."
);
create_exception!(
    formicar,
    InvalidMap,
    PyValueError,
    "Cells, a resolution, an origin or a file that make no map."
);
create_exception!(
    formicar,
    InvalidVehicle,
    PyValueError,
    "Measures that make no vehicle."
);
create_exception!(
    formicar,
    InvalidPath,
    PyValueError,
    "Samples or a document that make no path."
);

create_exception!(
    formicar,
    InvalidLog,
    PyValueError,
    "Scans, odometry, a log, a bag or a session that make no map."
);

create_exception!(
    formicar,
    InvalidObstacle,
    PyValueError,
    "A shape, a motion, a horizon or a document that make no moving obstacles."
);

/// A request that cannot be asked.
pub(crate) fn invalid_request(message: impl Display) -> PyErr {
    InvalidRequest::new_err(message.to_string())
}

/// Parameters that cannot be; the chain of causes in one line.
pub(crate) fn config(error: impl Display) -> PyErr {
    ConfigError::new_err(format!("{error:#}"))
}

/// A map that cannot be.
pub(crate) fn map(error: impl Display) -> PyErr {
    InvalidMap::new_err(error.to_string())
}

/// A vehicle that cannot be.
pub(crate) fn vehicle(error: impl Display) -> PyErr {
    InvalidVehicle::new_err(format!("{error:#}"))
}

/// A path that cannot be.
pub(crate) fn path(error: impl Display) -> PyErr {
    InvalidPath::new_err(error.to_string())
}

/// A moving obstacle that cannot be.
pub(crate) fn obstacle(message: String) -> PyErr {
    InvalidObstacle::new_err(message)
}

/// A log that cannot be; the chain of causes in one line.
pub(crate) fn log(error: impl Display) -> PyErr {
    InvalidLog::new_err(format!("{error:#}"))
}

/// The exception for a file: one that is not there is told apart, as everywhere in Python.
pub(crate) fn file(at: &Path, error: PyErr) -> PyErr {
    if at.exists() {
        return error;
    }
    Python::attach(|py| PyFileNotFoundError::new_err(error.value(py).to_string()))
}

/// What a query was refused for.
pub(crate) fn plan(error: &PlanError) -> PyErr {
    match error {
        PlanError::Config(_) => ConfigError::new_err(error.to_string()),
        PlanError::Map(error) => map(error),
        PlanError::Vehicle(error) => vehicle(error),
        _ => invalid_request(error),
    }
}

/// Errors of the library that `?` turns into exceptions.
pub(crate) struct Failed(PyErr);

impl From<Failed> for PyErr {
    fn from(failed: Failed) -> Self {
        failed.0
    }
}

impl From<PyErr> for Failed {
    fn from(error: PyErr) -> Self {
        Self(error)
    }
}

impl From<MapError> for Failed {
    fn from(error: MapError) -> Self {
        Self(map(error))
    }
}

impl From<FormatError> for Failed {
    fn from(error: FormatError) -> Self {
        Self(map(error))
    }
}

impl From<VehicleError> for Failed {
    fn from(error: VehicleError) -> Self {
        Self(vehicle(error))
    }
}

impl From<ScenarioError> for Failed {
    fn from(error: ScenarioError) -> Self {
        Self(invalid_request(error))
    }
}

impl From<PlanError> for Failed {
    fn from(error: PlanError) -> Self {
        Self(plan(&error))
    }
}

impl From<TrackingError> for Failed {
    fn from(error: TrackingError) -> Self {
        Self(match error {
            TrackingError::OutOfRange(_) => config(error),
            TrackingError::NeedsACar | TrackingError::NeedsAWheelbase => vehicle(error),
            _ => path(error),
        })
    }
}

impl From<MovingError> for Failed {
    fn from(error: MovingError) -> Self {
        Self(match error {
            MovingError::OffTheMap { .. } | MovingError::InsideTheVehicle { .. } => {
                invalid_request(error)
            }
            _ => obstacle(error.to_string()),
        })
    }
}

impl From<MotionError> for Failed {
    fn from(error: MotionError) -> Self {
        Self(config(error))
    }
}

impl From<DriveError> for Failed {
    fn from(error: DriveError) -> Self {
        match error {
            DriveError::Moving(error) => error.into(),
            DriveError::Motion(error) => error.into(),
            _ => Self(path(error)),
        }
    }
}

impl From<MappingError> for Failed {
    fn from(error: MappingError) -> Self {
        Self(match error {
            MappingError::Parameter { .. } | MappingError::RangeLimits { .. } => config(error),
            _ => log(error),
        })
    }
}

impl From<TuningError> for Failed {
    fn from(error: TuningError) -> Self {
        Self(config(error))
    }
}

/// The result of what Python calls.
pub(crate) type Outcome<T> = Result<T, Failed>;
