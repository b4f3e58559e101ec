//! A robot found in a map, without the interpreter's lock.

use crate::errors::Outcome;
use crate::grid::Grid;
use crate::lidar_log::{LidarLog, numbers, pose, scan};
use crate::mapper::{LidarMap, config};
use formicar::Pose2;
use formicar_mapping::localize::{Located, grid_distances};
use formicar_mapping::trajectory::quality_word;
use formicar_mapping::{LocalizationMap, Localizer, MappingConfig};
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Finds a robot in a map, scan after scan.
#[pyclass(frozen, module = "formicar._formicar")]
pub(crate) struct MapLocalizer(Mutex<State>);

struct State {
    localizer: Localizer,
    config: MappingConfig,
    /// Dead reckoning at the scan before.
    reckoned: Option<Pose2>,
}

impl MapLocalizer {
    fn new(map: LocalizationMap, config: MappingConfig, start: Option<[f64; 3]>) -> Outcome<Self> {
        let localizer = Localizer::new(map, &config, start.map(pose))?;
        Ok(Self(Mutex::new(State {
            localizer,
            config,
            reckoned: None,
        })))
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Scans that are searched before the next look for Ctrl-C.
const N_AT_ONCE: usize = 50;

/// Pose, covariance row by row, quality, score, share of hits on mapped surfaces.
type LocatedRow = ((f64, f64, f64), [f64; 9], &'static str, f64, f64);

fn row(found: &Located) -> LocatedRow {
    let c = &found.covariance;
    let covariance = [c.xx, c.xy, c.xh, c.xy, c.yy, c.yh, c.xh, c.yh, c.hh];
    let quality = quality_word(found.quality);
    (
        numbers(found.pose),
        covariance,
        quality,
        found.score,
        found.mapped_share,
    )
}

#[pymethods]
impl MapLocalizer {
    /// In a map made of scans, which knows surfaces to millimeters.
    #[staticmethod]
    fn in_map(map: &LidarMap, start: Option<[f64; 3]>, py: Python<'_>) -> Outcome<Self> {
        let field = py.detach(|| LocalizationMap::new(&map.built.field));
        Self::new(field, map.config.clone(), start)
    }

    /// In the cells of a map of any origin.
    #[staticmethod]
    fn in_grid(
        grid: &Grid,
        start: Option<[f64; 3]>,
        changes: &Bound<'_, PyDict>,
        py: Python<'_>,
    ) -> Outcome<Self> {
        let config = config("formicar", changes)?;
        config.check()?;
        let cells = grid.map.clone();
        let field = py.detach(|| LocalizationMap::new(&grid_distances(&cells, &config)));
        Self::new(field, config, start)
    }

    /// Finds the pose of a scan.
    fn add(
        &self,
        ranges: PyReadonlyArray1<'_, f32>,
        angles: (f64, f64),
        odometry: Option<[f64; 3]>,
        py: Python<'_>,
    ) -> Outcome<LocatedRow> {
        let scan = scan(&ranges, angles)?;
        let found = py.detach(|| {
            let mut state = self.lock();
            let now = odometry.map(pose);
            let motion = match (state.reckoned, now) {
                (Some(before), Some(now)) => Some(before.relative(now).wrapped()),
                _ => None,
            };
            state.reckoned = now;
            state.localizer.add(&scan, motion)
        });
        Ok(row(&found))
    }

    /// Finds the pose of every scan of a log.
    fn add_log(&self, log: &LidarLog, py: Python<'_>) -> PyResult<Vec<LocatedRow>> {
        let log = &log.log;
        let mut found = Vec::with_capacity(log.scans.len());
        let mut at = 0;
        while at < log.scans.len() {
            py.detach(|| {
                let mut state = self.lock();
                if at == 0 {
                    let ranges = state.config.ranges.resolved(log.scans.iter());
                    state.localizer.set_ranges(ranges);
                }
                let end = (at + N_AT_ONCE).min(log.scans.len());
                for (i, scan) in log.scans.iter().enumerate().take(end).skip(at) {
                    found.push(row(&state.localizer.add(scan, log.motion(i))));
                }
                at = end;
            });
            py.check_signals()?;
        }
        let poses = log.odometry.as_ref();
        self.lock().reckoned = poses.and_then(|poses| poses.last().copied());
        Ok(found)
    }
}
