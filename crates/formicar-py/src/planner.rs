//! The one door: a prepared planner, asked as often as one likes, from any thread.

use crate::errors::{self, Outcome};
use crate::grid::Grid;
use crate::observe::Watch;
use crate::plan::{Asked, Plan};
use crate::values;
use crate::vehicle::Car;
use formicar::layers::SoftCosts;
use formicar::map::{Cell, CellRegion, OccupancyGrid, UNKNOWN};
use formicar::numeric::Seed;
use formicar::path::CurvePath;
use formicar::planner::{
    PlanError, PlannerConfig, PlannerName, RequestDocument, SoftCostsRecord, Timing,
};
use formicar::progress::{AntFrames, CancelToken};
use formicar::scenario::{Request, ScenarioError};
use formicar_cli::reading;
use numpy::{PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::{Map, Value};
use std::path::PathBuf;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::{self, ThreadId};
use std::time::Instant;

/// A planner with its map.
#[derive(Clone, Debug)]
struct Prepared {
    planner: formicar::Planner,
    map: Arc<OccupancyGrid>,
}

/// A planner, its map and vehicle.
#[pyclass(frozen, module = "formicar._formicar")]
pub(crate) struct Planner {
    grid: Py<Grid>,
    car: Car,
    config: PlannerConfig,
    n_threads: usize,
    map_setup_s: f64,
    prepared: Mutex<Prepared>,
    /// The thread that plans, which cannot plan a second time meanwhile.
    busy: Mutex<Option<ThreadId>>,
    /// One for each query that is under way or waits, with its number.
    tokens: Mutex<Vec<(u64, CancelToken)>>,
    n_queries: AtomicU64,
}

/// What a query is asked for besides its request.
#[derive(FromPyObject)]
pub(crate) struct Manner {
    seed: u64,
    listener: Option<Py<PyAny>>,
    keeps_ants: bool,
    keep_out: Option<Vec<Vec<[f64; 2]>>>,
    soft_weight: f64,
}

/// Locks what no panic leaves half changed.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[pymethods]
impl Planner {
    #[new]
    fn new(
        grid: Py<Grid>,
        car: Py<Car>,
        tables: Vec<Bound<'_, PyDict>>,
        n_threads: usize,
        py: Python<'_>,
    ) -> Outcome<Self> {
        let car = car.get().clone();
        let config = config_of(&tables, &car)?;
        let begun = Instant::now();
        let map = grid.get().map.clone();
        let planner = py.detach(|| {
            let obstacles = grid.get().obstacles();
            formicar::Planner::on(obstacles, car.vehicle.clone(), config.clone())
        })?;
        Ok(Self {
            grid,
            car,
            config,
            n_threads,
            map_setup_s: begun.elapsed().as_secs_f64(),
            prepared: Mutex::new(Prepared {
                planner: planner.with_threads(n_threads),
                map,
            }),
            busy: Mutex::default(),
            tokens: Mutex::default(),
            n_queries: AtomicU64::default(),
        })
    }

    /// The planner's word.
    #[getter]
    fn name(&self) -> &'static str {
        self.config.planner().name()
    }

    #[getter]
    fn n_threads(&self) -> usize {
        self.n_threads
    }

    /// Every parameter.
    fn config<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        values::to_python(py, &self.config)
    }

    /// The map as it is now.
    fn grid(&self, py: Python<'_>) -> PyResult<Py<Grid>> {
        let map = py.detach(|| lock(&self.prepared).map.clone());
        if Arc::ptr_eq(&map, &self.grid.get().map) {
            return Ok(self.grid.clone_ref(py));
        }
        let record = self.grid.get().record.clone();
        Py::new(py, Grid::new((*map).clone(), record))
    }

    fn car(&self, py: Python<'_>) -> PyResult<Py<Car>> {
        Py::new(py, self.car.clone())
    }

    /// Plans a request, or plans it again from what is left of a path.
    #[pyo3(signature = (request, manner, soft_costs=None, previous=None))]
    fn plan(
        &self,
        request: &Bound<'_, PyDict>,
        manner: Manner,
        soft_costs: Option<PyReadonlyArray2<'_, f64>>,
        previous: Option<&Plan>,
    ) -> Outcome<Plan> {
        let py = request.py();
        let request = request_of(request)?;
        let costs = soft_costs.map(|costs| (costs, manner.soft_weight));
        let costs = costs.map(|costs| self.soft_costs(&costs)).transpose()?;
        let closed = match manner.keep_out {
            Some(areas) if !areas.is_empty() => {
                let grid = self.grid(py)?;
                Some(py.detach(|| grid.get().with_keep_out(areas))?)
            }
            _ => None,
        };
        let frame = self.grid.get().map.frame();
        let frames = manner
            .keeps_ants
            .then(|| AntFrames::new(frame.n_cols(), frame.n_rows()));
        let token = CancelToken::new();
        let mut query = Query {
            request,
            seed: Seed(manner.seed),
            previous: previous.map(Plan::path).transpose()?,
            costs,
            closed,
            watch: Watch::new(token.clone(), manner.listener, frames),
        };
        if *lock(&self.busy) == Some(thread::current().id()) {
            return Err(PyRuntimeError::new_err(
                "this planner is planning on this thread; hint: a planner of its own for each nested plan",
            )
            .into());
        }
        let number = self.n_queries.fetch_add(1, Ordering::Relaxed);
        lock(&self.tokens).push((number, token));
        let plan = py.detach(|| self.carry_out(&mut query));
        lock(&self.tokens).retain(|(other, _)| *other != number);
        match query.watch.raised.take() {
            Some(error) => Err(error.into()),
            None => plan,
        }
    }

    /// Cancels every query that is under way or waits, from any thread.
    fn cancel(&self) {
        lock(&self.tokens)
            .iter()
            .for_each(|(_, token)| token.cancel());
    }

    /// Puts new values into a rectangle of cells.
    fn update_map(&self, patch: PyRef<'_, Grid>, col: u32, row: u32) -> Outcome<()> {
        let (py, patch) = (patch.py(), patch.map.clone());
        let frame = patch.frame();
        let region = CellRegion::new(Cell::new(col, row), frame.n_cols(), frame.n_rows());
        py.detach(|| {
            let mut prepared = lock(&self.prepared);
            prepared.planner.update_map(region, patch.values())?;
            Arc::make_mut(&mut prepared.map).replace(&region, patch.values())?;
            Ok(())
        })
    }
}

/// A query and everything that belongs to it.
struct Query {
    request: Request,
    seed: Seed,
    previous: Option<CurvePath>,
    costs: Option<SoftCosts>,
    closed: Option<Grid>,
    watch: Watch,
}

impl Planner {
    fn soft_costs(&self, (costs, weight): &(PyReadonlyArray2<'_, f64>, f64)) -> Outcome<SoftCosts> {
        let name = self.config.planner();
        if !name.heeds_soft_costs() {
            return Err(errors::invalid_request(format!(
                "soft_costs: {} does not use soft costs; hint: planner=\"formicar\"",
                name.name()
            ))
            .into());
        }
        let frame = *self.grid.get().map.frame();
        let (n_rows, n_cols) = (costs.shape()[0], costs.shape()[1]);
        if (n_rows, n_cols) != (frame.n_rows(), frame.n_cols()) {
            return Err(errors::invalid_request(format!(
                "soft_costs has shape ({n_rows}, {n_cols}), the map ({}, {}); hint: one value from 0 (indifferent) to 1 (unwanted) for each cell",
                frame.n_rows(),
                frame.n_cols()
            ))
            .into());
        }
        let values = costs.as_array().iter().map(|&value| value as f32).collect();
        let costs = SoftCosts::new(frame, values, *weight).map_err(errors::invalid_request)?;
        Ok(costs)
    }

    /// Plans, without the interpreter's lock.
    fn carry_out(&self, query: &mut Query) -> Outcome<Plan> {
        let mut prepared = lock(&self.prepared);
        *lock(&self.busy) = Some(thread::current().id());
        let asked = self.ask(&mut prepared, query);
        *lock(&self.busy) = None;
        asked
    }

    fn ask(&self, prepared: &mut Prepared, query: &mut Query) -> Outcome<Plan> {
        let mut other = self.variant(prepared, query)?;
        let Prepared { planner, map } = other.as_mut().unwrap_or(prepared);
        query.watch.clock = formicar::StdClock::start();
        let watch = &mut query.watch;
        let outcome = match &query.previous {
            Some(previous) => planner.replan(&query.request, previous, query.seed, watch),
            None => planner.plan(&query.request, query.seed, watch),
        };
        let outcome = outcome.map_err(|error| refused(&error, map))?;
        let clock = query.watch.clock;
        let grid = query.closed.as_ref().unwrap_or(self.grid.get());
        let mut record = grid.record.clone();
        record.soft_costs = query.costs.as_ref().map(|costs| SoftCostsRecord {
            name: "array".to_owned(),
            weight: costs.weight(),
        });
        let query_s = clock.now().as_secs_f64();
        let frames = query.watch.frames.take();
        let asked = Asked {
            obstacles: planner.obstacles().clone(),
            map: map.clone(),
            record,
            car: self.car.clone(),
            config: self.config.clone(),
            request: query.request.clone(),
            seed: query.seed,
            timing: Timing {
                map_setup_s: self.map_setup_s,
                first_feasible_s: clock.first_path().map(|time| time.as_secs_f64()),
                query_s,
                total_s: self.map_setup_s + query_s,
            },
        };
        let improvements = std::mem::take(&mut query.watch.improvements);
        Ok(Plan::new(asked, outcome, improvements, frames))
    }

    /// The planner for a query with areas or costs of its own.
    fn variant(&self, prepared: &Prepared, query: &Query) -> Outcome<Option<Prepared>> {
        let mut other = match &query.closed {
            Some(closed) => Prepared {
                planner: formicar::Planner::on(
                    closed.obstacles(),
                    self.car.vehicle.clone(),
                    self.config.clone(),
                )?
                .with_threads(self.n_threads),
                map: closed.map.clone(),
            },
            None if query.costs.is_some() => prepared.clone(),
            None => return Ok(None),
        };
        if let Some(costs) = &query.costs {
            other.planner = other.planner.with_soft_costs(costs);
        }
        Ok(Some(other))
    }
}

/// The exception for a query that cannot be asked; where the vehicle stands on unknown ground, how
/// to drive there.
fn refused(error: &PlanError, map: &OccupancyGrid) -> PyErr {
    let plain = errors::plan(error);
    let PlanError::Scenario(ScenarioError::Occupied { cells, .. }) = error else {
        return plain;
    };
    let unknown = cells.iter().filter(|&&cell| map.value(cell) == UNKNOWN);
    match unknown.count() {
        0 => plain,
        n => errors::invalid_request(format!(
            "{error}; {n} of these cells are unknown: map.with_unknown(\"free\") drives on them"
        )),
    }
}

/// The request of a document of Python.
fn request_of(request: &Bound<'_, PyDict>) -> Outcome<Request> {
    let document = values::to_json(request, "request", errors::invalid_request)?;
    let document: RequestDocument = values::document(document, "request", errors::invalid_request)?;
    Ok(document.onto(&RequestDocument::default())?)
}

/// The parameters of dicts, whose keys may be dotted; those of a later one count.
fn config_of(tables: &[Bound<'_, PyDict>], car: &Car) -> PyResult<PlannerConfig> {
    let mut nested = Map::new();
    for table in tables {
        if let Value::Object(members) = values::to_json(table, "config", errors::config)? {
            for (key, value) in members {
                put(&mut nested, &key, value)?;
            }
        }
    }
    let table = toml::Table::try_from(without_nulls(nested)).map_err(errors::config)?;
    reading::planner_config(table, car.vehicle.motion()).map_err(errors::config)
}

/// Sets a dotted key.
fn put(table: &mut Map<String, Value>, key: &str, value: Value) -> PyResult<()> {
    let Some((section, rest)) = key.split_once('.') else {
        match (table.get_mut(key), value) {
            (Some(Value::Object(known)), Value::Object(more)) => {
                for (key, value) in more {
                    put(known, &key, value)?;
                }
            }
            (_, value) => drop(table.insert(key.to_owned(), value)),
        }
        return Ok(());
    };
    let inner = table
        .entry(section)
        .or_insert_with(|| Value::Object(Map::new()));
    match inner {
        Value::Object(inner) => put(inner, rest, value),
        other => Err(errors::config(format!(
            "{section} = {other}: it is no table"
        ))),
    }
}

/// TOML has no null: a parameter that is none is left out.
fn without_nulls(table: Map<String, Value>) -> Map<String, Value> {
    let members = table.into_iter().filter(|(_, value)| !value.is_null());
    let members = members.map(|(key, value)| match value {
        Value::Object(inner) => (key, Value::Object(without_nulls(inner))),
        value => (key, value),
    });
    members.collect()
}

/// The parameters of a configuration file, as a dict.
#[pyfunction]
pub(crate) fn read_config(path: PathBuf, py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
    let read = reading::planner_table(&path);
    let table = read.map_err(|error| errors::file(&path, errors::config(format!("{error:#}"))))?;
    values::to_python(py, &table)
}

/// Every key that a configuration may have, dotted.
#[pyfunction]
pub(crate) fn config_keys() -> Vec<String> {
    reading::planner_keys()
}

/// All planners: name, description, whether it sends ants.
#[pyfunction]
pub(crate) fn planners() -> Vec<(&'static str, &'static str, bool)> {
    let planners = PlannerName::ALL.into_iter();
    planners
        .map(|planner| (planner.name(), planner.about(), planner.has_ants()))
        .collect()
}
