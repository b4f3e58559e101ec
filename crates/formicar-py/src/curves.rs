//! Shortest curves of bounded curvature: Dubins and Reeds-Shepp.

use crate::errors::{self, Outcome};
use crate::path::{check_spacing, rows};
use formicar::geometry::{Curve, Pose2, dubins, reeds_shepp};
use formicar::path::CurvePath;
use numpy::{PyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;

/// A curve from a pose.
#[pyclass(frozen, module = "formicar._formicar")]
pub(crate) struct BoundedCurve {
    start: Pose2,
    curve: Curve,
}

fn pose([x, y, heading]: [f64; 3]) -> Pose2 {
    Pose2::new(x, y, heading)
}

fn check(from: [f64; 3], to: [f64; 3], radius_m: f64) -> PyResult<()> {
    if !(radius_m > 0.0 && radius_m.is_finite()) {
        return Err(errors::path(format!(
            "radius = {radius_m} m; it must be above 0 and finite"
        )));
    }
    for (name, pose) in [("start", from), ("goal", to)] {
        if let Some(value) = pose.iter().find(|value| !value.is_finite()) {
            return Err(errors::path(format!("{name} is not finite: {value}")));
        }
    }
    Ok(())
}

#[pymethods]
impl BoundedCurve {
    /// All curves between two poses, shortest first.
    #[staticmethod]
    fn candidates(
        reverses: bool,
        from: [f64; 3],
        to: [f64; 3],
        radius_m: f64,
    ) -> PyResult<Vec<Self>> {
        check(from, to, radius_m)?;
        let (start, goal) = (pose(from), pose(to));
        let curves = if reverses {
            reeds_shepp::candidates(start, goal, radius_m)
        } else {
            dubins::candidates(start, goal, radius_m)
        };
        Ok(curves
            .into_iter()
            .map(|curve| Self { start, curve })
            .collect())
    }

    /// The shortest curve between two poses.
    #[staticmethod]
    fn shortest(
        reverses: bool,
        from: [f64; 3],
        to: [f64; 3],
        radius_m: f64,
    ) -> PyResult<Option<Self>> {
        check(from, to, radius_m)?;
        let (start, goal) = (pose(from), pose(to));
        let curve = if reverses {
            reeds_shepp::shortest(start, goal, radius_m)
        } else {
            dubins::shortest(start, goal, radius_m)
        };
        Ok(curve.map(|curve| Self { start, curve }))
    }

    #[getter]
    fn length_m(&self) -> f64 {
        self.curve.length_m()
    }

    /// Curvature and signed length of each arc.
    #[getter]
    fn arcs(&self) -> Vec<(f64, f64)> {
        let arcs = self.curve.arcs().iter();
        arcs.map(|arc| (arc.curvature_per_m, arc.signed_length_m))
            .collect()
    }

    /// The pose at its end.
    #[getter]
    fn end(&self) -> [f64; 3] {
        let Pose2 { x, y, heading } = self.curve.end_from(self.start).wrapped();
        [x, y, heading]
    }

    /// Poses at most so far apart.
    fn sample(&self, spacing_m: f64) -> Outcome<Vec<[f64; 6]>> {
        check_spacing(spacing_m, self.curve.length_m())?;
        let path = CurvePath::from_arcs(self.start, self.curve.arcs());
        Ok(rows(&path, spacing_m))
    }
}

/// Lengths of the shortest curves from rows of poses to rows of poses.
#[pyfunction]
pub(crate) fn curve_lengths<'py>(
    reverses: bool,
    from: PyReadonlyArray2<'py, f64>,
    to: PyReadonlyArray2<'py, f64>,
    radius_m: f64,
    py: Python<'py>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    if from.shape() != to.shape() || from.shape()[1] != 3 {
        return Err(errors::path(
            "poses have shape (n, 3): x, y, heading in meters and radians",
        ));
    }
    check([0.0; 3], [0.0; 3], radius_m)?;
    let (from, to) = (from.as_array(), to.as_array());
    let row = |row: numpy::ndarray::ArrayView1<'_, f64>| Pose2::new(row[0], row[1], row[2]);
    let pairs = from.rows().into_iter().zip(to.rows());
    let lengths = pairs.map(|(from, to)| {
        let (from, to) = (row(from), row(to));
        let length = if reverses {
            reeds_shepp::distance(from, to, radius_m)
        } else {
            dubins::distance(from, to, radius_m)
        };
        length.unwrap_or(f64::NAN)
    });
    Ok(PyArray1::from_vec(py, lengths.collect()))
}
