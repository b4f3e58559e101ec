//! The metrics of other tools, under their names.

use super::benchmr::BenchMr;
use super::resample::{resampled, without_rounding};
use super::smoothness::smoothness;
use crate::collision::ObstacleMap;
use crate::geometry::{Point2, Pose2, dubins, reeds_shepp};
use crate::map::{BitGrid, Cell};
use crate::path::{CurvePath, Direction};
use crate::vehicle::{Motion, Vehicle};

/// Metrics by the definitions of other tools, for comparison only.
///
/// All are taken over 500 poses at equal steps of arc length, as Bench-MR does; another number of
/// poses gives other values.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct CompatibleMetrics {
    /// Bench-MR: sum of absolute changes of slope per length, rad/m; a cusp adds about pi.
    pub benchmr_aol: f64,
    /// Bench-MR: largest 1/R of the circles through non-overlapping triples with both legs at
    /// least 0.3 m, 1/m.
    pub benchmr_max_curvature: f64,
    /// Bench-MR: sum over the same triples of curvature times both legs.
    pub benchmr_normalized_curvature: f64,
    /// Bench-MR: points where the slope changes by more than 60 degrees.
    pub benchmr_cusps: usize,
    /// OMPL's `smoothness()` with Euclidean distances.
    pub ompl_smoothness: f64,
    /// The same with Dubins distances (Reeds-Shepp where the path reverses) at the vehicle's
    /// smallest radius, as MATLAB's `pathmetrics`; nothing for a point.
    pub matlab_smoothness: Option<f64>,
    /// Smallest distance between the centers of the poses' cells and of occupied cells, meters,
    /// as MATLAB's `pathmetrics`; nothing without obstacles.
    pub matlab_clearance: Option<f64>,
}

impl CompatibleMetrics {
    /// Poses that a path is resampled to.
    const N_POSES: usize = 500;

    /// The metrics of a path of a vehicle among obstacles.
    pub fn new(path: &CurvePath, vehicle: &Vehicle, obstacles: &ObstacleMap) -> Self {
        let poses = without_rounding(resampled(path, Self::N_POSES));
        let points: Vec<Point2> = poses.iter().map(|pose| pose.position()).collect();
        let benchmr = BenchMr::new(&points);
        Self {
            benchmr_aol: benchmr.aol,
            benchmr_max_curvature: benchmr.max_curvature,
            benchmr_normalized_curvature: benchmr.normalized_curvature,
            benchmr_cusps: benchmr.n_cusps,
            ompl_smoothness: smoothness(&points, |a, b| a.distance(*b)),
            matlab_smoothness: matlab_smoothness(path, vehicle, &poses),
            matlab_clearance: matlab_clearance(obstacles, &points),
        }
    }
}

fn matlab_smoothness(path: &CurvePath, vehicle: &Vehicle, poses: &[Pose2]) -> Option<f64> {
    if vehicle.motion() != Motion::Car {
        return None;
    }
    let reverses = path
        .segments()
        .iter()
        .any(|s| s.direction == Direction::Reverse);
    let distance = if reverses {
        reeds_shepp::distance
    } else {
        dubins::distance
    };
    let radius_m = vehicle.min_turning_radius_m();
    Some(smoothness(poses, |&a, &b| {
        distance(a, b, radius_m).unwrap_or(f64::NAN)
    }))
}

fn matlab_clearance(obstacles: &ObstacleMap, points: &[Point2]) -> Option<f64> {
    let (frame, field) = (obstacles.frame(), obstacles.distance());
    let mut cells: Vec<Cell> = points.iter().filter_map(|&p| frame.cell_at(p)).collect();
    cells.dedup();
    let truncated = |cell: &Cell| field.squared(cell.col as usize, cell.row as usize);
    let least = u64::from(cells.iter().map(truncated).min()?);
    let limit = u64::from(field.truncation_cells()).pow(2);
    let squared = if least < limit {
        least
    } else {
        far_squared_distance(obstacles.lethal(), &cells)?
    };
    Some((squared as f64).sqrt() * frame.resolution_m())
}

/// Least squared distance in cells between cells and occupied cells, by brute force: for paths
/// that keep so far away that the distance transform does not tell.
fn far_squared_distance(lethal: &BitGrid, cells: &[Cell]) -> Option<u64> {
    if lethal.count() == 0 {
        return None;
    }
    cells.iter().fold(None, |nearest, &cell| {
        squared_distance_within(lethal, cell, nearest).or(nearest)
    })
}

/// Squared distance in cells to the nearest occupied cell, where it is below the limit: only rows
/// and columns that near are looked at.
fn squared_distance_within(lethal: &BitGrid, cell: Cell, limit: Option<u64>) -> Option<u64> {
    let reach = limit.map_or(usize::MAX, |squared| squared.isqrt() as usize);
    let window = |center: u32, n: usize| {
        let center = center as usize;
        center.saturating_sub(reach)..center.saturating_add(reach).saturating_add(1).min(n)
    };
    let cols = window(cell.col, lethal.n_cols());
    window(cell.row, lethal.n_rows())
        .flat_map(|row| cols.clone().map(move |col| (col, row)))
        .filter(|&(col, row)| lethal.get(col, row))
        .map(|(col, row)| {
            let (dx, dy) = (
                (col as u64).abs_diff(cell.col.into()),
                (row as u64).abs_diff(cell.row.into()),
            );
            dx * dx + dy * dy
        })
        .min()
        .filter(|&squared| limit.is_none_or(|limit| squared < limit))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::{GridFrame, OccupancyGrid};
    use std::f64::consts::{FRAC_PI_2, TAU};

    fn free_map() -> ObstacleMap {
        let frame = GridFrame::new(20, 20, 1.0, Pose2::default()).unwrap();
        ObstacleMap::new(&OccupancyGrid::free(frame))
    }

    fn polyline(points: &[(f64, f64)]) -> CurvePath {
        let points: Vec<_> = points.iter().map(|&(x, y)| Point2::new(x, y)).collect();
        CurvePath::from_polyline(&points)
    }

    /// `[length, AOL, largest curvature, normalized curvature, cusps, OMPL smoothness]`.
    fn row(path: &CurvePath) -> [f64; 6] {
        let m = CompatibleMetrics::new(path, &Vehicle::sedan(), &free_map());
        let poses = resampled(path, CompatibleMetrics::N_POSES);
        let length = poses
            .windows(2)
            .map(|w| w[0].position().distance(w[1].position()))
            .sum();
        [
            length,
            m.benchmr_aol,
            m.benchmr_max_curvature,
            m.benchmr_normalized_curvature,
            m.benchmr_cusps as f64,
            m.ompl_smoothness,
        ]
    }

    fn quarter_circle() -> CurvePath {
        let mut path = CurvePath::new(Pose2::default());
        path.push(0.2, 5.0 * FRAC_PI_2, Direction::Forward);
        path
    }

    /// The vectors of design/metrics.md, to the digits given there.
    #[test]
    fn test_vectors() {
        let (corner, back) = (
            polyline(&[(0., 0.), (5., 0.), (5., 5.)]),
            polyline(&[(0., 0.), (5., 0.), (0., 0.)]),
        );
        let vectors = [
            (polyline(&[(0., 0.), (10., 0.)]), [10.0, 0., 0., 0., 0., 0.]),
            (quarter_circle(), [7.854, 0.19960, 0.2, 1.51074, 0., 19.92]),
            (corner, [9.9941, 0.15717, 0.3148, 0.19287, 0., 4216.47]),
            (back, [9.98, 0.31479, 0., 0., 1., 0.]),
        ];
        let tolerances = [5e-5, 5e-6, 5e-6, 5e-6, 0.0, 5e-3];
        for (path, expected) in vectors {
            let found = row(&path);
            let near = (0..6).all(|i| (found[i] - expected[i]).abs() <= tolerances[i]);
            assert!(near, "{found:?} instead of {expected:?}");
        }
    }

    #[test]
    fn ompl_smoothness_of_one_arc_grows_with_the_number_of_points() {
        let at = |n| {
            smoothness(&resampled(&quarter_circle(), n), |a, b| {
                a.position().distance(b.position())
            })
        };
        for (n, expected) in [(100, 3.92), (500, 19.92), (2000, 79.92)] {
            assert!((at(n) - expected).abs() < 5e-3, "{n}: {}", at(n));
        }
    }

    #[test]
    fn matlab_smoothness_of_the_unit_circle() {
        let pose = |i: i32| {
            let at = Point2::unit(TAU * f64::from(i) / 20.0);
            Pose2::at(at, 0.0)
        };
        let poses: Vec<Pose2> = (0..=20).map(pose).collect();
        let found = smoothness(&poses, |&a, &b| dubins::distance(a, b, 1.0).unwrap());
        assert!((found - 1.93616).abs() < 5e-6, "{found}");
    }

    #[test]
    fn matlab_clearance_is_that_between_cell_centers() {
        let rows = ["#.....", "......", "......", "....#."];
        let map = ObstacleMap::new(&OccupancyGrid::from_rows(&rows, 0.5).unwrap());
        let path = polyline(&[(0.9, 0.1), (0.9, 1.1)]);
        let m = CompatibleMetrics::new(&path, &Vehicle::point(), &map);
        assert!((m.matlab_clearance.unwrap() - 0.5 * 2_f64.sqrt()).abs() < 1e-12);
        assert_eq!(m.matlab_smoothness, None);
        let mut field = OccupancyGrid::free(GridFrame::new(300, 9, 0.1, Pose2::default()).unwrap());
        field.set(Cell::new(299, 2), 100);
        let far = CompatibleMetrics::new(&path, &Vehicle::point(), &ObstacleMap::new(&field));
        assert!((far.matlab_clearance.unwrap() - 29.0).abs() < 1e-9);
        let open = CompatibleMetrics::new(&path, &Vehicle::sedan(), &free_map());
        assert_eq!(open.matlab_clearance, None);
        assert!(open.matlab_smoothness.unwrap() >= 0.0);
    }

    #[test]
    fn a_path_that_stands_still_has_no_nan() {
        let path = CurvePath::new(Pose2::new(3.0, 3.0, 1.0));
        let m = CompatibleMetrics::new(&path, &Vehicle::sedan(), &free_map());
        assert_eq!(
            (m.benchmr_aol, m.ompl_smoothness, m.benchmr_cusps),
            (0.0, 0.0, 0)
        );
        assert_eq!(m.matlab_smoothness, Some(0.0));
    }
}
