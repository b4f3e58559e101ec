//! Paths of any origin: judged and measured.

use crate::errors::{self, Outcome};
use crate::grid::Grid;
use crate::plan::Plan;
use crate::values;
use crate::vehicle::Car;
use formicar::collision::ObstacleMap;
use formicar::geometry::{Point2, Pose2};
use formicar::metrics::{ClearanceSummary, CompatibleMetrics, PathMetrics};
use formicar::path::{CurvePath, Direction, Spacing};
use formicar::planner::PathDocument;
use formicar::validation::{
    CURVATURE_TOLERANCE, FOREIGN_CURVATURE_SLACK, ForeignPath, Report, Samples, judge, judge_path,
};
use formicar::vehicle::{Motion, Vehicle};
use numpy::{PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;

/// The largest coordinate of a path, meters; as in files.
const MAX_COORDINATE_M: f64 = 1e9;

/// The longest path that is measured, meters: what it costs grows with the length.
const MAX_LENGTH_M: f64 = 1e4;

/// The most poses of a sampled path.
const MAX_POSES: f64 = 1e7;

/// A path, exactly, and where it is from.
#[pyclass(frozen, module = "formicar._formicar")]
#[derive(Clone)]
pub(crate) struct Track {
    path: ForeignPath,
    /// True for the segments of a plan, false for samples.
    is_exact: bool,
    request: Option<formicar::Request>,
}

#[pymethods]
impl Track {
    /// The curve through samples: columns x, y and maybe heading.
    #[staticmethod]
    fn of_array(samples: PyReadonlyArray2<'_, f64>, is_point: bool) -> PyResult<Self> {
        let (n_rows, n_cols) = (samples.shape()[0], samples.shape()[1]);
        if n_rows == 0 || !(2..=3).contains(&n_cols) {
            return Err(errors::path(format!(
                "path has shape ({n_rows}, {n_cols}); expected (n, 2) for x, y or (n, 3) for x, y, heading, in meters and radians, n at least 1"
            )));
        }
        let array = samples.as_array();
        let is_bad = |value: &f64| value.is_nan() || value.abs() > MAX_COORDINATE_M;
        if let Some(((row, col), value)) = array.indexed_iter().find(|(_, v)| is_bad(v)) {
            return Err(errors::path(format!(
                "path[{row}, {col}] = {value}; it must be a number between -1e9 and 1e9"
            )));
        }
        let points = array
            .rows()
            .into_iter()
            .map(|row| Point2::new(row[0], row[1]));
        let headings = (n_cols == 3).then(|| array.column(2).to_vec());
        let samples = Samples {
            points: points.collect(),
            headings,
            rounding_m: 0.0,
        };
        Self::of_samples(&samples, is_point)
    }

    /// The path of a plan.
    #[staticmethod]
    fn of_plan(plan: &Plan) -> PyResult<Self> {
        Ok(Self {
            path: plan.path()?.into(),
            is_exact: true,
            request: plan.request(),
        })
    }

    #[getter]
    fn length_m(&self) -> f64 {
        self.path().length_m() + 0.0
    }

    /// The segments, as in answers.
    fn segments<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let segments = self.path().segments().iter();
        let segments: Vec<_> = segments
            .map(formicar::planner::SegmentRecord::from)
            .collect();
        values::to_python(py, &segments)
    }

    /// The judge's report, with the slack on curvature and the first gear.
    fn judged<'py>(
        &self,
        grid: &Grid,
        car: &Car,
        py: Python<'py>,
    ) -> PyResult<(Bound<'py, PyAny>, f64, i8, bool)> {
        let obstacles = grid.obstacles();
        let (path, report) = py.detach(|| self.report(&obstacles, &car.vehicle));
        let report = report.assuming(&grid.record.assumptions());
        let first = path.segments().first();
        let gear = first.map_or_else(Direction::default, |segment| segment.direction);
        let document = values::to_python(py, &report)?;
        Ok((document, self.slack(), i8::from(gear), self.is_exact))
    }

    /// Exact metrics; those of clearance where a map is given.
    fn metrics<'py>(
        &self,
        car: &Car,
        grid: Option<&Grid>,
        py: Python<'py>,
    ) -> PyResult<(Bound<'py, PyAny>, Option<Bound<'py, PyAny>>)> {
        let vehicle = &car.vehicle;
        let obstacles = grid.map(Grid::obstacles);
        let (exact, compatible) = py.detach(|| match &obstacles {
            None => {
                let unknown = ClearanceSummary {
                    min_m: f64::NAN,
                    mean_m: f64::NAN,
                };
                let exact = PathMetrics::new(self.path(), vehicle, self.path().end(), unknown)
                    .with_travel_time(self.path(), vehicle);
                (exact, None)
            }
            Some(obstacles) => {
                let (path, report) = self.report(obstacles, vehicle);
                let least_m = report.min_clearance_m;
                let clearance = ClearanceSummary::new(obstacles, vehicle, path, least_m);
                let exact = PathMetrics::new(path, vehicle, path.end(), clearance)
                    .with_travel_time(path, vehicle);
                let compatible = CompatibleMetrics::new(path, vehicle, obstacles);
                (exact, Some(compatible))
            }
        });
        let compatible = compatible.map(|metrics| values::to_python(py, &metrics));
        Ok((values::to_python(py, &exact)?, compatible.transpose()?))
    }

    /// Sampled poses as CSV, measured against a map.
    fn poses_csv(&self, grid: &Grid, car: &Car) -> String {
        let spacing = Spacing::default();
        PathDocument::new(self.path(), &grid.obstacles(), &car.vehicle, spacing).poses_csv()
    }

    /// Poses at most so far apart: x, y, heading, s, direction and curvature of each.
    fn sample(&self, spacing_m: f64) -> Outcome<Vec<[f64; 6]>> {
        check_spacing(spacing_m, self.path().length_m())?;
        Ok(rows(self.path(), spacing_m))
    }
}

/// Refuses a spacing that is none, or so narrow that the poses would fill the memory.
pub(crate) fn check_spacing(spacing_m: f64, length_m: f64) -> PyResult<()> {
    let n_poses = length_m / spacing_m;
    if spacing_m > 0.0 && n_poses <= MAX_POSES {
        return Ok(());
    }
    let least_m = length_m / MAX_POSES;
    Err(errors::path(format!(
        "spacing = {spacing_m} m; it must be above 0 and on {length_m:.2} m at least {least_m:e}"
    )))
}

/// Samples as rows of numbers.
pub(crate) fn rows(path: &CurvePath, spacing_m: f64) -> Vec<[f64; 6]> {
    let poses = path.sample(spacing_m).into_iter();
    let row = |at: formicar::path::PathPose| {
        let Pose2 { x, y, heading } = at.pose.wrapped();
        [
            x,
            y,
            heading,
            at.s_m,
            at.direction.sign(),
            at.curvature_per_m,
        ]
    };
    poses.map(row).collect()
}

impl Track {
    fn of_samples(samples: &Samples, is_point: bool) -> PyResult<Self> {
        let motion = if is_point { Motion::Point } else { Motion::Car };
        let legs = samples.points.windows(2);
        let length_m: f64 = legs.map(|leg| (leg[1] - leg[0]).norm()).sum();
        if length_m > MAX_LENGTH_M {
            return Err(errors::path(format!(
                "the path is {length_m:.0} m long; it may be at most {MAX_LENGTH_M:.0} m; hint: write meters, and check parts of a longer one"
            )));
        }
        let path = ForeignPath::new(samples, motion);
        Ok(Self {
            path: path.ok_or_else(|| errors::path("the path has no poses"))?,
            is_exact: false,
            request: None,
        })
    }

    fn slack(&self) -> f64 {
        if self.is_exact {
            CURVATURE_TOLERANCE
        } else {
            FOREIGN_CURVATURE_SLACK
        }
    }

    /// The path; where points do not tell the gears, the reading that begins forward.
    pub(crate) fn path(&self) -> &CurvePath {
        self.path.path()
    }

    /// The path with the judge's findings.
    fn report(&self, obstacles: &ObstacleMap, vehicle: &Vehicle) -> (&CurvePath, Report) {
        self.path.judged_by(|path| match &self.request {
            Some(request) => judge(obstacles, vehicle, request, path),
            None => judge_path(obstacles, vehicle, path, self.slack()),
        })
    }

    /// The path, if the judge finds nothing wrong with it.
    pub(crate) fn certified(
        &self,
        obstacles: &ObstacleMap,
        vehicle: &Vehicle,
    ) -> PyResult<CurvePath> {
        let (path, report) = self.report(obstacles, vehicle);
        match report.violations.first() {
            None => Ok(path.clone()),
            Some(violation) => Err(errors::path(format!(
                "the path is not certified: {}; hint: check(path) lists what is wrong",
                violation.message
            ))),
        }
    }

    /// The path as a vehicle drives it on a map.
    pub(crate) fn driven(&self, obstacles: &ObstacleMap, vehicle: &Vehicle) -> CurvePath {
        self.report(obstacles, vehicle).0.clone()
    }
}
