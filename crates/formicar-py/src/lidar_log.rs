//! Lidar logs: from arrays, CARMEN files and bags of ROS 2.

use crate::errors::{self, Outcome};
use formicar::Pose2;
use formicar_cli::reading::{self, BagChoice};
use formicar_mapping::{LaserScan, Log};
use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use std::path::PathBuf;

/// The scans of one laser, in order.
#[pyclass(frozen, module = "formicar._formicar")]
pub(crate) struct LidarLog {
    pub(crate) log: Log,
}

/// A pose from three numbers.
pub(crate) fn pose([x, y, heading]: [f64; 3]) -> Pose2 {
    Pose2::new(x, y, heading)
}

/// The three numbers of a pose.
pub(crate) fn numbers(pose: Pose2) -> (f64, f64, f64) {
    (pose.x, pose.y, pose.heading)
}

/// Poses as rows of three numbers.
pub(crate) fn rows<'py>(py: Python<'py>, poses: &[Pose2]) -> Bound<'py, PyArray2<f64>> {
    let of = |pose: &Pose2| [pose.x, pose.y, pose.heading];
    let rows = Array2::from_shape_fn((poses.len(), 3), |(i, k)| of(&poses[i])[k]);
    rows.into_pyarray(py)
}

/// A scan whose geometry is checked. `angles` are those of the first beam and from beam to beam.
pub(crate) fn scan(ranges: &PyReadonlyArray1<'_, f32>, angles: (f64, f64)) -> Outcome<LaserScan> {
    let scan = LaserScan {
        time_s: 0.0,
        first_angle_rad: angles.0,
        angle_step_rad: angles.1,
        ranges_m: ranges.as_array().to_vec(),
    };
    Ok(scan.checked()?)
}

#[pymethods]
impl LidarLog {
    /// A log of arrays of one length.
    #[staticmethod]
    fn of_arrays(
        ranges: PyReadonlyArray2<'_, f32>,
        angles: (f64, f64),
        times: PyReadonlyArray1<'_, f64>,
        odometry: Option<PyReadonlyArray2<'_, f64>>,
    ) -> Outcome<Self> {
        let ranges = ranges.as_array();
        let pairs = ranges.outer_iter().zip(times.as_array());
        let scans = pairs.map(|(row, &time_s)| LaserScan {
            time_s,
            first_angle_rad: angles.0,
            angle_step_rad: angles.1,
            ranges_m: row.to_vec(),
        });
        let poses = odometry.map(|rows| {
            let rows = rows.as_array();
            let poses = rows
                .outer_iter()
                .map(|row| Pose2::new(row[0], row[1], row[2]));
            poses.collect()
        });
        let log = Log {
            scans: scans.collect(),
            odometry: poses,
            ..Log::default()
        };
        let n_scans = log.scans.len();
        Ok(Self {
            log: log.checked(n_scans)?,
        })
    }

    /// A log of a file, as the command line reads it; the topics are those of scans and odometry.
    #[staticmethod]
    fn read(
        path: PathBuf,
        topics: [Option<String>; 2],
        laser_pose: Option<[f64; 3]>,
        no_odometry: bool,
        py: Python<'_>,
    ) -> PyResult<Self> {
        let [scan_topic, odom_topic] = topics;
        let choice = BagChoice {
            scan_topic,
            odom_topic,
            laser_pose: laser_pose.map(pose),
            no_odometry,
        };
        let read = py.detach(|| reading::lidar_log(&path, choice));
        match read {
            Ok(log) => Ok(Self { log }),
            Err(error) => Err(errors::file(&path, errors::log(error))),
        }
    }

    /// The log without its odometry.
    fn without_odometry(&self) -> Self {
        Self {
            log: self.log.clone().without_odometry(),
        }
    }

    /// Number of scans and of beams.
    fn shape(&self) -> (usize, usize) {
        let n_beams = self.log.scans.first().map_or(0, |scan| scan.ranges_m.len());
        (self.log.scans.len(), n_beams)
    }

    /// Direction of the first beam, and angle from beam to beam.
    fn angles(&self) -> (f64, f64) {
        let first = self.log.scans.first();
        first.map_or((0.0, 0.0), |scan| {
            (scan.first_angle_rad, scan.angle_step_rad)
        })
    }

    fn ranges<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f32>> {
        let scans = &self.log.scans;
        Array2::from_shape_fn(self.shape(), |(i, k)| scans[i].ranges_m[k]).into_pyarray(py)
    }

    fn times<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let times = self.log.scans.iter().map(|scan| scan.time_s);
        times.collect::<Vec<_>>().into_pyarray(py)
    }

    fn odometry<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray2<f64>>> {
        self.log.odometry.as_ref().map(|poses| rows(py, poses))
    }

    fn reference<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray2<f64>>> {
        self.log.reference.as_ref().map(|poses| rows(py, poses))
    }

    fn warnings(&self) -> Vec<String> {
        self.log.warnings.clone()
    }
}
