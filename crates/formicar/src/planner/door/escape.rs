//! The shortest way out of obstacles, for a vehicle that stands in contact with them.

use crate::collision::{Body, Drive, ObstacleMap};
use crate::geometry::Pose2;
use crate::path::{CurvePath, Direction};
use crate::scenario::Request;
use crate::validation::{CURVATURE_TOLERANCE, Report, judge_path};
use crate::vehicle::{Gears, Motion, Vehicle};
use std::collections::BTreeSet;

/// A drive out of contact, which precedes a certified path.
///
/// On it the body touches only cells that it touches where it stands; nothing is certified.
#[derive(Clone, Debug, PartialEq)]
pub struct Escape {
    /// The drive, from the start of the request to that of the path.
    pub path: CurvePath,
    /// Cells that the body touches at the start.
    pub n_cells: usize,
}

impl Escape {
    /// What a judge finds who does not count the cells that the body touches where the drive
    /// begins: a valid drive touches no others.
    pub fn report(&self, obstacles: &ObstacleMap, vehicle: &Vehicle) -> Report {
        let start = obstacles.frame().to_grid(self.path.start());
        let touched = obstacles.touched_cells(&Body::new(vehicle), start);
        judge_path(
            &obstacles.without(&touched),
            vehicle,
            &self.path,
            CURVATURE_TOLERANCE,
        )
    }
}

/// Lengths of a motion, cells: the way out is as short as the first allows, or, where it is too
/// long for that many motions, the second.
const STEPS_CELLS: [f64; 2] = [0.25, 1.0];
/// Share of the largest curvature at which a motion steers.
const STEERING: [f64; 5] = [0.0, 0.5, -0.5, 1.0, -1.0];
/// Poses after which no way out of motions of one length is expected any more.
const MAX_POSES: usize = 10_000;

/// A pose on the way out, grid coordinates.
struct Reached {
    pose: Pose2,
    /// The pose before, and the motion from there: curvature and signed length.
    from: Option<(usize, [f64; 2])>,
}

/// The shortest drive on which the body touches only what it touches at the start, to a pose where
/// it touches nothing; none where the start is free, off the map, or shut in.
pub(super) fn escape(
    obstacles: &ObstacleMap,
    vehicle: &Vehicle,
    request: &Request,
) -> Option<Escape> {
    let body = Body::new(vehicle);
    let start = obstacles.frame().to_grid(request.start);
    let touched = obstacles.touched_cells(&body, start);
    if vehicle.motion() == Motion::Point || touched.is_empty() {
        return None;
    }
    let opened = obstacles.without(&touched);
    if !opened.is_free(&body, &Drive::at(start)) {
        return None;
    }
    let steps_m = STEPS_CELLS.map(|cells| cells * obstacles.frame().resolution_m());
    let paths = steps_m.into_iter().find_map(|step_m| {
        let motions = motions(vehicle, request.gears, step_m);
        way_out([obstacles, &opened], &body, start, &motions)
    });
    paths.map(|motions| Escape {
        path: drive(&motions, request.start),
        n_cells: touched.len(),
    })
}

/// The fewest of some motions of equal length that lead from a pose to one that is free on the
/// first map, without touching anything on the second.
fn way_out(
    [obstacles, opened]: [&ObstacleMap; 2],
    body: &Body,
    start: Pose2,
    motions: &[[f64; 2]],
) -> Option<Vec<[f64; 2]>> {
    let step_m = motions[0][1].abs();
    let turn_rad = step_m / body.reach_m();
    // Motions of one length along a diagonal of these cells still leave them.
    let key = |pose: Pose2| {
        [
            pose.x / (0.7 * step_m),
            pose.y / (0.7 * step_m),
            pose.heading / (0.7 * turn_rad),
        ]
        .map(|share| share.round() as i64)
    };
    let mut seen = BTreeSet::from([key(start)]);
    let mut reached = vec![Reached {
        pose: start,
        from: None,
    }];
    // Motions are equally long: the first that is reached is the nearest.
    let mut here = 0;
    while here < reached.len() {
        let pose = reached[here].pose;
        if obstacles.is_free(body, &Drive::at(pose)) {
            return Some(motions_to(&reached, here));
        }
        for &[curvature_per_m, signed_length_m] in motions {
            let motion = Drive {
                start: pose,
                curvature_per_m,
                signed_length_m,
            };
            let next = motion.pose_at(1.0);
            if reached.len() == MAX_POSES || seen.contains(&key(next)) {
                continue;
            }
            if opened.is_free(body, &motion) {
                seen.insert(key(next));
                reached.push(Reached {
                    pose: next,
                    from: Some((here, [curvature_per_m, signed_length_m])),
                });
            }
        }
        here += 1;
    }
    None
}

/// Curvature and signed length of each motion, straight ones first.
fn motions(vehicle: &Vehicle, gears: Gears, step_m: f64) -> Vec<[f64; 2]> {
    let curvatures = STEERING.map(|share| share * vehicle.max_curvature_per_m());
    let all = curvatures.into_iter().flat_map(|curvature| {
        let signs = gears.signs().iter();
        signs.map(move |&sign| [curvature, f64::from(sign) * step_m])
    });
    all.collect()
}

/// The motions to a pose, in order.
fn motions_to(reached: &[Reached], end: usize) -> Vec<[f64; 2]> {
    let mut motions = Vec::new();
    let mut here = end;
    while let Some((before, motion)) = reached[here].from {
        motions.push(motion);
        here = before;
    }
    motions.reverse();
    motions
}

/// The drive of some motions; those that continue the one before become one segment with it.
fn drive(motions: &[[f64; 2]], start: Pose2) -> CurvePath {
    let mut path = CurvePath::new(start);
    for same in motions.chunk_by(|a, b| a == b) {
        let [curvature_per_m, signed_length_m] = same[0];
        let gear = if signed_length_m > 0.0 {
            Direction::Forward
        } else {
            Direction::Reverse
        };
        let length_m = signed_length_m.abs() * same.len() as f64;
        path.push(curvature_per_m, length_m, gear);
    }
    path
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point2;
    use crate::map::OccupancyGrid;
    use crate::scenario::StartContact;

    /// A wall at the upper border of a yard of 10 x 6 m.
    fn yard() -> ObstacleMap {
        let mut rows = vec![".".repeat(100); 60];
        rows[..10].iter_mut().for_each(|row| *row = "#".repeat(100));
        let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
        ObstacleMap::new(&OccupancyGrid::from_rows(&rows, 0.1).unwrap())
    }

    fn from(start: Pose2) -> Request {
        Request {
            start_contact: StartContact::Escape,
            ..Request::new(start, Pose2::new(8.0, 2.0, 0.0))
        }
    }

    #[test]
    fn leads_out_and_touches_nothing_else() {
        let (map, vehicle) = (yard(), Vehicle::warehouse_amr());
        let body = Body::new(&vehicle);
        let (mut n_out, mut longest_m) = (0, 0.0_f64);
        for i in 0..24 {
            let start = Pose2::new(4.0, 4.6 + 0.02 * f64::from(i % 4), 0.26 * f64::from(i));
            let touched = map.touched_cells(&body, start);
            let Some(escape) = escape(&map, &vehicle, &from(start)) else {
                continue;
            };
            n_out += 1;
            assert_eq!(
                (escape.path.start(), escape.n_cells),
                (start, touched.len())
            );
            assert!(map.is_free(&body, &Drive::at(escape.path.end())));
            let report = escape.report(&map, &vehicle);
            assert!(report.valid, "{start:?}: {:?}", report.violations);
            longest_m = longest_m.max(escape.path.length_m());
        }
        assert!(n_out > 6 && longest_m < 1.5, "{n_out} {longest_m}");
    }

    #[test]
    fn is_as_short_as_it_can_be() {
        // Nose in the wall by 5 cm, straight: back by as much, to the quarter of a cell.
        let (map, vehicle) = (yard(), Vehicle::warehouse_amr());
        let start = Pose2::new(4.0, 5.0 - 0.775 + 0.05, std::f64::consts::FRAC_PI_2);
        let escape = escape(&map, &vehicle, &from(start)).unwrap();
        let length_m = escape.path.length_m();
        assert!((0.05..0.05 + 0.0251).contains(&length_m), "{length_m}");
        assert_eq!(escape.path.segments()[0].direction, Direction::Reverse);
    }

    #[test]
    fn leads_along_a_wall_too() {
        // Beside the flank an area of 0.4 x 0.3 m that is closed: ahead or back, past all of it.
        let mut map = OccupancyGrid::from_rows(&[&".".repeat(100)[..]; 60], 0.1).unwrap();
        let area = [[1.95, 2.55], [2.25, 2.55], [2.25, 2.75], [1.95, 2.75]];
        map.fill_polygon(&area.map(|[x, y]| Point2::new(x, y)), 100);
        let (map, vehicle) = (ObstacleMap::new(&map), Vehicle::warehouse_amr());
        let escape = escape(&map, &vehicle, &from(Pose2::new(2.0, 3.0, 0.0))).unwrap();
        assert!(escape.path.length_m() < 1.0, "{}", escape.path.length_m());
        assert!(escape.report(&map, &vehicle).valid);
    }

    #[test]
    fn there_is_none_from_within_a_block_nor_from_free_ground() {
        let (map, vehicle) = (yard(), Vehicle::warehouse_amr());
        for start in [Pose2::new(4.0, 5.5, 0.0), Pose2::new(4.0, 2.0, 0.0)] {
            assert_eq!(escape(&map, &vehicle, &from(start)), None);
        }
        let ahead = Request {
            gears: Gears::Forward,
            ..from(Pose2::new(4.0, 4.3, std::f64::consts::FRAC_PI_2))
        };
        assert_eq!(escape(&map, &vehicle, &ahead), None);
    }
}
