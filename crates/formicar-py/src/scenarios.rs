//! Scenario files: a map, a vehicle, a start and a goal by name.

use crate::errors::{self, Outcome};
use crate::grid::Grid;
use crate::vehicle::Car;
use formicar::geometry::Pose2;
use formicar::map::format::{MapFile, ReadOptions, TpcapCase, read_car_scenarios};
use formicar::planner::MapRecord;
use formicar::vehicle::Vehicle;
use pyo3::prelude::*;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Cell size of a TPCAP case where none is given, meters; as on the command line.
const TPCAP_RESOLUTION_M: f64 = 0.1;

/// Name, map, vehicle, start and goal.
type Scenario = (String, Py<Grid>, Car, [f64; 3], [f64; 3]);

/// The scenarios of a file: car scenarios (.json) or a TPCAP case (.csv).
#[pyfunction]
#[pyo3(signature = (path, resolution_m=None))]
pub(crate) fn load_scenarios(
    path: PathBuf,
    resolution_m: Option<f64>,
    py: Python<'_>,
) -> PyResult<Vec<Scenario>> {
    let ending = path.extension().unwrap_or_default().to_ascii_lowercase();
    let read = match ending.to_str() {
        Some("json") => cars(&path, resolution_m, py),
        Some("csv") => tpcap(&path, resolution_m, py).map(|case| vec![case]),
        _ => {
            let name = path.display();
            return Err(errors::map(format!(
                "{name}: a scenario file is .json (car scenarios) or .csv (a TPCAP case)"
            )));
        }
    };
    read.map_err(|error| errors::file(&path, error.into()))
}

fn numbers(pose: Pose2) -> [f64; 3] {
    [pose.x, pose.y, pose.heading]
}

/// Car scenarios; those on one map share it.
fn cars(path: &Path, resolution_m: Option<f64>, py: Python<'_>) -> Outcome<Vec<Scenario>> {
    let options = ReadOptions {
        resolution_m,
        ..ReadOptions::default()
    };
    let mut maps: BTreeMap<PathBuf, Py<Grid>> = BTreeMap::new();
    let mut scenarios = Vec::new();
    for scenario in read_car_scenarios(path)? {
        if !maps.contains_key(&scenario.map) {
            let file = MapFile::read(&scenario.map, &options)?;
            let name = scenario.map.display().to_string();
            let map = Py::new(py, Grid::of_file(file, &name))?;
            maps.insert(scenario.map.clone(), map);
        }
        let map = maps[&scenario.map].clone_ref(py);
        let car = Car {
            vehicle: Vehicle::new(scenario.vehicle.clone())?,
            name: scenario.id.clone(),
        };
        let ends = [scenario.start, scenario.goal].map(numbers);
        scenarios.push((scenario.id, map, car, ends[0], ends[1]));
    }
    Ok(scenarios)
}

fn tpcap(path: &Path, resolution_m: Option<f64>, py: Python<'_>) -> Outcome<Scenario> {
    let case = TpcapCase::read(path)?;
    let map = case.rasterize(resolution_m.unwrap_or(TPCAP_RESOLUTION_M))?;
    let record = MapRecord {
        name: path.display().to_string(),
        unknown: "occupied".to_owned(),
        ..MapRecord::default()
    };
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    let car = Car {
        vehicle: Vehicle::tpcap(),
        name: "tpcap".to_owned(),
    };
    let map = Py::new(py, Grid::new(map, record))?;
    Ok((
        name.into_owned(),
        map,
        car,
        numbers(case.start),
        numbers(case.goal),
    ))
}
