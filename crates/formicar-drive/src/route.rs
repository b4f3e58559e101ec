//! Paths that are driven piece by piece: what is free of them, what was driven, and back.

use formicar::collision::{Body, Drive, ObstacleMap};
use formicar::path::{CurveSegment, Direction};
use formicar::{CurvePath, Pose2};

/// Longest piece that is checked at once, meters.
const PIECE_M: f64 = 0.05;
/// Joints may miss each other by less, meters.
const CLOTHOID_GAP_M: f64 = 1e-4;
/// Shorter paths are none, meters.
pub(crate) const NOTHING_M: f64 = 1e-3;

/// The length of a path, from its beginning, over which a body touches nothing.
pub(crate) fn free_m(obstacles: &ObstacleMap, body: &Body, path: &CurvePath) -> f64 {
    let path = path.with_arcs(CLOTHOID_GAP_M);
    let mut free_m = 0.0;
    for segment in path.segments() {
        let n = (segment.length_m / PIECE_M).ceil().max(1.0);
        let drive = Drive {
            start: obstacles.frame().to_grid(segment.start),
            curvature_per_m: segment.curvature_per_m,
            signed_length_m: segment.direction.sign() * segment.length_m,
        };
        if obstacles.clearance_bound_m(body, &drive) > formicar::collision::MIN_CLEARANCE_M {
            free_m += segment.length_m;
            continue;
        }
        for piece in drive.pieces(n as usize) {
            if !obstacles.is_free(body, &piece) {
                return free_m;
            }
            free_m += piece.signed_length_m.abs();
        }
    }
    free_m
}

/// The length of a path up to its first change of gear, or its end.
pub(crate) fn first_gear_m(path: &CurvePath) -> f64 {
    let segments = path.segments();
    let first = segments.first().map(|segment| segment.direction);
    let same = segments
        .iter()
        .take_while(|segment| Some(segment.direction) == first);
    same.map(|segment| segment.length_m).sum()
}

/// Two paths one after the other.
pub(crate) fn joined(first: &CurvePath, second: &CurvePath) -> CurvePath {
    let segments = first.segments().iter().chain(second.segments());
    let segments = segments.filter(|segment| segment.length_m > 0.0);
    let start = if first.segments().is_empty() {
        second.start()
    } else {
        first.start()
    };
    CurvePath::from_segments(start, segments.copied().collect())
}

/// The path driven back from its end.
pub(crate) fn back(path: &CurvePath) -> CurvePath {
    let segments = path.segments().iter().rev().map(|segment| CurveSegment {
        start: segment.end(),
        curvature_per_m: segment.end_curvature_per_m(),
        curvature_rate_per_m2: -segment.curvature_rate_per_m2,
        length_m: segment.length_m,
        direction: match segment.direction {
            Direction::Forward => Direction::Reverse,
            Direction::Reverse => Direction::Forward,
        },
    });
    CurvePath::from_segments(path.end(), segments.collect())
}

/// A path with its beginning moved to a pose: the same lines and arcs from there.
pub(crate) fn from_pose(path: &CurvePath, start: Pose2) -> CurvePath {
    let begin = path.start();
    path.map_poses(|pose| start.compose(begin.relative(pose)))
}

/// How far two paths part over a length, meters.
pub(crate) fn parting_m(a: &CurvePath, b: &CurvePath, length_m: f64) -> f64 {
    let n = 20;
    let places = (0..=n).map(|i| length_m * f64::from(i) / f64::from(n));
    let apart = places.map(|s_m| {
        a.pose_at(s_m)
            .position()
            .distance(b.pose_at(s_m).position())
    });
    apart.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use formicar::{OccupancyGrid, Vehicle};

    fn winding() -> CurvePath {
        let mut path = CurvePath::new(Pose2::new(1.0, 1.0, 0.0));
        path.push(0.0, 1.0, Direction::Forward);
        path.push_clothoid([0.0, 0.5], 1.0, Direction::Forward);
        path.push(-0.8, 0.7, Direction::Reverse);
        path
    }

    #[test]
    fn a_path_driven_back_passes_the_same_poses() {
        let path = winding();
        let reversed = back(&path);
        for i in 0..=27 {
            let s_m = 0.1 * f64::from(i);
            let (a, b) = (path.pose_at(s_m), reversed.pose_at(path.length_m() - s_m));
            assert!(a.position().distance(b.position()) < 1e-9, "{s_m}");
            assert!((a.heading - b.heading).abs() < 1e-9);
        }
    }

    #[test]
    fn the_free_length_ends_before_the_wall() {
        let map = OccupancyGrid::from_rows(&["....................#..."; 12], 0.1).unwrap();
        let (obstacles, vehicle) = (ObstacleMap::new(&map), Vehicle::f1tenth());
        let mut path = CurvePath::new(Pose2::new(0.5, 0.6, 0.0));
        path.push(0.0, 1.7, Direction::Forward);
        // The front is 0.42 m ahead of the rear axle, the wall at 2 m.
        let free_m = free_m(&obstacles, &Body::new(&vehicle), &path);
        assert!((1.0..1.08).contains(&free_m), "{free_m}");
    }

    #[test]
    fn pieces_join_to_the_whole() {
        let path = winding();
        let whole = joined(&path.between_m(0.0, 1.4), &path.between_m(1.4, 2.7));
        assert!((whole.length_m() - path.length_m()).abs() < 1e-9);
        let parting_m = parting_m(&whole, &path, 2.7);
        assert!(parting_m < 1e-9, "{parting_m}");
        assert_eq!(first_gear_m(&path), 2.0);
        let moved = from_pose(&path, Pose2::new(0.0, 0.0, 1.0));
        assert_eq!(moved.start(), Pose2::new(0.0, 0.0, 1.0));
    }
}
