//! Occupancy grids: from arrays, files and the library, and back.

use crate::cells::{Meaning, cells_of};
use crate::errors::{self, Outcome};
use crate::values;
use formicar::collision::ObstacleMap;
use formicar::geometry::{Point2, Pose2};
use formicar::map::builtin::BuiltinMap;
use formicar::map::format::{FormatError, MapFile, ReadOptions, write_map};
use formicar::map::{
    Cell, DistanceField, GridFrame, OCCUPIED, OccupancyGrid, UNKNOWN, UnknownPolicy,
};
use formicar::planner::MapRecord;
use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray2, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

/// The largest yaw of an origin: a turn, rounded up, as in files. A larger one is in degrees.
const MAX_YAW_RAD: f64 = std::f64::consts::TAU + 1e-4;

/// A map, and where it comes from.
#[pyclass(frozen, module = "formicar._formicar")]
#[derive(Debug)]
pub(crate) struct Grid {
    pub(crate) map: Arc<OccupancyGrid>,
    pub(crate) record: MapRecord,
    /// Prepared once it is asked for.
    obstacles: OnceLock<Arc<ObstacleMap>>,
}

impl Grid {
    pub(crate) fn new(map: OccupancyGrid, record: MapRecord) -> Self {
        Self {
            map: Arc::new(map),
            record,
            obstacles: OnceLock::new(),
        }
    }

    /// A map under a name, whose unknown cells stop a vehicle.
    pub(crate) fn named(map: OccupancyGrid, name: &str) -> Self {
        let record = MapRecord {
            name: name.to_owned(),
            unknown: "occupied".to_owned(),
            ..MapRecord::default()
        };
        Self::new(map, record)
    }

    /// The map of a file, with doubts about it.
    pub(crate) fn of_file(file: MapFile, name: &str) -> Self {
        let mut grid = Self::named(file.grid, name);
        grid.record.warnings = file.warnings.iter().map(ToString::to_string).collect();
        grid
    }

    /// The map as judge and planners take it.
    pub(crate) fn obstacles(&self) -> Arc<ObstacleMap> {
        let prepared = self
            .obstacles
            .get_or_init(|| Arc::new(ObstacleMap::new(&self.map)));
        prepared.clone()
    }
}

#[pymethods]
impl Grid {
    /// A grid from an array, row 0 at the bottom unless `image_order`.
    #[staticmethod]
    fn of_array(
        data: &Bound<'_, PyUntypedArray>,
        resolution_m: f64,
        origin: [f64; 3],
        values: &str,
        image_order: bool,
    ) -> Outcome<Self> {
        let meaning = match values {
            "occupancy" => Meaning::Occupancy,
            "costmap" => Meaning::Costs,
            "grey" | "gray" => Meaning::Grey,
            other => {
                return Err(errors::map(format!(
                    "values = {other:?}; expected \"occupancy\", \"costmap\" or \"grey\""
                ))
                .into());
            }
        };
        if data.ndim() != 2 {
            let (shape, n) = (shape_in_words(data.shape()), data.ndim());
            return Err(errors::map(format!(
                "the map's array has {n} dimensions, shape {shape}; expected 2: rows and columns"
            ))
            .into());
        }
        let [x, y, yaw] = origin;
        if yaw.is_finite() && yaw.abs() > MAX_YAW_RAD {
            return Err(errors::map(format!(
                "the origin's yaw is {yaw}; it must be in radians, within a turn; hint: {yaw} degrees are {:.4}",
                yaw.to_radians()
            ))
            .into());
        }
        // Sizes are refused before anything is copied.
        let (n_rows, n_cols) = (data.shape()[0], data.shape()[1]);
        let frame = GridFrame::new(n_cols, n_rows, resolution_m, Pose2::new(x, y, yaw))?;
        let cells = cells_of(data, meaning, image_order, &frame)?;
        Ok(Self::named(OccupancyGrid::new(frame, cells)?, "array"))
    }

    /// A grid from a map file.
    #[staticmethod]
    fn load(
        path: PathBuf,
        resolution_m: Option<f64>,
        unknown_grey: Option<u8>,
        py: Python<'_>,
    ) -> Outcome<Self> {
        let options = ReadOptions {
            resolution_m,
            unknown_grey,
        };
        let read = py.detach(|| MapFile::read(&path, &options));
        let file = read.map_err(|error| errors::file(&path, errors::map(error)))?;
        Ok(Self::of_file(file, &path.display().to_string()))
    }

    /// A built-in map.
    #[staticmethod]
    fn builtin(name: &str) -> PyResult<Self> {
        let builtin = BuiltinMap::by_name(name).map_err(errors::map)?;
        Ok(Self::named(builtin.grid(), name))
    }

    /// Rows and columns.
    #[getter]
    fn shape(&self) -> (usize, usize) {
        let frame = self.map.frame();
        (frame.n_rows(), frame.n_cols())
    }

    #[getter]
    fn resolution_m(&self) -> f64 {
        self.map.frame().resolution_m()
    }

    #[getter]
    fn origin(&self) -> (f64, f64, f64) {
        let Pose2 { x, y, heading } = self.map.frame().origin();
        (x, y, heading)
    }

    #[getter]
    fn name(&self) -> &str {
        &self.record.name
    }

    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.record.warnings.clone()
    }

    /// The hash that certificates hold.
    #[getter]
    fn hash(&self) -> String {
        format!("{:032x}", self.obstacles().hash())
    }

    /// The values, row 0 at the bottom: a copy.
    fn values<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<i8>>> {
        let cells = Array2::from_shape_vec(self.shape(), self.map.values().to_vec());
        Ok(cells.map_err(values::broken)?.into_pyarray(py))
    }

    /// Distance from each cell's center to that of the nearest lethal cell, meters.
    fn distance_field<'py>(
        &self,
        max_distance_m: Option<f64>,
        py: Python<'py>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let resolution_m = self.resolution_m();
        let most_cells = DistanceField::MAX_TRUNCATION_CELLS;
        let n_cells = match max_distance_m {
            None => most_cells,
            Some(distance_m) if distance_m > 0.0 => {
                let cells = (distance_m / resolution_m).ceil();
                if cells > f64::from(most_cells) {
                    let most_m = f64::from(most_cells) * resolution_m;
                    return Err(errors::map(format!(
                        "max_distance = {distance_m} m; it must be at most {most_m} m, {most_cells} cells"
                    )));
                }
                cells as u32
            }
            Some(distance_m) => {
                return Err(errors::map(format!(
                    "max_distance = {distance_m} m; it must be above 0"
                )));
            }
        };
        let distances = py.detach(|| {
            let field = DistanceField::new(&self.map.lethal_cells(), n_cells);
            let squared = field.values();
            let meters = squared.map(|squared| f64::from(squared).sqrt() * resolution_m);
            meters.collect::<Vec<_>>()
        });
        let field = Array2::from_shape_vec(self.shape(), distances).map_err(values::broken)?;
        Ok(field.into_pyarray(py))
    }

    /// The same map with unknown cells decided.
    fn with_unknown(&self, policy: &str) -> PyResult<Self> {
        let (name, policy) = match policy {
            "free" => ("free", UnknownPolicy::Free),
            "occupied" => ("occupied", UnknownPolicy::Occupied),
            other => {
                return Err(errors::map(format!(
                    "unknown = {other:?}; expected \"free\" or \"occupied\""
                )));
            }
        };
        let mut record = self.record.clone();
        name.clone_into(&mut record.unknown);
        Ok(Self::new((*self.map).clone().with_unknown(policy), record))
    }

    /// The same map with areas closed.
    pub(crate) fn with_keep_out(&self, areas: Vec<Vec<[f64; 2]>>) -> PyResult<Self> {
        let mut map = (*self.map).clone();
        for (i, area) in areas.iter().enumerate() {
            check_area(i, area)?;
            let corners: Vec<_> = area.iter().map(|&[x, y]| Point2::new(x, y)).collect();
            map.fill_polygon(&corners, OCCUPIED);
        }
        let mut record = self.record.clone();
        record.keep_out.extend(areas);
        Ok(Self::new(map, record))
    }

    /// Writes the map in the format that the name's ending tells.
    fn save(&self, path: PathBuf, py: Python<'_>) -> Outcome<()> {
        let map = self.map.clone();
        py.detach(|| write_map(&path, &map))
            .map_err(|error| save_error(&path, &error))?;
        Ok(())
    }

    /// Number of unknown, free, graded and occupied cells.
    fn counts(&self) -> [usize; 4] {
        let mut counts = [0; 4];
        for &value in self.map.values() {
            counts[match value {
                UNKNOWN => 0,
                0 => 1,
                OCCUPIED => 3,
                _ => 2,
            }] += 1;
        }
        counts
    }

    /// The cell under a world point, as column and row.
    fn cell_at(&self, x: f64, y: f64) -> Option<(u32, u32)> {
        let cell = self.map.frame().cell_at(Point2::new(x, y));
        cell.map(|cell| (cell.col, cell.row))
    }

    /// The world point at the center of a cell.
    fn center(&self, col: u32, row: u32) -> PyResult<(f64, f64)> {
        let frame = self.map.frame();
        if col as usize >= frame.n_cols() || row as usize >= frame.n_rows() {
            let (n_cols, n_rows) = (frame.n_cols(), frame.n_rows());
            return Err(errors::map(format!(
                "cell ({col}, {row}): the map has {n_cols} x {n_rows} cells"
            )));
        }
        let Point2 { x, y } = frame.center(Cell::new(col, row));
        Ok((x, y))
    }

    /// The requests of a built-in map: name, start and goal of each.
    fn requests(&self) -> Vec<(&'static str, [f64; 3], [f64; 3])> {
        let list = |pose: Pose2| [pose.x, pose.y, pose.heading];
        let builtin = BuiltinMap::by_name(&self.record.name).ok();
        let requests = builtin.into_iter().flat_map(|map| map.requests);
        requests
            .map(|r| (r.id, list(r.start), list(r.goal)))
            .collect()
    }

    /// The vehicle of a built-in map.
    fn own_vehicle(&self) -> Option<&'static str> {
        let builtin = BuiltinMap::by_name(&self.record.name).ok();
        builtin.map(|map| map.vehicle)
    }

    fn same_as(&self, other: &Self) -> bool {
        self.map == other.map
    }

    /// Everything, as bytes.
    fn state<'py>(&self, py: Python<'py>) -> PyResult<(String, Bound<'py, PyBytes>)> {
        let record = serde_json::to_string(&self.full_record()).map_err(values::broken)?;
        let cells: Vec<u8> = self
            .map
            .values()
            .iter()
            .map(|&v| v.cast_unsigned())
            .collect();
        Ok((record, PyBytes::new(py, &cells)))
    }

    /// The grid of such a state.
    #[staticmethod]
    fn of_state(record: &str, cells: &[u8]) -> Outcome<Self> {
        Self::of_parts(record, cells)
    }
}

impl Grid {
    /// The record with size and place of the map.
    pub(crate) fn full_record(&self) -> MapRecord {
        self.record.on(self.map.frame())
    }

    /// The grid of a record and its cells.
    pub(crate) fn of_parts(record: &str, cells: &[u8]) -> Outcome<Self> {
        let record: MapRecord = serde_json::from_str(record).map_err(errors::map)?;
        let [x, y, yaw] = record.origin;
        let origin = Pose2::new(x, y, yaw);
        let frame = GridFrame::new(record.n_cols, record.n_rows, record.resolution_m, origin)?;
        let cells = cells.iter().map(|value| value.cast_signed()).collect();
        Ok(Self::new(OccupancyGrid::new(frame, cells)?, record))
    }
}

/// Refuses an area that has no inside, or corners that are no points.
fn check_area(i: usize, area: &[[f64; 2]]) -> PyResult<()> {
    if area.len() < 3 {
        let n = area.len();
        return Err(errors::invalid_request(format!(
            "keep_out[{i}] has {n} corners; a polygon has at least 3, for instance [(0, 0), (2, 0), (2, 1)]"
        )));
    }
    match area.iter().flatten().find(|value| !value.is_finite()) {
        Some(value) => Err(errors::invalid_request(format!(
            "keep_out[{i}] is not finite: {value}"
        ))),
        None => Ok(()),
    }
}

fn save_error(path: &Path, error: &FormatError) -> PyErr {
    let error = errors::map(error);
    match path.parent().filter(|folder| *folder != Path::new("")) {
        Some(folder) => errors::file(folder, error),
        None => error,
    }
}

fn shape_in_words(shape: &[usize]) -> String {
    let sizes: Vec<_> = shape.iter().map(ToString::to_string).collect();
    format!("({})", sizes.join(", "))
}
