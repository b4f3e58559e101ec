//! A map, a vehicle and a request that fit together.

use super::{Endpoint, GoalTolerance, Request, ScenarioError};
use crate::collision::{Body, Drive, ObstacleMap};
use crate::geometry::Pose2;
use crate::map::OccupancyGrid;
use crate::vehicle::Vehicle;
use std::sync::Arc;

/// A checked planning problem.
///
/// ```
/// use formicar::{OccupancyGrid, Pose2, Scenario, ScenarioError, Vehicle};
///
/// let map = OccupancyGrid::from_rows(&["#.........", "..........", ".........."], 1.0)?;
/// let goal = Pose2::new(8.0, 1.5, 0.0);
/// let refused = Scenario::new(&map, Vehicle::warehouse_amr(), Pose2::new(0.5, 2.5, 0.0), goal);
/// assert!(matches!(refused, Err(ScenarioError::Occupied { .. })));
/// # Ok::<(), formicar::MapError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Scenario {
    obstacles: Arc<ObstacleMap>,
    vehicle: Vehicle,
    request: Request,
}

impl Scenario {
    /// The problem of driving from `start` to `goal` with exact headings and both gears.
    ///
    /// # Errors
    /// As [`Scenario::with_request`].
    pub fn new(
        map: &OccupancyGrid,
        vehicle: Vehicle,
        start: Pose2,
        goal: Pose2,
    ) -> Result<Self, ScenarioError> {
        Self::with_request(
            Arc::new(ObstacleMap::new(map)),
            vehicle,
            Request::new(start, goal),
        )
    }

    /// The problem on a prepared map.
    ///
    /// # Errors
    /// Poses that are not finite, off the map, or where the vehicle does not fit; headings beyond
    /// a million radians; tolerances that are not positive.
    pub fn with_request(
        obstacles: Arc<ObstacleMap>,
        vehicle: Vehicle,
        request: Request,
    ) -> Result<Self, ScenarioError> {
        request.check(&obstacles, &vehicle)?;
        Ok(Self {
            obstacles,
            vehicle,
            request,
        })
    }

    /// The prepared map.
    pub fn obstacles(&self) -> &Arc<ObstacleMap> {
        &self.obstacles
    }

    /// The vehicle.
    pub fn vehicle(&self) -> &Vehicle {
        &self.vehicle
    }

    /// The request.
    pub fn request(&self) -> &Request {
        &self.request
    }
}

/// The most goals, and the most via points, that one request may have.
const MAX_PLACES: usize = 100;

impl Request {
    /// Checks the request against a map and a vehicle.
    ///
    /// Of several goals one has to be free, at a pose within its tolerance; the others may be
    /// taken.
    ///
    /// # Errors
    /// As [`Scenario::with_request`].
    pub fn check(&self, obstacles: &ObstacleMap, vehicle: &Vehicle) -> Result<(), ScenarioError> {
        self.check_numbers()?;
        self.max_curvature_rate_per_m2(vehicle)?;
        let body = Body::new(vehicle);
        check_end(obstacles, &body, Endpoint::Start, &self.start_poses())?;
        for (i, via) in self.via.iter().enumerate() {
            check_end(obstacles, &body, Endpoint::Via(i + 1), &via.poses())?;
        }
        let mut first_taken = None;
        let mut one_is_free = false;
        for goal in self.goals() {
            let stands_free =
                |pose| obstacles.is_free(&body, &Drive::at(obstacles.frame().to_grid(pose)));
            match check_end(obstacles, &body, Endpoint::Goal, &self.poses_at_goal(goal)) {
                Ok(()) => one_is_free = true,
                Err(taken @ ScenarioError::Occupied { .. }) => {
                    if self.free_poses_at_goal(goal, stands_free).is_empty() {
                        first_taken.get_or_insert(taken);
                    } else {
                        one_is_free = true;
                    }
                }
                Err(error) => return Err(error),
            }
        }
        match first_taken {
            Some(taken) if !one_is_free => Err(taken),
            _ => Ok(()),
        }
    }

    fn check_numbers(&self) -> Result<(), ScenarioError> {
        for (what, n) in [
            ("number of goals", 1 + self.other_goals.len()),
            ("number of via points", self.via.len()),
        ] {
            if n > MAX_PLACES {
                return Err(ScenarioError::OutOfRange {
                    what,
                    value: n as f64,
                    range: "at most 100",
                });
            }
        }
        check_pose("start", self.start)?;
        for goal in self.goals() {
            check_pose("goal", goal)?;
        }
        check_tolerance("goal tolerance", self.goal_tolerance)?;
        for via in &self.via {
            let heading_rad = via.heading_rad.unwrap_or_default();
            check_pose("via point", Pose2::at(via.position, heading_rad))?;
            check_tolerance("via tolerance", via.tolerance)?;
        }
        Ok(())
    }
}

/// The largest heading, radians: beyond, turns can no longer be taken off exactly.
const MAX_HEADING_RAD: f64 = 1e6;

fn check_pose(what: &'static str, pose: Pose2) -> Result<(), ScenarioError> {
    if !pose.is_finite() {
        let value = format!("({}, {}, {})", pose.x, pose.y, pose.heading);
        return Err(ScenarioError::NotFinite { what, value });
    }
    if pose.heading.abs() > MAX_HEADING_RAD {
        return Err(ScenarioError::OutOfRange {
            what,
            value: pose.heading,
            range: "a heading within 1e6 radians",
        });
    }
    Ok(())
}

fn check_tolerance(what: &'static str, tolerance: GoalTolerance) -> Result<(), ScenarioError> {
    for (unit, value) in [("xy", tolerance.xy_m), ("yaw", tolerance.yaw_rad)] {
        if !(value.is_finite() && value > 0.0) {
            return Err(ScenarioError::BadTolerance { what, unit, value });
        }
    }
    Ok(())
}

/// True if the body stands free at one of the poses, which share a position.
fn check_end(
    obstacles: &ObstacleMap,
    body: &Body,
    which: Endpoint,
    poses: &[Pose2],
) -> Result<(), ScenarioError> {
    let Pose2 { x, y, .. } = poses[0];
    let frame = obstacles.frame();
    if frame.cell_at(poses[0].position()).is_none() {
        let (low, extent) = (frame.origin().position(), frame.extent_m());
        let high = low + extent;
        let yaw_rad = frame.origin().heading;
        let corners = (low.x, low.y, high.x, high.y);
        let (low_x, low_y, high_x, high_y) = corners;
        return Err(ScenarioError::OutsideMap {
            which,
            x,
            y,
            low_x,
            low_y,
            high_x,
            high_y,
            yaw_rad,
        });
    }
    let stands_free = |&pose: &Pose2| obstacles.is_free(body, &Drive::at(frame.to_grid(pose)));
    if poses.iter().any(stands_free) {
        return Ok(());
    }
    let grid_pose = frame.to_grid(poses[0]);
    Err(ScenarioError::Occupied {
        which,
        x,
        y,
        problem: problem(obstacles, body, grid_pose, poses.len()),
        hint: hint(obstacles, body, grid_pose),
        cells: obstacles.touched_cells(body, grid_pose),
    })
}

fn problem(obstacles: &ObstacleMap, body: &Body, grid_pose: Pose2, n_headings: usize) -> String {
    let heading = if n_headings > 1 {
        " at every heading"
    } else {
        ""
    };
    match obstacles.overlap(body, grid_pose) {
        Some(overlap) => match overlap.cell {
            Some(cell) => format!(
                "the footprint overlaps {} obstacle cell{}{heading}, deepest by {:.3} m at cell ({}, {})",
                overlap.n_cells,
                if overlap.n_cells == 1 { "" } else { "s" },
                overlap.depth_m,
                cell.col,
                cell.row
            ),
            None => format!(
                "the footprint reaches {:.3} m out of the map{heading}",
                overlap.depth_m
            ),
        },
        None => format!("the footprint does not fit{heading}"),
    }
}

fn hint(obstacles: &ObstacleMap, body: &Body, grid_pose: Pose2) -> String {
    const SEARCH_REACH_M: f64 = 5.0;
    match obstacles.nearest_free_pose(body, grid_pose, SEARCH_REACH_M) {
        Some(free) => {
            let world = obstacles.frame().to_world(free).wrapped();
            format!(
                "the nearest free pose with this heading is ({:.3}, {:.3}, {:.4})",
                world.x, world.y, world.heading
            )
        }
        None => format!("no pose with this heading is free within {SEARCH_REACH_M} m"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::{ErrorCode, GoalHeading, ViaPoint};

    fn yard() -> OccupancyGrid {
        let mut rows = vec!["....................".to_owned(); 10];
        rows[4].replace_range(8..12, "####");
        let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
        OccupancyGrid::from_rows(&rows, 0.5).unwrap()
    }

    fn code(start: Pose2, goal: Pose2) -> Option<ErrorCode> {
        let error = Scenario::new(&yard(), Vehicle::warehouse_amr(), start, goal).err()?;
        Some(ErrorCode::from(&error))
    }

    #[test]
    fn names_what_is_wrong_with_each_end() {
        let free = Pose2::new(1.0, 1.0, 0.0);
        assert_eq!(code(free, Pose2::new(9.0, 4.0, 1.0)), None);
        assert_eq!(
            code(Pose2::new(-1.0, 1.0, 0.0), free),
            Some(ErrorCode::StartOutsideMap)
        );
        assert_eq!(
            code(free, Pose2::new(5.0, 2.7, 0.0)),
            Some(ErrorCode::GoalOccupied)
        );
        assert_eq!(
            code(Pose2::new(9.6, 1.0, 0.0), free),
            Some(ErrorCode::StartOccupied)
        );
        assert_eq!(
            code(Pose2::new(f64::NAN, 1.0, 0.0), free),
            Some(ErrorCode::Unknown)
        );
    }

    #[test]
    fn the_message_names_depth_and_a_free_pose() {
        let goal = Pose2::new(5.0, 2.4, 0.0);
        let error = Scenario::new(
            &yard(),
            Vehicle::warehouse_amr(),
            Pose2::new(1.0, 1.0, 0.0),
            goal,
        );
        let text = error.unwrap_err().to_string();
        assert!(
            text.contains("deepest by 0.210 m") && text.contains("nearest free pose"),
            "{text}"
        );
    }

    #[test]
    fn any_heading_needs_only_one_that_fits() {
        let rows = ["##########", "..........", "..........", "##########"];
        let map = Arc::new(ObstacleMap::new(
            &OccupancyGrid::from_rows(&rows, 0.35).unwrap(),
        ));
        let request = Request::new(Pose2::new(1.0, 0.7, 0.0), Pose2::new(2.0, 0.7, 1.5));
        let fits = |request| {
            Scenario::with_request(map.clone(), Vehicle::warehouse_amr(), request).is_ok()
        };
        assert!(!fits(request.clone()));
        assert!(fits(Request {
            goal_heading: GoalHeading::Any,
            ..request
        }));
    }

    fn refused(change: impl Fn(&mut Request)) -> Option<String> {
        let mut request = Request::new(Pose2::new(1.0, 1.0, 0.0), Pose2::new(9.0, 4.0, 1.0));
        change(&mut request);
        let map = Arc::new(ObstacleMap::new(&yard()));
        let error = Scenario::with_request(map, Vehicle::warehouse_amr(), request).err()?;
        Some(error.to_string())
    }

    #[test]
    fn one_free_goal_of_several_is_enough() {
        let taken = Pose2::new(5.0, 2.7, 0.0);
        assert_eq!(refused(|r| r.other_goals = vec![taken]), None);
        assert_eq!(
            refused(|r| (r.other_goals, r.goal) = (vec![r.goal], taken)),
            None
        );
        let all_taken = refused(|r| (r.other_goals, r.goal) = (vec![taken], taken)).unwrap();
        assert!(all_taken.starts_with("goal (5.000, 2.700)"), "{all_taken}");
        let off = refused(|r| r.other_goals = vec![Pose2::new(50.0, 1.0, 0.0)]).unwrap();
        assert!(off.contains("outside the map"), "{off}");
        let many = refused(|r| r.other_goals = vec![r.goal; 100]).unwrap();
        assert!(many.contains("number of goals = 101"), "{many}");
    }

    #[test]
    fn via_points_are_named_by_their_number() {
        let via = |x, y| ViaPoint::new(crate::geometry::Point2::new(x, y));
        let free = via(2.0, 2.0);
        assert_eq!(refused(|r| r.via = vec![free, free]), None);
        let taken = refused(|r| r.via = vec![free, via(5.0, 2.7)]).unwrap();
        assert!(taken.starts_with("via point 2 (5.000, 2.700)"), "{taken}");
        assert!(taken.contains("at every heading"), "{taken}");
        let off = refused(|r| r.via = vec![via(-1.0, 2.0)]).unwrap();
        assert!(
            off.starts_with("via point 1") && off.contains("outside"),
            "{off}"
        );
        let none = refused(|r| r.via = vec![free.with_heading(f64::NAN)]).unwrap();
        assert!(none.contains("via point is not finite"), "{none}");
        let mut strict = free;
        strict.tolerance.xy_m = 0.0;
        let strict = refused(|r| r.via = vec![strict]).unwrap();
        assert!(strict.contains("via tolerance xy = 0"), "{strict}");
        let many = refused(|r| r.via = vec![free; 101]).unwrap();
        assert!(many.contains("number of via points = 101"), "{many}");
    }
}
