//! Mapping: scans in, maps out, without the interpreter's lock.

use crate::errors::{self, Outcome};
use crate::grid::Grid;
use crate::lidar_log::{LidarLog, numbers, pose, rows, scan};
use crate::values;
use formicar::Pose2;
use formicar_mapping::localize::first_pose;
use formicar_mapping::report::map_picture;
use formicar_mapping::trajectory::quality_word;
use formicar_mapping::{BuiltMap, Go, LaserScan, MapReport, Mapper, MappingConfig, MappingError};
use numpy::{PyArray2, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use serde_json::Value;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Time between two looks for Ctrl-C.
const SIGNALS_EVERY: Duration = Duration::from_millis(20);

/// The parameters of a preset with some of them changed.
pub(crate) fn config(preset: &str, changes: &Bound<'_, PyDict>) -> PyResult<MappingConfig> {
    let base = match preset {
        "formicar" => MappingConfig::default(),
        "fossel2015" => MappingConfig::fossel2015(),
        other => {
            return Err(errors::config(format!(
                "preset = {other:?}; expected \"formicar\" or \"fossel2015\""
            )));
        }
    };
    let mut document = serde_json::to_value(base).map_err(values::broken)?;
    merge(
        &mut document,
        values::to_json(changes, "config", errors::config)?,
    );
    values::document(document, "config", errors::config)
}

/// Changes the members of a document that another one has.
fn merge(document: &mut Value, changes: Value) {
    match (document, changes) {
        (Value::Object(members), Value::Object(changes)) => {
            for (key, change) in changes {
                merge(members.entry(key).or_insert(Value::Null), change);
            }
        }
        (document, change) => *document = change,
    }
}

/// Lets Python handle its signals.
fn look(py: Python<'_>) -> PyResult<()> {
    py.check_signals()
}

/// Looks for Ctrl-C now and then, and keeps what it raised.
struct Signals {
    at: Instant,
    raised: Option<PyErr>,
}

impl Signals {
    fn new() -> Self {
        Self {
            at: Instant::now(),
            raised: None,
        }
    }

    fn go(&mut self) -> Go {
        if self.raised.is_none() && self.at.elapsed() >= SIGNALS_EVERY {
            self.raised = Python::attach(look).err();
            self.at = Instant::now();
        }
        if self.raised.is_some() {
            Go::Stop
        } else {
            Go::On
        }
    }

    /// What was raised meanwhile, if anything.
    fn result(self) -> PyResult<()> {
        self.raised.map_or(Ok(()), Err)
    }
}

/// Builds a map from scans.
#[pyclass(frozen, module = "formicar._formicar")]
pub(crate) struct LidarMapper(Mutex<State>);

struct State {
    mapper: Mapper,
    /// Dead reckoning at the scan before.
    reckoned: Option<Pose2>,
    /// True before the first scan of a drive, whose pose is given.
    begins: bool,
}

impl State {
    fn new(mapper: Mapper) -> Self {
        Self {
            begins: mapper.places().is_empty(),
            mapper,
            reckoned: None,
        }
    }

    /// Adds a scan; the motion is that of the dead reckoning since the scan before.
    fn add(&mut self, scan: &LaserScan, reckoned: Option<Pose2>) -> Result<(), MappingError> {
        let motion = match (self.reckoned, reckoned) {
            _ if self.begins => Some(Pose2::default()),
            (Some(before), Some(now)) => Some(before.relative(now).wrapped()),
            _ => None,
        };
        self.mapper.add(scan, motion)?;
        self.reckoned = reckoned;
        self.begins = false;
        Ok(())
    }

    /// Begins another drive at a pose in the map so far.
    fn start_at(&mut self, start: Pose2, built: &BuiltMap) {
        self.mapper.start_drive(start, built);
        self.reckoned = None;
        self.begins = true;
    }

    fn quality(&self) -> &'static str {
        let last = self.mapper.places().last();
        last.map_or("", |place| quality_word(place.quality))
    }
}

impl LidarMapper {
    fn lock(&self) -> MutexGuard<'_, State> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[pymethods]
impl LidarMapper {
    #[new]
    fn new(preset: &str, changes: &Bound<'_, PyDict>) -> Outcome<Self> {
        let mapper = Mapper::new(config(preset, changes)?)?;
        Ok(Self(Mutex::new(State::new(mapper))))
    }

    /// The mapper that was saved.
    #[staticmethod]
    fn of_session(bytes: &Bound<'_, PyBytes>) -> Outcome<Self> {
        let mapper = Mapper::from_session(bytes.as_bytes())?;
        Ok(Self(Mutex::new(State::new(mapper))))
    }

    /// The session as the bytes of a file.
    fn session<'py>(&self, py: Python<'py>) -> Outcome<Bound<'py, PyBytes>> {
        let bytes = py.detach(|| self.lock().mapper.to_session())?;
        Ok(PyBytes::new(py, &bytes))
    }

    /// Adds a scan; returns its pose and how it was matched.
    fn add(
        &self,
        ranges: PyReadonlyArray1<'_, f32>,
        angles: (f64, f64),
        odometry: Option<[f64; 3]>,
        py: Python<'_>,
    ) -> Outcome<((f64, f64, f64), &'static str)> {
        let scan = scan(&ranges, angles)?;
        Ok(py.detach(|| {
            let mut state = self.lock();
            state.add(&scan, odometry.map(pose))?;
            Ok::<_, MappingError>((numbers(state.mapper.pose()), state.quality()))
        })?)
    }

    /// Adds the scans of a log as the command line does.
    fn add_log(&self, log: &LidarLog, start: Option<[f64; 3]>, py: Python<'_>) -> Outcome<()> {
        let mut signals = Signals::new();
        py.detach(|| {
            let mut state = self.lock();
            let known = state.mapper.log_progress();
            let goes_on = known.is_some_and(|known| known.fingerprint == log.log.fingerprint());
            state.mapper.resolve_ranges(&log.log);
            if !goes_on && !state.mapper.places().is_empty() {
                let built = state.mapper.finish(|_| Go::On)?;
                let (config, ranges) = (state.mapper.config(), state.mapper.policy());
                let start = match start {
                    Some(start) => pose(start),
                    None => first_pose(&built.field, &log.log, config, ranges)?,
                };
                state.start_at(start, &built);
            }
            state.mapper.add_log(&log.log, |_| true, |_| signals.go())?;
            state.reckoned = log
                .log
                .odometry
                .as_ref()
                .and_then(|poses| poses.last().copied());
            state.begins = false;
            Ok::<_, MappingError>(())
        })?;
        Ok(signals.result()?)
    }

    /// Begins another drive at a pose in the map so far.
    fn start_drive(&self, start: [f64; 3], py: Python<'_>) -> Outcome<()> {
        Ok(py.detach(|| {
            let mut state = self.lock();
            let built = state.mapper.finish(|_| Go::On)?;
            state.start_at(pose(start), &built);
            Ok::<_, MappingError>(())
        })?)
    }

    /// Pose of the last scan, how it was matched, number of scans and of key scans.
    fn state(&self, py: Python<'_>) -> ((f64, f64, f64), &'static str, usize, usize) {
        // Whoever waits for the mapper holds no lock that it may need for a look at signals.
        py.detach(|| {
            let state = self.lock();
            let mapper = &state.mapper;
            let counts = (mapper.places().len(), mapper.nodes().len());
            (numbers(mapper.pose()), state.quality(), counts.0, counts.1)
        })
    }

    /// Every parameter.
    fn config<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let config = py.detach(|| self.lock().mapper.config().clone());
        values::to_python(py, &config)
    }

    /// Closes loops, refines and draws the map.
    fn finish(&self, py: Python<'_>) -> Outcome<LidarMap> {
        let mut signals = Signals::new();
        let map = py.detach(|| {
            let state = self.lock();
            let built = state.mapper.finish(|_| signals.go())?;
            let report = MapReport::new(&state.mapper, &built);
            Ok::<_, MappingError>(LidarMap {
                config: state.mapper.config().clone(),
                report: serde_json::to_value(report).unwrap_or_default(),
                built,
            })
        });
        signals.result()?;
        Ok(map?)
    }
}

/// A map made of scans.
#[pyclass(frozen, module = "formicar._formicar")]
pub(crate) struct LidarMap {
    pub(crate) built: BuiltMap,
    pub(crate) config: MappingConfig,
    report: Value,
}

#[pymethods]
impl LidarMap {
    /// The cells.
    fn grid(&self) -> Grid {
        Grid::named(self.built.grid.clone(), "lidar")
    }

    /// The pose of the laser at every scan.
    fn trajectory<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        rows(py, &self.built.trajectory)
    }

    /// The report as a document.
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        values::from_json(py, &self.report)
    }

    /// The picture of the report.
    fn svg(&self, title: &str, py: Python<'_>) -> String {
        py.detach(|| map_picture(&self.built, title).to_svg())
    }
}
