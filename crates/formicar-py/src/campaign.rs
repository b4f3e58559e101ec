//! Campaigns that are carried out elsewhere: the list of runs, what each of them needs, one run in
//! a process of its own, and the store, which the lab writes.

use crate::errors::Outcome;
use crate::values;
use anyhow::{Context, Result, bail};
use formicar::geometry::Pose2;
use formicar::map::OccupancyGrid;
use formicar::planner::{MapRecord, PlannerConfig, VehicleRecord};
use formicar::vehicle::{Motion, Vehicle};
use formicar_cli::reading;
use formicar_lab::analysis::Summary;
use formicar_lab::campaign::{Campaign, Document, MeasuredBy, Sink, Store, Text, csv_beside};
use formicar_lab::run::{
    Begun, Contender, Job, LoadedScenario, Run, RunRecord, Sources, Task, carry_out, usage,
};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use xxhash_rust::xxh3::xxh3_128;

/// A campaign and its store, of which this process is the only writer.
#[pyclass(frozen, module = "formicar._formicar")]
pub(crate) struct CampaignStore {
    campaign: Campaign,
    csv: PathBuf,
    store: Mutex<Option<Store>>,
    /// The scenarios of the runs, by name and vehicle, without the cells of their maps.
    scenarios: Mutex<BTreeMap<(String, String), Scenario>>,
}

/// What a run is to know of its scenario, but for the cells of its map.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Scenario {
    map: MapRecord,
    /// Hash of the bytes of the map.
    map_key: String,
    vehicle: VehicleRecord,
    ends: Option<[Pose2; 2]>,
}

/// What a process gets that carries out one run.
#[derive(Debug, Serialize, Deserialize)]
struct Parcel {
    job: Job,
    scenario: Scenario,
}

/// The words of an error and its causes, as an exception.
fn refused(error: &anyhow::Error) -> PyErr {
    PyValueError::new_err(format!("{error:#}"))
}

#[pymethods]
impl CampaignStore {
    /// Reads a campaign file, and opens its store: a new one, or one from before.
    #[new]
    fn new(campaign: PathBuf, store: PathBuf, py: Python<'_>) -> PyResult<Self> {
        let open = || -> Result<Self> {
            let csv = csv_beside(&store)?;
            refuse_rivals(&campaign)?;
            let campaign = reading::campaign(&campaign)?;
            let store = Store::open(&store, &campaign, env!("CARGO_PKG_VERSION"))?;
            Ok(Self {
                campaign,
                csv,
                store: Mutex::new(Some(store)),
                scenarios: Mutex::default(),
            })
        };
        py.detach(open).map_err(|error| refused(&error))
    }

    #[getter]
    fn name(&self) -> &str {
        &self.campaign.name
    }

    #[getter]
    fn n_runs(&self) -> usize {
        self.campaign.runs.len()
    }

    /// The file that takes the rows in the end.
    #[getter]
    fn csv(&self) -> PathBuf {
        self.csv.clone()
    }

    /// The runs that the store has not taken yet, in the order of the campaign.
    fn missing(&self, py: Python<'_>) -> PyResult<Vec<usize>> {
        py.detach(|| self.with_store(|store| store.missing()))
    }

    /// Notes how many runs are done at once.
    fn note_runs_at_once(&self, n: u32) -> PyResult<()> {
        self.with_store(|store| store.note_runs_at_once(n))
    }

    /// What a run needs, as JSON, and the key of its map.
    fn parcel(&self, index: usize, py: Python<'_>) -> PyResult<(String, String)> {
        let parcel = || -> Result<(String, String)> {
            let job = &self.planned(index)?.job;
            let scenario = self.scenario(job)?;
            let key = scenario.map_key.clone();
            let job = job.clone();
            Ok((serde_json::to_string(&Parcel { job, scenario })?, key))
        };
        py.detach(parcel).map_err(|error| refused(&error))
    }

    /// The bytes of the map of a run.
    fn map_bytes<'py>(&self, index: usize, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let loaded = py.detach(|| load(&self.planned(index)?.job));
        let bytes = cells_of(&loaded.map_err(|error| refused(&error))?.map);
        Ok(PyBytes::new(py, &bytes))
    }

    /// Takes a run that was measured on a machine.
    fn add(&self, index: usize, run: &str, machine: &str, build: &str) -> PyResult<()> {
        let add = || -> Result<()> {
            let planned = self.planned(index)?;
            let mut run: Run = serde_json::from_str(run).context("the run")?;
            if run.record.key() != planned.job.key() {
                bail!("it is the run of another job: {:?}", run.record.key());
            }
            run.record.source.clone_from(&planned.job.task.source);
            run.origin = measured_by(machine, build).origin(planned);
            self.sink(index, &run)
        };
        add().map_err(|error| refused(&error))
    }

    /// Takes a run whose process has ended without one.
    fn add_crashed(&self, index: usize, reason: &str, machine: &str, build: &str) -> PyResult<()> {
        let add = || -> Result<()> {
            let planned = self.planned(index)?;
            let run = Run {
                record: RunRecord::crashed(&planned.job, reason),
                origin: measured_by(machine, build).origin(planned),
                ..Run::default()
            };
            self.sink(index, &run)
        };
        add().map_err(|error| refused(&error))
    }

    /// Closes the store, writes its rows, and returns a summary of them.
    fn finish(&self, py: Python<'_>) -> PyResult<String> {
        let finish = || -> Result<String> {
            let store = lock(&self.store).take().context("the store is closed")?;
            let stored = store.stored()?;
            store.finish()?;
            formicar::map::format::write_atomically(&self.csv, stored.csv()?.as_bytes())?;
            let records: Vec<RunRecord> = stored.runs.into_iter().map(|run| run.record).collect();
            let mut text = Vec::new();
            Summary::new(&records).write_plain(&mut text)?;
            Ok(String::from_utf8_lossy(&text).into_owned())
        };
        py.detach(finish).map_err(|error| refused(&error))
    }

    /// Closes the store as it is.
    fn close(&self) {
        drop(lock(&self.store).take());
    }
}

/// Refuses a campaign with a planner from outside, before that is started.
fn refuse_rivals(campaign: &Path) -> Result<()> {
    let name = campaign.display().to_string();
    let text = std::fs::read_to_string(campaign).with_context(|| name.clone())?;
    let document = Document::read(Text { name, text })?;
    let rival = document.planners.iter().find(|p| p.command.is_some());
    let Some(rival) = rival else { return Ok(()) };
    let hint = "is a program of this machine, which others do not have; hint: formicar bench";
    let what = format!("the planner {:?} {hint}", rival.name.get_ref());
    Err(document.text.mistake(Some(rival.name.span()), what))
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

fn measured_by(machine: &str, build: &str) -> MeasuredBy {
    MeasuredBy {
        build: build.to_owned(),
        ..MeasuredBy::this_build(machine)
    }
}

impl CampaignStore {
    fn planned(&self, index: usize) -> Result<&formicar_lab::campaign::PlannedRun> {
        let n = self.campaign.runs.len();
        self.campaign
            .runs
            .get(index)
            .with_context(|| format!("run {index}: the campaign has {n}"))
    }

    fn with_store<T>(&self, act: impl FnOnce(&mut Store) -> Result<T>) -> PyResult<T> {
        let mut store = lock(&self.store);
        let store = store
            .as_mut()
            .ok_or_else(|| PyRuntimeError::new_err("the store is closed"))?;
        act(store).map_err(|error| refused(&error))
    }

    fn sink(&self, index: usize, run: &Run) -> Result<()> {
        let mut store = lock(&self.store);
        store
            .as_mut()
            .context("the store is closed")?
            .add(index, run)
    }

    fn scenario(&self, job: &Job) -> Result<Scenario> {
        let key = (job.task.scenario.clone(), job.vehicle_name().to_owned());
        if let Some(known) = lock(&self.scenarios).get(&key) {
            return Ok(known.clone());
        }
        let loaded = load(job)?;
        let scenario = Scenario {
            map_key: format!("{:032x}", xxh3_128(&cells_of(&loaded.map))),
            map: loaded.map_record.on(loaded.map.frame()),
            vehicle: VehicleRecord {
                name: loaded.vehicle_name,
                motion: loaded.vehicle.motion(),
                parameters: loaded.vehicle.parameters().clone(),
            },
            ends: loaded.ends,
        };
        lock(&self.scenarios).insert(key, scenario.clone());
        Ok(scenario)
    }
}

fn load(job: &Job) -> Result<LoadedScenario> {
    reading::sources().load(&job.task, job.vehicle_source())
}

/// The cells of a map as bytes.
fn cells_of(map: &OccupancyGrid) -> Vec<u8> {
    map.values()
        .iter()
        .map(|value| value.cast_unsigned())
        .collect()
}

/// The scenario of a parcel, with the cells of its map.
struct Unpacked {
    scenario: Scenario,
    cells: Vec<u8>,
}

impl Sources for Unpacked {
    fn load(&self, _: &Task, _: Option<&str>) -> Result<LoadedScenario> {
        let Scenario {
            map, vehicle, ends, ..
        } = &self.scenario;
        let record = serde_json::to_string(map)?;
        let grid = crate::grid::Grid::of_parts(&record, &self.cells)
            .map_err(|error| anyhow::anyhow!("{}", PyErr::from(error)))?;
        Ok(LoadedScenario {
            map: (*grid.map).clone(),
            map_record: map.clone(),
            vehicle: match vehicle.motion {
                Motion::Point => Vehicle::point(),
                _ => Vehicle::new(vehicle.parameters.clone())?,
            },
            vehicle_name: vehicle.name.clone(),
            ends: *ends,
        })
    }

    fn config(&self, contender: &Contender) -> Result<PlannerConfig> {
        reading::sources().config(contender)
    }
}

/// Carries out the run of a parcel on stdin with the map in a file; the run goes to stdout. The
/// process, which has this run to itself, ends with the one that has started it.
#[pyfunction]
pub(crate) fn carry_out_parcel(map: PathBuf) -> Outcome<()> {
    let begun = Begun::now();
    usage::end_with_parent();
    let carried_out = || -> Result<()> {
        let mut text = String::new();
        std::io::stdin().read_to_string(&mut text)?;
        let Parcel { job, scenario } = serde_json::from_str(&text).context("the run")?;
        let cells = std::fs::read(&map).with_context(|| map.display().to_string())?;
        let found = format!("{:032x}", xxh3_128(&cells));
        if found != scenario.map_key {
            bail!("{}: its bytes are those of another map", map.display());
        }
        let run = carry_out(&job, &Unpacked { scenario, cells }, begun)?;
        let mut out = std::io::stdout().lock();
        out.write_all(&serde_json::to_vec(&run)?)?;
        Ok(out.flush()?)
    };
    Ok(carried_out().map_err(|error| refused(&error))?)
}

/// This machine in a line, and the build: `debug` or `release`.
#[pyfunction]
pub(crate) fn machine() -> PyResult<(String, String)> {
    let machine = reading::machine();
    let build = MeasuredBy::this_build(&machine).build;
    if machine.is_empty() {
        return Err(values::broken("the machine does not say what it is"));
    }
    Ok((machine, build))
}
