//! A stretch of a path that is driven in one gear, seen in the travel frame.

use super::TrackingError;
use crate::geometry::{Point2, Pose2};
use crate::path::{CurvePath, CurveSegment, Direction};
use crate::validation::JOINT_TOLERANCE;
use std::f64::consts::{PI, TAU};

/// Turns slighter than this have no center to measure angles about, 1/m.
const STRAIGHT_PER_M: f64 = 1e-9;

/// Lines and arcs in one gear (clothoids cut into arcs), all driven forward: in reverse the poses
/// face the other way. Before its begin and beyond its end the first and the last line or arc go
/// on.
#[derive(Clone, Debug)]
pub(super) struct Stretch {
    pub(super) direction: Direction,
    pieces: Vec<Piece>,
}

#[derive(Clone, Copy, Debug)]
struct Piece {
    start: Pose2,
    curvature_per_m: f64,
    begin_m: f64,
    end_m: f64,
}

/// A pose of the vehicle in the travel frame, or back.
pub(super) fn faced(pose: Pose2, direction: Direction) -> Pose2 {
    match direction {
        Direction::Forward => pose,
        Direction::Reverse => Pose2::at(pose.position(), pose.heading + PI),
    }
}

/// Arcs that stand for a clothoid end at most so far from it, meters.
const CLOTHOID_GAP_M: f64 = 0.1 * JOINT_TOLERANCE;

/// The stretches of a path; none where it has no length.
pub(super) fn stretches(path: &CurvePath) -> Result<Vec<Stretch>, TrackingError> {
    check(path)?;
    let path = path.with_arcs(CLOTHOID_GAP_M);
    let segments: Vec<_> = path
        .segments()
        .iter()
        .filter(|s| s.length_m > 0.0)
        .collect();
    let gears = segments.chunk_by(|a, b| a.direction == b.direction);
    Ok(gears.map(Stretch::new).collect())
}

fn check(path: &CurvePath) -> Result<(), TrackingError> {
    let mut expected = path.start();
    if !expected.is_finite() {
        return Err(TrackingError::NotFinite { index: 0 });
    }
    for (index, segment) in path.segments().iter().enumerate() {
        let numbers = segment.curvature_per_m * segment.length_m + segment.end_curvature_per_m();
        if !(segment.start.is_finite() && numbers.is_finite() && segment.length_m >= 0.0) {
            return Err(TrackingError::NotFinite { index });
        }
        let gap_m = expected.position().distance(segment.start.position());
        if gap_m > JOINT_TOLERANCE {
            let limit_m = JOINT_TOLERANCE;
            return Err(TrackingError::Gap {
                index,
                gap_m,
                limit_m,
            });
        }
        expected = segment.end();
    }
    Ok(())
}

impl Stretch {
    fn new(segments: &[&CurveSegment]) -> Self {
        let direction = segments[0].direction;
        let mut end_m = 0.0;
        let pieces = segments.iter().map(|segment| {
            let begin_m = end_m;
            end_m += segment.length_m;
            Piece {
                start: faced(segment.start, direction),
                curvature_per_m: direction.sign() * segment.curvature_per_m,
                begin_m,
                end_m,
            }
        });
        Self {
            pieces: pieces.collect(),
            direction,
        }
    }

    pub(super) fn length_m(&self) -> f64 {
        self.pieces.last().map_or(0.0, |piece| piece.end_m)
    }

    /// The pose at a place.
    pub(super) fn pose_at(&self, s_m: f64) -> Pose2 {
        let piece = &self.pieces[self.place(s_m)];
        piece
            .start
            .advance(piece.curvature_per_m, s_m - piece.begin_m)
    }

    /// The curvature from a place on, positive left in the travel frame.
    pub(super) fn curvature_at(&self, s_m: f64) -> f64 {
        self.pieces[self.place(s_m)].curvature_per_m
    }

    /// The end of the line or arc that goes on from a place.
    pub(super) fn next_joint_m(&self, s_m: f64) -> f64 {
        self.pieces[self.place(s_m)].end_m
    }

    /// The place whose track is nearest to a point: that of the rear axle, or of a point `lead_m`
    /// ahead of it. Looked for from a place on, uphill and down, so that a path which comes by
    /// again is no distraction.
    pub(super) fn foot_m(&self, point: Point2, lead_m: f64, from_m: f64) -> f64 {
        let mut i = self.place(from_m);
        let mut foot_m = self.pieces[i].foot_m(point, lead_m, from_m);
        while foot_m > self.pieces[i].end_m && i + 1 < self.pieces.len() {
            i += 1;
            let begin_m = self.pieces[i].begin_m;
            foot_m = self.pieces[i].foot_m(point, lead_m, begin_m);
            if foot_m <= begin_m {
                return begin_m;
            }
        }
        while foot_m < self.pieces[i].begin_m && i > 0 {
            i -= 1;
            let end_m = self.pieces[i].end_m;
            foot_m = self.pieces[i].foot_m(point, lead_m, end_m);
            if foot_m >= end_m {
                return end_m;
            }
        }
        foot_m
    }

    fn place(&self, s_m: f64) -> usize {
        let begun = self.pieces.partition_point(|piece| piece.begin_m <= s_m);
        begun.saturating_sub(1)
    }
}

impl Piece {
    /// As [`Stretch::foot_m`], on the whole line or circle; of the turns of a circle the one
    /// nearest to a place.
    fn foot_m(&self, point: Point2, lead_m: f64, near_m: f64) -> f64 {
        let k = self.curvature_per_m;
        let Point2 { x, y } = self.start.relative(Pose2::at(point, 0.0)).position();
        if k.abs() < STRAIGHT_PER_M {
            return self.begin_m + x - lead_m;
        }
        // The angle about the center from where the leading point starts.
        let turn = (k * x).atan2(1.0 - k * y) - (k * lead_m).atan();
        let near = k * (near_m - self.begin_m);
        let turn = turn + TAU * ((near - turn) / TAU).round();
        self.begin_m + turn / k
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn only(path: &CurvePath) -> Stretch {
        stretches(path).unwrap().remove(0)
    }

    fn winding() -> CurvePath {
        let mut path = CurvePath::new(Pose2::new(1.0, -2.0, 0.4));
        path.push(0.0, 3.0, Direction::Forward);
        path.push(0.4, 9.0, Direction::Forward);
        path.push(-0.3, 5.0, Direction::Forward);
        path
    }

    #[test]
    fn the_foot_is_nearest_among_its_neighbors() {
        let stretch = only(&winding());
        for (i, lead_m) in (0..340).zip([0.0, 1.5].into_iter().cycle()) {
            let s_m = 0.05 * f64::from(i);
            let beside = 0.9 * (0.7 * f64::from(i)).sin();
            let tracked = |s_m| stretch.pose_at(s_m).transform(Point2::new(lead_m, 0.0));
            let point = stretch.pose_at(s_m).transform(Point2::new(lead_m, beside));
            let foot_m = stretch.foot_m(point, lead_m, s_m);
            let distance = |s_m| point.distance(tracked(s_m));
            for other_m in [-0.01, -0.001, 0.001, 0.01].map(|d| foot_m + d) {
                assert!(
                    distance(foot_m) <= distance(other_m) + 1e-9,
                    "{s_m} {foot_m}"
                );
            }
        }
    }

    #[test]
    fn the_first_and_the_last_piece_go_on() {
        let stretch = only(&winding());
        let before = stretch.pose_at(-2.0);
        assert!((stretch.foot_m(before.position(), 0.0, 0.0) + 2.0).abs() < 1e-12);
        let beyond = stretch.pose_at(17.5);
        assert!((stretch.foot_m(beyond.position(), 0.0, 17.0) - 17.5).abs() < 1e-12);
    }

    #[test]
    fn the_second_lap_is_not_the_first() {
        let mut path = CurvePath::default();
        path.push(0.5, 30.0, Direction::Forward);
        let stretch = only(&path);
        let point = stretch.pose_at(20.0).position();
        assert!((stretch.foot_m(point, 0.0, 19.5) - 20.0).abs() < 1e-9);
    }

    #[test]
    fn reverse_faces_the_other_way() {
        let mut path = CurvePath::new(Pose2::new(2.0, 1.0, 0.3));
        path.push(0.2, 4.0, Direction::Reverse);
        let stretch = only(&path);
        let end = faced(stretch.pose_at(4.0), Direction::Reverse);
        assert!(end.position().distance(path.end().position()) < 1e-12);
        assert!((end.wrapped().heading - path.end().heading).abs() < 1e-12);
        assert_eq!(stretch.curvature_at(1.0), -0.2);
    }

    #[test]
    fn refuses_paths_that_jump_or_are_no_numbers() {
        let segment = |x, length_m| CurveSegment {
            start: Pose2::new(x, 0.0, 0.0),
            curvature_per_m: 0.0,
            curvature_rate_per_m2: 0.0,
            length_m,
            direction: Direction::Forward,
        };
        let error = |segments: Vec<_>| {
            let path = CurvePath::from_segments(Pose2::default(), segments);
            stretches(&path).unwrap_err()
        };
        let jump = error(vec![segment(0.0, 1.0), segment(1.5, 1.0)]);
        assert!(jump.to_string().contains("0.5 m to segment 1"), "{jump}");
        for length_m in [-1.0, f64::NAN, f64::INFINITY] {
            let error = error(vec![segment(0.0, length_m)]);
            assert_eq!(error, TrackingError::NotFinite { index: 0 });
        }
    }
}
