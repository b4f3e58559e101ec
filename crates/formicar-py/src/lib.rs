//! The compiled part of the Python package: maps, vehicles, planners and plans as Python classes
//! without manners. The Python sources in `python/formicar` wrap them into the classes that users
//! see, with docstrings and types; all that is computed is computed by the library.
#![forbid(unsafe_code)]

mod bees;
mod campaign;
mod cells;
mod curves;
mod drive;
mod errors;
mod grid;
mod lidar_log;
mod localizer;
mod mapper;
mod motion;
mod observe;
mod path;
mod pictures;
mod plan;
mod planner;
mod scenarios;
mod values;
mod vehicle;

use formicar::map::builtin;
use pyo3::prelude::*;
use pyo3::types::PyAny;

/// All built-in maps: name and description.
#[pyfunction]
fn builtin_maps() -> Vec<(&'static str, &'static str)> {
    let maps = builtin::all().iter();
    maps.map(|map| (map.name, map.about)).collect()
}

/// Every parameter that a configuration may have.
#[pyfunction]
fn parameters(py: Python<'_>) -> PyResult<Vec<Bound<'_, PyAny>>> {
    let parameters = formicar::PlannerConfig::parameters().into_iter();
    let member = |parameter: formicar::parameters::Parameter| {
        let range = parameter.range.as_ref().map(ToString::to_string);
        let document = serde_json::json!({
            "key": parameter.key,
            "about": parameter.about,
            "unit": parameter.unit,
            "range": range,
            "words": parameter.words,
            "default": parameter.default,
        });
        values::from_json(py, &document)
    };
    parameters.map(member).collect()
}

/// The compiled module.
#[pymodule]
mod _formicar {
    #[pymodule_export]
    use crate::bees::Bees;
    #[pymodule_export]
    use crate::builtin_maps;
    #[pymodule_export]
    use crate::campaign::{CampaignStore, carry_out_parcel, machine};
    #[pymodule_export]
    use crate::curves::{BoundedCurve, curve_lengths};
    #[pymodule_export]
    use crate::drive::Drive;
    #[pymodule_export]
    use crate::errors::{
        ConfigError, InvalidLog, InvalidMap, InvalidObstacle, InvalidPath, InvalidRequest,
        InvalidVehicle,
    };
    #[pymodule_export]
    use crate::grid::Grid;
    #[pymodule_export]
    use crate::lidar_log::LidarLog;
    #[pymodule_export]
    use crate::localizer::MapLocalizer;
    #[pymodule_export]
    use crate::mapper::{LidarMap, LidarMapper};
    #[pymodule_export]
    use crate::motion::{Motion, Moving};
    #[pymodule_export]
    use crate::parameters;
    #[pymodule_export]
    use crate::path::Track;
    #[pymodule_export]
    use crate::pictures::{grid_svg, vehicle_svg};
    #[pymodule_export]
    use crate::plan::Plan;
    #[pymodule_export]
    use crate::planner::{Planner, config_keys, planners, read_config};
    #[pymodule_export]
    use crate::scenarios::load_scenarios;
    #[pymodule_export]
    use crate::vehicle::{Car, vehicle_keys};

    /// Version of the package.
    #[pymodule_export]
    #[allow(non_upper_case_globals, reason = "the name that Python expects")]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}
