//! Exact metrics, from the segments of a path.

use super::SteeringShare;
use crate::collision::{Body, ClearanceAlong, ObstacleMap};
use crate::geometry::{Pose2, angle_difference};
use crate::path::{CurvePath, CurveSegment};
use crate::vehicle::Vehicle;

/// Distance from the footprint to the nearest occupied cell square or the map border, along a
/// whole path.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ClearanceSummary {
    /// The least, meters, as the judge found it.
    pub min_m: f64,
    /// The mean over arc length, meters.
    pub mean_m: f64,
}

impl ClearanceSummary {
    /// Most that two samples of the mean lie apart.
    const SPACING_M: f64 = 0.05;
    /// Samples between two questions whether to go on.
    const SAMPLES_PER_LOOK: usize = 64;

    /// The judge's least clearance with a mean sampled at most 0.05 m apart, never below it.
    pub fn new(obstacles: &ObstacleMap, vehicle: &Vehicle, path: &CurvePath, min_m: f64) -> Self {
        Self::new_while((obstacles, vehicle), path, min_m, &mut || true)
    }

    /// The same, where `goes_on` is asked on the way whether to go on; of no use where it said no.
    pub(crate) fn new_while(
        (obstacles, vehicle): (&ObstacleMap, &Vehicle),
        path: &CurvePath,
        min_m: f64,
        goes_on: &mut dyn FnMut() -> bool,
    ) -> Self {
        let body = Body::new(vehicle);
        let mut clearance = ClearanceAlong::new(obstacles, &body);
        let mut clearance_integral = 0.0;
        for segment in path.segments() {
            // Mid points of equal steps: each stands for as much arc length as any other.
            let n_steps = (segment.length_m / Self::SPACING_M).ceil().max(1.0);
            let step_m = segment.length_m / n_steps;
            let at_steps = (0..n_steps as usize)
                .take_while(|i| !i.is_multiple_of(Self::SAMPLES_PER_LOOK) || goes_on());
            let at_steps =
                at_steps.map(|i| clearance.at_m(segment.pose_at((i as f64 + 0.5) * step_m)));
            clearance_integral += at_steps.sum::<f64>() * step_m;
        }
        let length_m = path.length_m();
        let mean_m = if length_m > 0.0 {
            clearance_integral / length_m
        } else {
            clearance.at_m(path.start())
        };
        let mean_m = mean_m.max(min_m);
        Self { min_m, mean_m }
    }
}

/// Exact metrics of a path.
///
/// ```
/// use formicar::metrics::{ClearanceSummary, PathMetrics};
/// use formicar::path::Direction::{Forward, Reverse};
/// use formicar::{CurvePath, Pose2, Vehicle};
///
/// let mut path = CurvePath::new(Pose2::default());
/// path.push(0.0, 5.0, Forward);
/// path.push(0.1, 2.0, Reverse);
/// let clearance = ClearanceSummary { min_m: 0.4, mean_m: 0.9 };
/// let metrics = PathMetrics::new(&path, &Vehicle::sedan(), path.end(), clearance);
/// assert_eq!((metrics.length_m, metrics.reverse_length_m, metrics.n_cusps), (7.0, 2.0, 1));
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct PathMetrics {
    /// Driven length, meters.
    pub length_m: f64,
    /// Largest absolute curvature of a segment; the corners of a polyline do not count.
    pub max_curvature_per_m: f64,
    /// Mean absolute curvature over arc length, corners not counted.
    pub mean_abs_curvature_per_m: f64,
    /// Integral of absolute curvature over arc length, plus the angles of corners.
    pub total_turning_rad: f64,
    /// Total turning per meter.
    pub aol_rad_per_m: f64,
    /// Fastest change of curvature along a segment; 0 on lines and arcs, whose jumps are counted
    /// apart.
    pub max_curvature_rate_per_m2: f64,
    /// Joints where the curvature jumps while the vehicle moves on in the same gear.
    pub n_curvature_jumps: usize,
    /// Switches of direction.
    pub n_cusps: usize,
    /// Length driven in reverse, meters.
    pub reverse_length_m: f64,
    /// Least clearance, meters.
    pub min_clearance_m: f64,
    /// Mean clearance, meters.
    pub mean_clearance_m: f64,
    /// Largest absolute angle of the virtual middle front wheel, where the wheelbase is known.
    pub max_steer_rad: Option<f64>,
    /// Time of the fastest drive within the vehicle's speed, the default accelerations of
    /// [`SpeedLimits`](crate::path::SpeedLimits) and the steering rate, seconds; where the vehicle
    /// says how fast it drives, and [`PathMetrics::with_travel_time`] was asked.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub travel_time_s: Option<f64>,
    /// Turning from step to step, at [`SteeringShare::DEFAULT_SPACING_M`].
    pub steering_share: SteeringShare,
    /// Distance of the last pose from the goal, meters.
    pub goal_error_m: f64,
    /// Absolute heading difference between the last pose and the goal, radians.
    pub goal_error_rad: f64,
}

impl PathMetrics {
    /// Joints that turn by less are rounding, radians.
    const CORNER_RAD: f64 = 1e-9;

    /// Curvatures that differ by less are one, relative to the larger, or to 0.001 1/m: a clothoid
    /// that ends in a line ends beside curvature 0 by rounding.
    const SAME_CURVATURE: f64 = 1e-9;

    /// The metrics of a path that should end at `goal`, without a travel time.
    pub fn new(
        path: &CurvePath,
        vehicle: &Vehicle,
        goal: Pose2,
        clearance: ClearanceSummary,
    ) -> Self {
        let segments = || path.segments().iter().filter(|s| s.length_m > 0.0);
        let joints = || segments().zip(segments().skip(1));
        // Sums go from 0, since the empty sum of floats is -0.
        let length_m = path.length_m() + 0.0;
        let per_length = |amount: f64| {
            if length_m > 0.0 {
                amount / length_m
            } else {
                0.0
            }
        };
        let turning = segments().fold(0.0, |sum, s| sum + s.total_turn_rad());
        let total_turning_rad = turning + joints().map(|(a, b)| corner_rad(a, b)).sum::<f64>();
        let max_curvature_per_m = segments()
            .map(CurveSegment::max_abs_curvature_per_m)
            .fold(0.0, f64::max);
        let max_curvature_rate_per_m2 = segments()
            .map(|s| s.curvature_rate_per_m2.abs())
            .fold(0.0, f64::max);
        let reversed = segments().filter(|s| s.direction.sign() < 0.0);
        Self {
            length_m,
            max_curvature_per_m,
            mean_abs_curvature_per_m: per_length(turning),
            total_turning_rad,
            aol_rad_per_m: per_length(total_turning_rad),
            max_curvature_rate_per_m2,
            n_curvature_jumps: joints().filter(|(a, b)| is_curvature_jump(a, b)).count(),
            n_cusps: joints().filter(|(a, b)| a.direction != b.direction).count(),
            reverse_length_m: reversed.fold(0.0, |sum, s| sum + s.length_m),
            min_clearance_m: clearance.min_m,
            mean_clearance_m: clearance.mean_m,
            max_steer_rad: vehicle.steer_rad(max_curvature_per_m),
            travel_time_s: None,
            steering_share: SteeringShare::new(path, SteeringShare::DEFAULT_SPACING_M),
            goal_error_m: path.end().position().distance(goal.position()),
            goal_error_rad: angle_difference(path.end().heading, goal.heading).abs(),
        }
    }
}

fn corner_rad(before: &CurveSegment, after: &CurveSegment) -> f64 {
    let angle = angle_difference(after.start.heading, before.end().heading).abs();
    if angle < PathMetrics::CORNER_RAD {
        0.0
    } else {
        angle
    }
}

fn is_curvature_jump(before: &CurveSegment, after: &CurveSegment) -> bool {
    let (a, b) = (before.end_curvature_per_m(), after.curvature_per_m);
    let same = (a - b).abs() <= PathMetrics::SAME_CURVATURE * a.abs().max(b.abs()).max(1e-3);
    before.direction == after.direction && !same
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point2;
    use crate::map::OccupancyGrid;
    use crate::path::Direction::{Forward, Reverse};
    use std::f64::consts::{FRAC_PI_2, PI};

    const CLEARANCE: ClearanceSummary = ClearanceSummary {
        min_m: 0.2,
        mean_m: 0.5,
    };

    #[test]
    fn counts_a_three_point_turn() {
        let mut path = CurvePath::new(Pose2::default());
        path.push(0.25, 2.0 * PI, Forward);
        path.push(-0.25, PI, Reverse);
        path.push(0.0, 1.0, Reverse);
        path.push(0.125, 4.0 * PI, Forward);
        let goal = Pose2::at(path.end().position(), 0.0);
        let metrics = PathMetrics::new(&path, &Vehicle::sedan(), goal, CLEARANCE);
        assert!((metrics.length_m - (7.0 * PI + 1.0)).abs() < 1e-12);
        assert!((metrics.total_turning_rad - 1.25 * PI).abs() < 1e-9);
        assert!((metrics.reverse_length_m - (PI + 1.0)).abs() < 1e-12);
        assert_eq!(metrics.max_curvature_per_m, 0.25);
        assert_eq!((metrics.n_cusps, metrics.n_curvature_jumps), (2, 1));
        assert!((metrics.goal_error_rad - 0.75 * PI).abs() < 1e-9);
        assert_eq!(metrics.goal_error_m, 0.0);
        let steer = (2.8_f64 * 0.25).atan();
        assert!((metrics.max_steer_rad.unwrap() - steer).abs() < 1e-12);
    }

    #[test]
    fn corners_of_a_polyline_are_turns_without_curvature() {
        let points = [(0., 0.), (5., 0.), (5., 5.)].map(|(x, y)| Point2::new(x, y));
        let path = CurvePath::from_polyline(&points);
        let metrics = PathMetrics::new(&path, &Vehicle::point(), path.end(), CLEARANCE);
        assert!((metrics.total_turning_rad - FRAC_PI_2).abs() < 1e-12);
        assert!((metrics.aol_rad_per_m - FRAC_PI_2 / 10.0).abs() < 1e-12);
        assert_eq!(metrics.max_curvature_per_m, 0.0);
    }

    #[test]
    fn a_path_that_stands_still_has_no_nan() {
        let path = CurvePath::new(Pose2::new(1.0, 2.0, 3.0));
        let metrics = PathMetrics::new(&path, &Vehicle::sedan(), path.start(), CLEARANCE);
        assert_eq!(metrics.aol_rad_per_m, 0.0);
        let json = serde_json::to_string(&metrics).unwrap();
        assert!(!json.contains("null") && !json.contains('-'), "{json}");
    }

    #[test]
    fn mean_clearance_along_a_corridor() {
        let rows = ["##########", "..........", "..........", "##########"];
        let map = ObstacleMap::new(&OccupancyGrid::from_rows(&rows, 1.0).unwrap());
        let mut path = CurvePath::new(Pose2::new(3.0, 2.0, 0.0));
        path.push(0.0, 3.0, Forward);
        let summary = ClearanceSummary::new(&map, &Vehicle::warehouse_amr(), &path, 0.69);
        assert!((summary.mean_m - 0.69).abs() < 1e-9, "{summary:?}");
        let still = CurvePath::new(path.start());
        let summary = ClearanceSummary::new(&map, &Vehicle::warehouse_amr(), &still, 0.69);
        assert!((summary.mean_m - 0.69).abs() < 1e-9);
    }
}
