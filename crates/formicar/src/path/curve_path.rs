//! A drivable curve: straight lines and arcs, each driven forward or in reverse.

use crate::geometry::{Arc, Point2, Pose2};
use serde::{Deserialize, Serialize};

/// The gear.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(into = "i8", try_from = "i8")]
pub enum Direction {
    /// The vehicle moves along its heading; +1 in files.
    #[default]
    Forward,
    /// The vehicle moves against its heading; -1 in files.
    Reverse,
}

impl Direction {
    /// +1 forward, -1 in reverse.
    pub fn sign(self) -> f64 {
        match self {
            Self::Forward => 1.0,
            Self::Reverse => -1.0,
        }
    }
}

impl From<Direction> for i8 {
    fn from(direction: Direction) -> Self {
        match direction {
            Direction::Forward => 1,
            Direction::Reverse => -1,
        }
    }
}

impl TryFrom<i8> for Direction {
    type Error = String;
    fn try_from(sign: i8) -> Result<Self, String> {
        match sign {
            1 => Ok(Self::Forward),
            -1 => Ok(Self::Reverse),
            other => Err(format!(
                "direction {other}; it is 1 (forward) or -1 (reverse)"
            )),
        }
    }
}

/// A line or arc driven in one gear.
///
/// Along it the heading changes by `direction * curvature * length`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveSegment {
    /// The pose at its start.
    pub start: Pose2,
    /// tan(steer) / wheelbase, positive where the wheels point left; 0 on a line.
    pub curvature_per_m: f64,
    /// Driven length, at least 0.
    pub length_m: f64,
    /// The gear.
    pub direction: Direction,
}

impl CurveSegment {
    /// The pose after driving a part of the segment.
    pub fn pose_at(&self, driven_m: f64) -> Pose2 {
        self.start
            .advance(self.curvature_per_m, self.direction.sign() * driven_m)
    }

    /// The pose at its end.
    pub fn end(&self) -> Pose2 {
        self.pose_at(self.length_m)
    }
}

/// A pose of a sampled path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathPose {
    /// Where the vehicle is.
    pub pose: Pose2,
    /// Arc length driven so far, metres.
    pub s_m: f64,
    /// The gear in which the pose is reached.
    pub direction: Direction,
    /// Curvature of the segment on which the pose is reached.
    pub curvature_per_m: f64,
}

/// A chain of segments from a start pose.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CurvePath {
    start: Pose2,
    pub(super) segments: Vec<CurveSegment>,
}

impl CurvePath {
    /// The path that has not moved yet.
    pub fn new(start: Pose2) -> Self {
        Self {
            start,
            segments: Vec::new(),
        }
    }

    /// A path from given segments, whose joints nobody has checked: the judge will.
    pub fn from_segments(start: Pose2, segments: Vec<CurveSegment>) -> Self {
        Self { start, segments }
    }

    /// The path of a holonomic point along a polyline; repeated points are passed over.
    pub fn from_polyline(points: &[Point2]) -> Self {
        let lines: Vec<_> = points
            .windows(2)
            .filter(|w| w[0] != w[1])
            .map(|w| CurveSegment {
                start: Pose2::at(w[0], (w[1] - w[0]).angle()),
                curvature_per_m: 0.0,
                length_m: w[0].distance(w[1]),
                direction: Direction::Forward,
            })
            .collect();
        let at_rest = points
            .first()
            .map_or(Pose2::default(), |&p| Pose2::at(p, 0.0));
        Self::from_segments(lines.first().map_or(at_rest, |line| line.start), lines)
    }

    /// The path of arcs that are driven one after the other.
    pub fn from_arcs<'a>(start: Pose2, arcs: impl IntoIterator<Item = &'a Arc>) -> Self {
        let mut path = Self::new(start);
        for arc in arcs {
            let direction = if arc.signed_length_m < 0.0 {
                Direction::Reverse
            } else {
                Direction::Forward
            };
            path.push(arc.curvature_per_m, arc.length_m(), direction);
        }
        path
    }

    /// Drives on; merges with the last segment where curvature and gear are the same.
    pub fn push(&mut self, curvature_per_m: f64, length_m: f64, direction: Direction) {
        if length_m <= 0.0 {
            return;
        }
        let start = self.end();
        match self.segments.last_mut() {
            Some(last)
                if last.curvature_per_m == curvature_per_m && last.direction == direction =>
            {
                last.length_m += length_m;
            }
            _ => self.segments.push(CurveSegment {
                start,
                curvature_per_m,
                length_m,
                direction,
            }),
        }
    }

    /// The first pose.
    pub fn start(&self) -> Pose2 {
        self.start
    }

    /// The last pose.
    pub fn end(&self) -> Pose2 {
        self.segments.last().map_or(self.start, CurveSegment::end)
    }

    /// The segments in order.
    pub fn segments(&self) -> &[CurveSegment] {
        &self.segments
    }

    /// Driven length in metres.
    pub fn length_m(&self) -> f64 {
        // The sum of nothing is -0; nobody wants to read that.
        0.0 + self.segments.iter().map(|s| s.length_m).sum::<f64>()
    }

    /// The same path seen from another frame: every start pose mapped.
    #[must_use]
    pub fn map_poses(&self, mut to: impl FnMut(Pose2) -> Pose2) -> Self {
        let start = to(self.start);
        let segments = self
            .segments
            .iter()
            .map(|s| CurveSegment {
                start: to(s.start),
                ..*s
            })
            .collect();
        Self { start, segments }
    }

    /// Poses at most `spacing_m` apart, with both ends of every segment.
    pub fn sample(&self, spacing_m: f64) -> Vec<PathPose> {
        let first = self.segments.first();
        let mut poses = vec![PathPose {
            pose: self.start,
            s_m: 0.0,
            direction: first.map_or(Direction::Forward, |s| s.direction),
            curvature_per_m: first.map_or(0.0, |s| s.curvature_per_m),
        }];
        let mut s_m = 0.0;
        for segment in &self.segments {
            let n_steps = (segment.length_m / spacing_m).ceil().max(1.0) as usize;
            poses.extend((1..=n_steps).map(|i| {
                let driven = segment.length_m * i as f64 / n_steps as f64;
                PathPose {
                    pose: segment.pose_at(driven),
                    s_m: s_m + driven,
                    direction: segment.direction,
                    curvature_per_m: segment.curvature_per_m,
                }
            }));
            s_m += segment.length_m;
        }
        poses
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn pushing_the_same_motion_lengthens_the_segment() {
        let mut path = CurvePath::new(Pose2::new(1.0, 2.0, FRAC_PI_2));
        path.push(0.0, 1.0, Direction::Forward);
        path.push(0.0, 2.0, Direction::Forward);
        path.push(0.0, 1.0, Direction::Reverse);
        assert_eq!(path.segments().len(), 2);
        assert!((path.end().y - 4.0).abs() < 1e-12);
        assert!((path.length_m() - 4.0).abs() < 1e-12);
    }

    #[test]
    fn samples_hold_both_ends_and_the_spacing() {
        let mut path = CurvePath::new(Pose2::default());
        path.push(0.5, 1.05, Direction::Forward);
        path.push(-0.5, 0.3, Direction::Reverse);
        let poses = path.sample(0.1);
        assert_eq!(poses[0].pose, path.start());
        assert_eq!(poses[poses.len() - 1].pose, path.end());
        assert!(poses.windows(2).all(|w| w[1].s_m - w[0].s_m <= 0.1 + 1e-12));
    }
}
