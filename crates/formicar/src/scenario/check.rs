//! A map, a vehicle and a request that fit together.

use super::GoalHeading;
use super::{Endpoint, Request, ScenarioError, StartHeading};
use crate::collision::{Body, Drive, ObstacleMap};
use crate::geometry::Pose2;
use crate::map::OccupancyGrid;
use crate::vehicle::Vehicle;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// A checked planning problem.
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
    /// Poses that are not finite, off the map, or where the vehicle does not fit; tolerances
    /// that are not positive.
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

/// Headings tried where the planner may choose one.
const N_FREE_HEADINGS: u32 = 72;

impl Request {
    /// Whether this request can be asked on this map with this vehicle.
    ///
    /// # Errors
    /// As [`Scenario::with_request`].
    pub fn check(&self, obstacles: &ObstacleMap, vehicle: &Vehicle) -> Result<(), ScenarioError> {
        for (what, pose) in [("start", self.start), ("goal", self.goal)] {
            if !pose.is_finite() {
                let value = format!("({}, {}, {})", pose.x, pose.y, pose.heading);
                return Err(ScenarioError::NotFinite { what, value });
            }
        }
        let tolerance = self.goal_tolerance;
        for (what, value) in [
            ("goal tolerance xy", tolerance.xy_m),
            ("goal tolerance yaw", tolerance.yaw_rad),
        ] {
            if !(value.is_finite() && value > 0.0) {
                return Err(ScenarioError::OutOfRange {
                    what,
                    value,
                    range: "finite and above 0",
                });
            }
        }
        self.max_curvature_rate_per_m2(vehicle)?;
        let body = Body::new(vehicle);
        check_end(obstacles, &body, Endpoint::Start, &self.start_poses())?;
        check_end(obstacles, &body, Endpoint::Goal, &self.goal_poses())
    }

    /// The start poses that the start-heading mode allows; those of `any` are a sample.
    pub fn start_poses(&self) -> Vec<Pose2> {
        match self.start_heading {
            StartHeading::Exact => vec![self.start],
            StartHeading::Any => all_around(self.start),
        }
    }

    /// The goal poses that the goal-heading mode allows; those of `any` are a sample.
    pub fn goal_poses(&self) -> Vec<Pose2> {
        match self.goal_heading {
            GoalHeading::Exact => vec![self.goal],
            GoalHeading::Bidirectional => vec![self.goal, turned(self.goal, PI)],
            GoalHeading::Any => all_around(self.goal),
        }
    }
}

fn turned(pose: Pose2, turn_rad: f64) -> Pose2 {
    Pose2::at(pose.position(), pose.heading + turn_rad).wrapped()
}

fn all_around(pose: Pose2) -> Vec<Pose2> {
    let turn = |i| turned(pose, TAU * f64::from(i) / f64::from(N_FREE_HEADINGS));
    (0..N_FREE_HEADINGS).map(turn).collect()
}

/// Whether the body stands free at one of the poses, which share a position.
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
    use crate::scenario::ErrorCode;

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
}
