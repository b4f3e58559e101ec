//! Points at equal steps of arc length.

use crate::geometry::Pose2;
use crate::path::CurvePath;

/// `n_points` poses at equal arc length from the first pose to the last; one where the path has
/// no length, none where `n_points` is 0.
pub(super) fn resampled(path: &CurvePath, n_points: usize) -> Vec<Pose2> {
    let length_m = path.length_m();
    if n_points < 2 || length_m <= 0.0 {
        return vec![path.start(); n_points.min(1)];
    }
    let mut poses = Vec::with_capacity(n_points);
    let (mut segments, mut begin_m) = (path.segments().iter().peekable(), 0.0);
    let last = n_points - 1;
    for i in 0..last {
        let s_m = length_m * i as f64 / last as f64;
        while let Some(segment) = segments.next_if(|s| begin_m + s.length_m <= s_m) {
            begin_m += segment.length_m;
        }
        // Rounding may leave no segment for the last steps.
        let pose = segments.peek().map(|s| s.pose_at(s_m - begin_m));
        poses.push(pose.unwrap_or_else(|| path.end()));
    }
    poses.push(path.end());
    poses
}

/// Points closer than this are one, meters.
pub(super) const SAME_POINT_M: f64 = 1e-9;

/// The same poses, where a point that differs from the last by rounding alone is made equal to
/// it: where a path turns back midway between two samples, they fall on one point.
pub(super) fn without_rounding(mut poses: Vec<Pose2>) -> Vec<Pose2> {
    for i in 1..poses.len() {
        let last = poses[i - 1].position();
        if last.distance(poses[i].position()) < SAME_POINT_M {
            poses[i] = Pose2::at(last, poses[i].heading);
        }
    }
    poses
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::path::Direction;

    #[test]
    fn steps_are_equal_across_joints() {
        let mut path = CurvePath::new(Pose2::default());
        path.push(0.0, 1.0, Direction::Forward);
        path.push(0.0, 0.5, Direction::Reverse);
        let xs: Vec<f64> = resampled(&path, 7).iter().map(|p| p.x).collect();
        assert_eq!(xs, [0.0, 0.25, 0.5, 0.75, 1.0, 0.75, 0.5]);
    }

    #[test]
    fn a_path_without_length_has_one_point() {
        assert_eq!(resampled(&CurvePath::default(), 500).len(), 1);
        assert!(resampled(&CurvePath::default(), 0).is_empty());
    }
}
