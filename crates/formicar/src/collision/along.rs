//! Clearances at one pose after the other, as along a path.

use super::{Body, Drive, ObstacleMap};
use crate::geometry::{Pose2, angle_difference};

/// More than rounding takes off a bound, meters.
const ROUNDING_M: f64 = 1e-9;

/// The clearance of a body at poses that are asked for one after the other.
///
/// From one pose to the next no point of the body moves farther than its axle does and its reach
/// turns, and the clearance grows by no more: what is looked for lies near, which makes a pose
/// close to the last one cheap. The values are those of [`ObstacleMap::clearance_m`].
#[derive(Clone, Debug)]
pub struct ClearanceAlong<'a> {
    obstacles: &'a ObstacleMap,
    body: &'a Body,
    last: Option<(Pose2, f64)>,
}

impl<'a> ClearanceAlong<'a> {
    /// Nothing has been asked yet.
    pub fn new(obstacles: &'a ObstacleMap, body: &'a Body) -> Self {
        Self {
            obstacles,
            body,
            last: None,
        }
    }

    /// The clearance at a pose in world coordinates, meters.
    pub fn at_m(&mut self, pose: Pose2) -> f64 {
        let limit_m = self.last.map_or(f64::INFINITY, |(last, clearance_m)| {
            let moved_m = last.position().distance(pose.position());
            let turned_rad = angle_difference(pose.heading, last.heading).abs();
            clearance_m + moved_m + turned_rad * self.body.reach_m() + ROUNDING_M
        });
        let here = Drive::at(self.obstacles.frame().to_grid(pose));
        let clearance_m = self.obstacles.drive_clearance_m(self.body, &here, limit_m);
        self.last = Some((pose, clearance_m));
        clearance_m
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::generate::{ScatterParameters, scattered_obstacles};
    use crate::numeric::Seed;
    use crate::vehicle::Vehicle;

    #[test]
    fn is_the_clearance_of_each_pose_to_the_last_bit() {
        let map = scattered_obstacles(&ScatterParameters::default(), Seed(4)).unwrap();
        let (map, body) = (ObstacleMap::new(&map), Body::new(&Vehicle::lei2020()));
        let extent = map.frame().extent_m();
        let mut stream = Seed(5).stream([0, 0]);
        let mut along = ClearanceAlong::new(&map, &body);
        for _ in 0..200 {
            let (x, y) = (stream.range(0.0, extent.x), stream.range(0.0, extent.y));
            let mut pose = Pose2::new(x, y, stream.range(-3.2, 3.2));
            for _ in 0..20 {
                let curvature_per_m = stream.range(-0.4, 0.4);
                pose = pose.advance(curvature_per_m, stream.range(-0.3, 0.3));
                let expected_m = map.clearance_m(&body, map.frame().to_grid(pose));
                assert_eq!(along.at_m(pose), expected_m, "{pose:?}");
            }
        }
    }
}
