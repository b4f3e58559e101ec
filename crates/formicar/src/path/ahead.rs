//! The part of a path that is still ahead.

use super::CurvePath;
use crate::geometry::{Pose2, angle_difference};

/// Halvings of the step between two samples: below rounding of any map.
const N_HALVINGS: u32 = 40;

impl CurvePath {
    /// How far along the path the pose is that is nearest to another, meters; heading differences
    /// count as so many meters per radian. Of several, the first.
    ///
    /// The path is sampled at least every `spacing_m`, and the best place made precise.
    pub fn nearest_m(&self, to: Pose2, meters_per_rad: f64, spacing_m: f64) -> f64 {
        let apart = |pose: Pose2| {
            let turn_rad = angle_difference(pose.heading, to.heading).abs();
            pose.position().distance(to.position()) + meters_per_rad * turn_rad
        };
        let samples = self.sample(spacing_m);
        let nearest = samples
            .iter()
            .min_by(|a, b| apart(a.pose).total_cmp(&apart(b.pose)));
        let mut best_m = nearest.map_or(0.0, |sample| sample.s_m);
        let mut best = apart(self.pose_at(best_m));
        let mut step_m = spacing_m;
        for _ in 0..N_HALVINGS {
            step_m *= 0.5;
            for s_m in [best_m - step_m, best_m + step_m] {
                let s_m = s_m.clamp(0.0, self.length_m());
                let here = apart(self.pose_at(s_m));
                if here < best {
                    (best, best_m) = (here, s_m);
                }
            }
        }
        best_m
    }

    /// The pose after driving so far; at most the last one.
    pub fn pose_at(&self, driven_m: f64) -> Pose2 {
        let mut left_m = driven_m;
        for segment in &self.segments {
            if left_m <= segment.length_m {
                return segment.pose_at(left_m.max(0.0));
            }
            left_m -= segment.length_m;
        }
        self.end()
    }

    /// The part of the path between two driven lengths.
    #[must_use]
    pub fn between_m(&self, from_m: f64, to_m: f64) -> Self {
        let mut begun_m = 0.0;
        let mut segments = Vec::new();
        for segment in &self.segments {
            let first_m = (from_m - begun_m).clamp(0.0, segment.length_m);
            let last_m = (to_m - begun_m).clamp(0.0, segment.length_m);
            if last_m > first_m {
                let mut part = *segment;
                if first_m > 0.0 {
                    part.start = segment.pose_at(first_m);
                    part.curvature_per_m = segment.curvature_at(first_m);
                }
                part.length_m = last_m - first_m;
                segments.push(part);
            }
            begun_m += segment.length_m;
        }
        let start = segments.first().map(|segment| segment.start);
        Self::from_segments(start.unwrap_or_else(|| self.pose_at(from_m)), segments)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::path::Direction;

    #[test]
    fn a_part_of_a_clothoid_is_on_the_clothoid() {
        let mut path = CurvePath::new(Pose2::new(1.0, 1.0, 0.0));
        path.push_clothoid([0.1, 0.9], 2.0, Direction::Forward);
        let part = path.between_m(0.7, 1.9);
        for s_m in [0.0, 0.5, 1.2] {
            let (a, b) = (part.pose_at(s_m), path.pose_at(0.7 + s_m));
            assert!(a.position().distance(b.position()) < 1e-9);
            assert!((a.heading - b.heading).abs() < 1e-12);
        }
    }

    /// Ahead, about a bend, and back in reverse.
    fn path() -> CurvePath {
        let mut path = CurvePath::new(Pose2::new(1.0, 1.0, 0.0));
        path.push(0.0, 3.0, Direction::Forward);
        path.push(0.5, 2.0, Direction::Forward);
        path.push(0.0, 1.5, Direction::Reverse);
        path
    }

    #[test]
    fn every_place_of_a_path_is_nearest_to_itself() {
        let path = path();
        for s_m in [0.0, 0.3, 3.0, 3.7, 5.0, 6.1, 6.5] {
            let found = path.nearest_m(path.pose_at(s_m), 1.0, 0.1);
            assert!((found - s_m).abs() < 1e-6, "{found} {s_m}");
        }
        let beside = Pose2::new(2.0, 1.4, 0.1);
        assert!((path.nearest_m(beside, 0.0, 0.1) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn parts_join_to_the_whole() {
        let path = path();
        let parts = [0.0, 1.0, 3.0, 4.2, 5.9, 9.0];
        let mut length_m = 0.0;
        for ends in parts.windows(2) {
            let part = path.between_m(ends[0], ends[1]);
            let apart_m = part
                .start()
                .position()
                .distance(path.pose_at(ends[0]).position());
            assert!(apart_m < 1e-9);
            let apart_m = part
                .end()
                .position()
                .distance(path.pose_at(ends[1]).position());
            assert!(apart_m < 1e-9);
            length_m += part.length_m();
        }
        assert!((length_m - path.length_m()).abs() < 1e-9);
        assert_eq!(path.between_m(0.0, 100.0), path);
        assert!(path.between_m(7.0, 8.0).segments().is_empty());
    }
}
