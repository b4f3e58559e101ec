//! The entry point of smoothing: from the nodes of a grid path to a drivable curve.

use super::chain::{Piece, cheapest};
use super::config::{Corners, SmoothingConfig};
use super::error::SmoothingError;
use super::explain::explain;
use super::polyline::{Polyline, waypoints};
use super::problem::SmoothingProblem;
use super::roadmap::Roadmap;
use super::smoothed::{CornerRecord, Rounding, Smoothed};
use super::spline::spline;
use super::task::{Ends, RoundingTask};
use super::wide_arcs::{WidePath, widest};
use crate::collision::{Body, Drive};
use crate::geometry::{Point2, Pose2};
use crate::map::Cell;
use crate::path::CurvePath;
use crate::scenario::{GoalHeading, Request, StartHeading};
use crate::vehicle::Motion;

/// Every third of the headings with which a request samples a free heading is tried.
const FREE_HEADING_STRIDE: usize = 3;

/// Rounds the corners of a grid path's nodes for a vehicle, and joins the ends' headings.
///
/// Every corner gets the 2-turning of least deviation that is free of collisions, chosen jointly so
/// that neighboring corners leave each other room. Dubins curves (Reeds-Shepp where reverse is
/// allowed) lead from an exact start heading onto the polyline, and from the polyline to an exact
/// goal heading. The path begins and ends at the requested positions, even where they lie outside
/// of the cells of the first and the last node. For a point vehicle the path is the polyline. With
/// [`Corners::BSpline`] it is a spline that is not checked for collisions.
///
/// # Errors
/// Parameters out of range, no nodes, or the first place that cannot be passed, with the reason.
pub fn smooth(
    problem: &SmoothingProblem,
    config: &SmoothingConfig,
    request: &Request,
    nodes: &[Cell],
) -> Result<Smoothed, SmoothingError> {
    smooth_while(problem, (config, request), nodes, &|| true)
}

/// The same, where `goes_on` is asked every some ten microseconds whether to go on.
///
/// # Errors
/// As [`smooth`]; [`SmoothingError::Stopped`] where it said no.
pub(crate) fn smooth_while(
    problem: &SmoothingProblem,
    (config, request): (&SmoothingConfig, &Request),
    nodes: &[Cell],
    goes_on: &dyn Fn() -> bool,
) -> Result<Smoothed, SmoothingError> {
    config.check()?;
    if nodes.is_empty() {
        return Err(SmoothingError::NoNodes);
    }
    let points = waypoints(problem, request, nodes);
    if problem.vehicle.motion() == Motion::Point {
        return Ok(as_polyline(problem, &points));
    }
    if config.corners == Corners::BSpline {
        return Ok(spline(problem, config, request, points));
    }
    let body = Body::new(problem.vehicle);
    let ends = ends(problem, request, config.corners, &body);
    let own_m = problem.vehicle.parameters().safety_margin_m.unwrap_or(0.0);
    let careful = problem
        .vehicle
        .with_safety_margin(own_m + config.arc_margin_m);
    let careful_body = careful.map_or(body.clone(), |vehicle| Body::new(&vehicle));
    let cost = config.cost(problem.vehicle.min_turning_radius_m());
    let task = RoundingTask {
        cost: &cost,
        obstacles: problem.obstacles,
        body: &body,
        careful_body: &careful_body,
        radius_m: problem.vehicle.min_turning_radius_m(),
        config,
        gears: request.gears,
        ends: &ends,
        goes_on,
    };
    if config.corners == Corners::WideArcs
        && let Some(way) = widest(&task, &points)
    {
        return Ok(by_wide_arcs(problem, request, &way));
    }
    if task.is_over() {
        return Err(SmoothingError::Stopped);
    }
    let map = Roadmap::new(Polyline::new(points), config, task.radius_m);
    let pieces = if map.line.legs.is_empty() && (ends.start_is_free || ends.goal_is_free) {
        vec![standing(&task, request)?]
    } else {
        cheapest(&task, &map).map_err(|stuck| {
            if task.is_over() {
                return SmoothingError::Stopped;
            }
            explain(&task, &map, &stuck)
        })?
    };
    Ok(assembled(problem, request, &map, &pieces))
}

/// The poses at the ends, grid coordinates; none for a free heading with 2-turning alone, which
/// begins and ends as the polyline does.
fn ends(problem: &SmoothingProblem, request: &Request, corners: Corners, body: &Body) -> Ends {
    let frame = problem.obstacles.frame();
    let start_is_free = request.start_heading == StartHeading::Any;
    let goal_is_free = request.goal_heading == GoalHeading::Any;
    let placed = |poses: Vec<Pose2>, is_free: bool| {
        let stride = match (is_free, corners) {
            (true, Corners::TwoTurning | Corners::BSpline) => return Vec::new(),
            (true, Corners::TwoTurningOrDubins | Corners::WideArcs) => FREE_HEADING_STRIDE,
            (false, _) => 1,
        };
        let poses = poses.into_iter().map(|pose| frame.to_grid(pose));
        let stands_free = |pose: &Pose2| problem.obstacles.is_free(body, &Drive::at(*pose));
        poses.step_by(stride).filter(stands_free).collect()
    };
    Ends {
        starts: placed(request.start_poses(), start_is_free),
        goals: placed(request.goal_poses(), goal_is_free),
        start_is_free,
        goal_is_free,
    }
}

/// The path that does not move, for a start and a goal in one place with a free heading.
fn standing(task: &RoundingTask, request: &Request) -> Result<Piece, SmoothingError> {
    let frame = task.obstacles.frame();
    let held = if task.ends.start_is_free && !task.ends.goal_is_free {
        request.goal_poses()
    } else {
        request.start_poses()
    };
    let mut poses = held.into_iter().map(|pose| frame.to_grid(pose));
    let stands_free = |pose: &Pose2| task.obstacles.is_free(task.body, &Drive::at(*pose));
    let start = poses.find(stands_free).ok_or(SmoothingError::NoRoom)?;
    Ok(Piece {
        start,
        arcs: Vec::new(),
        member: None,
    })
}

fn as_polyline(problem: &SmoothingProblem, points: &[Point2]) -> Smoothed {
    let line = Polyline::new(points.iter().copied());
    let waypoints = problem.world_points(&line.points);
    Smoothed {
        path: CurvePath::from_polyline(&waypoints.points),
        corners: (0..line.n_corners())
            .map(|corner| CornerRecord {
                place: waypoints.points[corner + 1],
                turn_rad: line.turn_rad(corner),
                rounding: Rounding::None,
            })
            .collect(),
        waypoints,
    }
}

fn assembled(
    problem: &SmoothingProblem,
    request: &Request,
    map: &Roadmap,
    pieces: &[Piece],
) -> Smoothed {
    let frame = problem.obstacles.frame();
    let start = match (request.start_heading, pieces.first()) {
        (StartHeading::Any, Some(first)) => frame.to_world(first.start).wrapped(),
        _ => request.start,
    };
    let path = CurvePath::from_arcs(start, pieces.iter().flat_map(|piece| &piece.arcs));
    let waypoints = problem.world_points(&map.line.points);
    let mut corners: Vec<CornerRecord> = (0..map.line.n_corners())
        .map(|corner| CornerRecord {
            place: waypoints.points[corner + 1],
            turn_rad: map.line.turn_rad(corner),
            rounding: Rounding::Curve,
        })
        .collect();
    for member in pieces.iter().filter_map(|piece| piece.member) {
        let member = &map.members[member];
        corners[member.corner].rounding = Rounding::TwoTurning(member.turning);
    }
    Smoothed {
        path,
        waypoints,
        corners,
    }
}

fn by_wide_arcs(problem: &SmoothingProblem, request: &Request, way: &WidePath) -> Smoothed {
    let start = match request.start_heading {
        StartHeading::Any => problem.obstacles.frame().to_world(way.start).wrapped(),
        StartHeading::Exact => request.start,
    };
    let corners = way.corners.iter().map(|corner| CornerRecord {
        place: problem.world_points(&[corner.place]).points[0],
        turn_rad: corner.turning.turn_rad,
        rounding: Rounding::TwoTurning(corner.turning),
    });
    Smoothed {
        path: CurvePath::from_arcs(start, &way.arcs),
        waypoints: problem.world_points(&way.points),
        corners: corners.collect(),
    }
}
