//! A scenario from its seed.

use super::ground::Kind;
use super::{ground, request, vehicle};
use formicar::collision::{Body, ObstacleMap};
use formicar::geometry::Pose2;
use formicar::map::{Cell, OCCUPIED, OccupancyGrid};
use formicar::numeric::Seed;
use formicar::scenario::Request;
use formicar::vehicle::Vehicle;

/// A random scenario.
pub(super) struct Drawn {
    pub(super) seed: u64,
    pub(super) kind: Kind,
    pub(super) vehicle_name: &'static str,
    pub(super) map: OccupancyGrid,
    pub(super) vehicle: Vehicle,
    pub(super) request: Request,
    /// True if the vehicle stands free at every pose that the request names.
    pub(super) stands_free: bool,
    /// True if a wall was built around the goal.
    pub(super) is_sealed: bool,
}

impl Drawn {
    /// The scenario of a seed.
    pub(super) fn of(seed: u64, budget_steps: u64) -> Self {
        let mut random = Seed(seed).stream([0, 0]);
        let (vehicle_name, vehicle) = vehicle::draw(&mut random);
        let (low, high) = vehicle.footprint().bounds();
        let kind = Kind::ALL[random.below(Kind::ALL.len())];
        let size_m = [high.x - low.x, high.y - low.y];
        let mut map = ground::draw(kind, size_m, &mut random);
        let body = Body::new(&vehicle);
        let (request, stands_free) = request::draw(&ObstacleMap::new(&map), &body, &mut random);
        let is_sealed = stands_free && request.via.is_empty() && random.below(8) == 0;
        if is_sealed {
            let radius_m = vehicle.footprint().circumradius();
            for goal in request.goals() {
                wall_around(&mut map, goal, radius_m, &[request.start]);
            }
        }
        Self {
            seed,
            kind,
            vehicle_name,
            map,
            vehicle,
            request: Request {
                budget_steps: Some(budget_steps),
                ..request
            },
            // A wall around one end may stand on another.
            stands_free: stands_free && !is_sealed,
            is_sealed,
        }
    }
}

/// Occupies a ring about a pose, wide enough for the vehicle to stand inside and free of the
/// others' places.
fn wall_around(map: &mut OccupancyGrid, pose: Pose2, radius_m: f64, others: &[Pose2]) {
    let frame = *map.frame();
    let cell_m = frame.resolution_m();
    let inner_m = radius_m + 2.0 * cell_m;
    let outer_m = inner_m + 2.0 * cell_m;
    for index in 0..frame.n_cells() {
        let cell: Cell = frame.cell(index);
        let center = frame.center(cell);
        let away_m = center.distance(pose.position());
        let near_other = |other: &Pose2| center.distance(other.position()) < inner_m;
        if (inner_m..outer_m).contains(&away_m) && !others.iter().any(near_other) {
            map.set(cell, OCCUPIED);
        }
    }
}
