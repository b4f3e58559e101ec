//! The problem that smoothing solves: a grid path, its map, and the vehicle.

use crate::collision::ObstacleMap;
use crate::geometry::{Point2, Pose2};
use crate::map::{BitGrid, DiagonalRule, line_of_sight};
use crate::path::WaypointPath;
use crate::vehicle::Vehicle;

/// The map on which a grid path was found, and the vehicle that will drive it.
#[derive(Clone, Copy, Debug)]
pub struct SmoothingProblem<'a> {
    /// The map.
    pub obstacles: &'a ObstacleMap,
    /// The vehicle.
    pub vehicle: &'a Vehicle,
    /// The cells that the grid path avoids: obstacles, usually inflated.
    pub blocked: &'a BitGrid,
    /// The rule by which the grid path passes corners.
    pub rule: DiagonalRule,
}

impl SmoothingProblem<'_> {
    /// Points from grid to world coordinates.
    pub(super) fn world_points(&self, points: &[Point2]) -> WaypointPath {
        let frame = self.obstacles.frame();
        let to_world = |&p: &Point2| frame.to_world(Pose2::at(p, 0.0)).position();
        WaypointPath {
            points: points.iter().map(to_world).collect(),
        }
    }

    /// Whether an end of the path has a line of sight to a point; from a blocked cell only lethal
    /// cells hide points. Grid coordinates.
    pub(super) fn sees(&self, end: Point2, point: Point2) -> bool {
        let scale = 1.0 / self.obstacles.frame().resolution_m();
        let (end, point) = (end * scale, point * scale);
        let is_on_blocked = self
            .blocked
            .contains(end.x.floor() as i64, end.y.floor() as i64);
        let hiding = if is_on_blocked {
            self.obstacles.lethal()
        } else {
            self.blocked
        };
        line_of_sight(hiding, self.rule, end, point)
    }
}
