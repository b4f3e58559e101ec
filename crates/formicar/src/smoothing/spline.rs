//! A B-spline whose control points are the nodes (Li 2024, ACOF); obstacles are ignored.

use super::config::SmoothingConfig;
use super::polyline::Polyline;
use super::problem::SmoothingProblem;
use super::smoothed::{CornerRecord, Rounding, Smoothed};
use crate::geometry::{Arc, BSpline, Point2, Pose2, angle_difference};
use crate::path::{CurvePath, CurveSegment, Direction};
use crate::scenario::{GoalHeading, Request, StartHeading};
use std::f64::consts::{FRAC_PI_2, PI};

/// Largest distance of the arcs of a path from its spline, meters.
const TOLERANCE_M: f64 = 1e-3;
/// Arcs shorter than this come from rounding, meters.
const NEGLIGIBLE_M: f64 = 1e-9;

/// The path along the B-spline of third order over way points, grid coordinates.
///
/// Obstacles and the steering limit are ignored: the judge finds what the path touches.
pub(super) fn spline(
    problem: &SmoothingProblem,
    config: &SmoothingConfig,
    request: &Request,
    points: Vec<Point2>,
) -> Smoothed {
    let line = Polyline::new(points);
    let controls = with_headings(problem, request, &line.points);
    let spacing_m = config.spline_spacing_radii * problem.vehicle.min_turning_radius_m();
    let controls = with_spacing(&controls, spacing_m);
    let arcs = BSpline::new(controls).map_or_else(Vec::new, |spline| spline.arcs(TOLERANCE_M));
    let waypoints = problem.world_points(&line.points);
    Smoothed {
        path: driven(problem, request, &arcs),
        corners: (0..line.n_corners())
            .map(|corner| CornerRecord {
                place: waypoints.points[corner + 1],
                turn_rad: line.turn_rad(corner),
                rounding: Rounding::Spline,
            })
            .collect(),
        waypoints,
    }
}

/// Adds control points for given headings: the spline begins along its first leg and ends along its
/// last.
///
/// They lie a third as far from start and goal as the next node, as those of a uniform leg would:
/// nearer ones bend the spline sharply. The paper has no headings. A bidirectional goal counts with
/// the heading nearer to that of the last leg.
fn with_headings(problem: &SmoothingProblem, request: &Request, points: &[Point2]) -> Vec<Point2> {
    let mut controls = points.to_vec();
    let ([first, second, ..], [.., before, last]) = (points, points) else {
        return controls;
    };
    let frame = problem.obstacles.frame();
    let beside = |end: Point2, next: Point2, heading: f64| {
        end + Point2::unit(heading) * (end.distance(next) / 3.0)
    };
    let goal = frame.to_grid(request.goal).heading;
    let leads_back = angle_difference(goal, (*last - *before).angle()).abs() > FRAC_PI_2;
    let goal = match request.goal_heading {
        GoalHeading::Any => None,
        GoalHeading::Bidirectional if leads_back => Some(goal + PI),
        GoalHeading::Exact | GoalHeading::Bidirectional => Some(goal),
    };
    if let Some(heading) = goal {
        controls.insert(points.len() - 1, beside(*last, *before, heading + PI));
    }
    if request.start_heading == StartHeading::Exact {
        let heading = frame.to_grid(request.start).heading;
        controls.insert(1, beside(*first, *second, heading));
    }
    controls
}

/// Inserts points so that none is farther than `spacing_m` from the next; none where that is 0.
fn with_spacing(points: &[Point2], spacing_m: f64) -> Vec<Point2> {
    if spacing_m <= 0.0 {
        return points.to_vec();
    }
    let first = points.first().copied();
    let legs = points.windows(2).flat_map(|w| {
        let n = (w[0].distance(w[1]) / spacing_m).ceil().max(1.0) as usize;
        (1..=n).map(move |i| w[0].lerp(w[1], i as f64 / n as f64))
    });
    first.into_iter().chain(legs).collect()
}

/// Arcs in grid coordinates, driven forward in the world.
fn driven(problem: &SmoothingProblem, request: &Request, arcs: &[(Pose2, Arc)]) -> CurvePath {
    let frame = problem.obstacles.frame();
    let drivable = arcs.iter().filter(|(_, arc)| arc.length_m() > NEGLIGIBLE_M);
    let segment = |(start, arc): &(Pose2, Arc)| CurveSegment {
        start: frame.to_world(*start).wrapped(),
        curvature_per_m: arc.curvature_per_m,
        curvature_rate_per_m2: 0.0,
        length_m: arc.length_m(),
        direction: Direction::Forward,
    };
    let mut segments: Vec<CurveSegment> = drivable.map(segment).collect();
    let start = match (request.start_heading, segments.first_mut()) {
        (StartHeading::Exact, Some(first)) => {
            // Conversion to the grid and back has rounded the requested pose.
            first.start = request.start;
            request.start
        }
        (_, first) => first.map_or(request.start, |first| first.start),
    };
    CurvePath::from_segments(start, segments)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_inserted_on_long_legs_alone() {
        let points = [(0.0, 0.0), (4.0, 0.0), (4.0, 1.0)].map(|(x, y)| Point2::new(x, y));
        assert_eq!(with_spacing(&points, 0.0), points);
        let xs = |points: Vec<Point2>| points.iter().map(|p| p.x).collect::<Vec<f64>>();
        assert_eq!(
            xs(with_spacing(&points, 1.5)),
            [0.0, 4.0 / 3.0, 8.0 / 3.0, 4.0, 4.0]
        );
        assert_eq!(with_spacing(&points[..1], 1.0), points[..1]);
    }
}
