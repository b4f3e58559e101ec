//! The sampled poses of a document, held against its segments.

use super::path_document::PoseRecord;
use crate::geometry::wrap_angle;
use crate::path::{CurvePath, CurveSegment, Direction};
use std::iter::Peekable;
use std::slice::Iter;

/// Tolerance between recorded numbers and those found now, meters and radians: machines round
/// differently.
const TOLERANCE: f64 = 1e-6;

/// True where poses are samples of a path at some spacing: in the order of the drive, each on the
/// path at its arc length and in its gear, both ends of every segment among them. A change of gear
/// has a pose or, with the second gear, two.
///
/// Cost is proportional to poses and segments.
pub fn are_samples_of(poses: &[PoseRecord], path: &CurvePath) -> bool {
    let segments = path.segments();
    let gear = segments.first().map_or(Direction::Forward, |s| s.direction);
    let mut poses = poses.iter().peekable();
    let starts = |pose: &PoseRecord| {
        let start = path.start();
        pose.s.abs() <= TOLERANCE && is_at(pose, start.x, start.y, start.heading, gear)
    };
    if !poses.next().is_some_and(starts) {
        return false;
    }
    let mut s_m = 0.0;
    for (i, segment) in segments.iter().enumerate() {
        if !passes(segment, s_m, &mut poses) {
            return false;
        }
        s_m += segment.length_m;
        let next = segments.get(i + 1);
        if let Some(next) = next.filter(|next| next.direction != segment.direction) {
            let leaves =
                |pose: &&PoseRecord| (pose.s - s_m).abs() <= TOLERANCE && is_on(pose, next, s_m);
            // Without a second row, this may be the end of a segment of no length.
            if next.length_m > TOLERANCE {
                poses.next_if(leaves);
            }
        }
    }
    poses.next().is_none()
}

/// True where the next poses lie on a segment, the last of them at its end.
fn passes(segment: &CurveSegment, s_m: f64, poses: &mut Peekable<Iter<PoseRecord>>) -> bool {
    let mut driven_m = 0.0;
    for pose in poses {
        let here_m = pose.s - s_m;
        let is_forth = here_m >= driven_m - TOLERANCE && here_m <= segment.length_m + TOLERANCE;
        if !is_forth || !is_on(pose, segment, s_m) {
            return false;
        }
        driven_m = here_m;
        if segment.length_m - here_m <= TOLERANCE {
            return true;
        }
    }
    false
}

/// True where a pose lies on a segment that begins at `s_m`, at its own arc length.
fn is_on(pose: &PoseRecord, segment: &CurveSegment, s_m: f64) -> bool {
    let at = segment.pose_at((pose.s - s_m).clamp(0.0, segment.length_m));
    is_at(pose, at.x, at.y, at.heading, segment.direction)
}

fn is_at(pose: &PoseRecord, x: f64, y: f64, heading_rad: f64, gear: Direction) -> bool {
    // Not one comparison holds for a number that is none.
    (pose.x - x).hypot(pose.y - y) <= TOLERANCE
        && wrap_angle(pose.heading - heading_rad).abs() <= TOLERANCE
        && pose.direction == gear
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collision::ObstacleMap;
    use crate::geometry::Pose2;
    use crate::map::OccupancyGrid;
    use crate::path::Direction::{Forward, Reverse};
    use crate::path::Spacing;
    use crate::planner::PathDocument;
    use crate::vehicle::Vehicle;

    fn turn() -> CurvePath {
        let mut path = CurvePath::new(Pose2::new(10.0, 10.0, 0.3));
        path.push(0.2, 3.0, Forward);
        path.push(-0.2, 2.0, Reverse);
        path.push_clothoid([0.0, 0.2], 1.5, Reverse);
        path.push(0.0, 1.0, Forward);
        path
    }

    fn poses(spacing: impl Into<Spacing>) -> Vec<PoseRecord> {
        let map = ObstacleMap::new(&OccupancyGrid::from_rows(&["...."; 4], 8.0).unwrap());
        PathDocument::new(&turn(), &map, &Vehicle::sedan(), spacing).poses
    }

    #[test]
    fn samples_at_any_spacing_are_those_of_the_path() {
        for spacing in [1e-3, 0.1, 0.7, 1e3] {
            assert!(are_samples_of(&poses(spacing), &turn()), "{spacing}");
        }
        let mut of_before = poses(0.1);
        of_before.dedup_by(|b, a| a.s == b.s && a.direction != b.direction);
        assert_eq!(of_before.len() + 2, poses(0.1).len());
        assert!(are_samples_of(&of_before, &turn()));
    }

    #[test]
    fn a_cusp_has_both_gears() {
        let poses = poses(0.5);
        let cusps: Vec<_> = poses.windows(2).filter(|w| w[0].s == w[1].s).collect();
        assert_eq!(cusps.len(), 2);
        for cusp in cusps {
            assert_ne!(cusp[0].direction, cusp[1].direction);
            assert_eq!((cusp[0].x, cusp[0].y), (cusp[1].x, cusp[1].y));
            assert!(cusp[1].time > cusp[0].time, "its wheels turn meanwhile");
        }
        assert!(poses.windows(2).all(|w| w[1].time > w[0].time));
    }

    #[test]
    fn whatever_is_changed_is_found() {
        let truth = poses(0.1);
        let n = truth.len();
        let changed = |change: &dyn Fn(&mut Vec<PoseRecord>)| {
            let mut poses = truth.clone();
            change(&mut poses);
            are_samples_of(&poses, &turn())
        };
        for i in [0, 7, n / 2, n - 1] {
            assert!(!changed(&|poses| poses[i].x += 1e-3), "{i}");
            assert!(!changed(&|poses| poses[i].heading += 1e-3), "{i}");
            assert!(!changed(&|poses| poses[i].s += 1e-3), "{i}");
            assert!(!changed(&|poses| poses[i].s = f64::NAN), "{i}");
            let other = |gear| if gear == Forward { Reverse } else { Forward };
            assert!(!changed(
                &|poses| poses[i].direction = other(poses[i].direction)
            ));
        }
        assert!(!changed(&|poses| poses.truncate(n - 1)));
        assert!(!changed(&|poses| poses.retain(|pose| pose.s > 0.0)));
        assert!(!changed(&|poses| poses.swap(3, 4)));
        assert!(!changed(&|poses| poses.truncate(1)));
        assert!(!changed(&|poses| poses.push(poses[n - 1].clone())));
        // The end of a segment.
        assert!(!changed(&|poses| poses.retain(|pose| pose.s != 3.0)));
    }
}
