//! Places where a vehicle can stand, far apart.

use super::GenerateError;
use super::main_component::main_component;
use crate::geometry::{ConvexPolygon, Point2, Pose2};
use crate::map::{BitGrid, Cell, GridFrame, OccupancyGrid};
use crate::numeric::{RandomStream, Seed};
use crate::vehicle::Vehicle;
use std::f64::consts::PI;

/// Random poses that may be tried before one is free.
const MAX_TRIES: usize = 20_000;
/// Free poses among which the goal farthest from the start is picked.
const N_GOALS: usize = 8;

/// `n_pairs` starts and goals where the vehicle stands free and on the map, both with the rear
/// axle in the largest free area; each goal is the farthest of eight random ones.
///
/// A drivable path between them is likely but not certain: bodies may be stuck where they stand.
///
/// # Errors
/// A vehicle that stands free hardly anywhere.
pub fn free_pose_pairs(
    map: &OccupancyGrid,
    vehicle: &Vehicle,
    n_pairs: usize,
    seed: Seed,
) -> Result<Vec<(Pose2, Pose2)>, GenerateError> {
    let sampler = PoseSampler {
        frame: map.frame(),
        lethal: map.lethal_cells(),
        main: main_component(map).iter().collect(),
        parts: vehicle.parts(),
    };
    let mut pairs = Vec::new();
    for i in 0..n_pairs {
        let mut random = seed.stream([i as u64, 0]);
        let Some(pair) = sampler.pair(&mut random) else {
            return Err(GenerateError::NoFreePoses {
                n_found: i,
                n_wanted: n_pairs,
                n_tries: MAX_TRIES,
            });
        };
        pairs.push(pair);
    }
    Ok(pairs)
}

struct PoseSampler<'a> {
    frame: &'a GridFrame,
    lethal: BitGrid,
    main: Vec<Cell>,
    parts: &'a [ConvexPolygon],
}

impl PoseSampler<'_> {
    fn pair(&self, random: &mut RandomStream) -> Option<(Pose2, Pose2)> {
        let start = self.free_pose(random)?;
        let away = |goal: &Pose2| goal.position().distance(start.position());
        let goals: Option<Vec<Pose2>> = (0..N_GOALS).map(|_| self.free_pose(random)).collect();
        let goal = goals?
            .into_iter()
            .max_by(|a, b| away(a).total_cmp(&away(b)))?;
        Some((start, goal))
    }

    fn free_pose(&self, random: &mut RandomStream) -> Option<Pose2> {
        if self.main.is_empty() {
            return None;
        }
        let resolution = self.frame.resolution_m();
        (0..MAX_TRIES).find_map(|_| {
            let cell = self.main[random.below(self.main.len())];
            let mut place = |index: u32| (f64::from(index) + random.unit()) * resolution;
            let position = Point2::new(place(cell.col), place(cell.row));
            let heading = random.range(-PI, PI);
            let pose = self.frame.to_world(Pose2::at(position, heading));
            self.stands_free(pose).then_some(pose)
        })
    }

    fn stands_free(&self, pose: Pose2) -> bool {
        self.parts
            .iter()
            .all(|part| self.part_stands_free(part, pose))
    }

    fn part_stands_free(&self, part: &ConvexPolygon, pose: Pose2) -> bool {
        let body = part.placed(self.frame.to_grid(pose));
        let (low, high) = body.bounds();
        let size = self.frame.extent_m();
        if low.x < 0.0 || low.y < 0.0 || high.x > size.x || high.y > size.y {
            return false;
        }
        let cell = |length: f64| (length / self.frame.resolution_m()).floor() as i64;
        !(cell(low.y)..=cell(high.y)).any(|row| {
            (cell(low.x)..=cell(high.x))
                .any(|col| self.lethal.contains(col, row) && self.reaches(&body, col, row))
        })
    }

    /// True if a body reaches into or touches a cell that its bounding box touches: unless one of
    /// its sides has the whole cell outside.
    fn reaches(&self, body: &ConvexPolygon, col: i64, row: i64) -> bool {
        let resolution = self.frame.resolution_m();
        let corners = [(0, 0), (1, 0), (1, 1), (0, 1)]
            .map(|(dx, dy)| Point2::new((col + dx) as f64, (row + dy) as f64) * resolution);
        !body
            .edges()
            .any(|(a, b)| corners.iter().all(|&p| (b - a).cross(p - a) < 0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn poses_stand_in_the_open() {
        let rows = [
            "#########",
            "#.......#",
            "#.......#",
            "#########",
            "#.......#",
        ];
        let map = OccupancyGrid::from_rows(&rows, 0.5).unwrap();
        let pairs = free_pose_pairs(&map, &Vehicle::warehouse_amr(), 5, Seed(1)).unwrap();
        for pose in pairs.iter().flat_map(|&(start, goal)| [start, goal]) {
            let body = Vehicle::warehouse_amr().footprint().placed(pose);
            let (low, high) = body.bounds();
            assert!(
                low.x > 0.5 && high.x < 4.0 && low.y > 1.0 && high.y < 2.0,
                "{pose:?}"
            );
        }
        let again = free_pose_pairs(&map, &Vehicle::warehouse_amr(), 5, Seed(1)).unwrap();
        assert_eq!(pairs, again);
        let error = free_pose_pairs(&map, &Vehicle::sedan(), 1, Seed(1));
        assert!(matches!(error, Err(GenerateError::NoFreePoses { .. })));
    }
}
