//! A scan prepared for maps: hits, and the lines of the surfaces that they lie on.

use crate::scan::{LaserScan, RangeCounts, RangeKind, RangePolicy};
use formicar::Point2;
use serde::{Deserialize, Serialize};

/// The line of a surface between two neighboring beams, in the frame of the sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceLine {
    /// A point on it.
    pub point: Point2,
    /// Unit normal, towards the sensor.
    pub normal: Point2,
}

/// A scan with its hits, kept in single precision.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Sweep {
    /// Time of the scan, seconds.
    pub time_s: f64,
    /// Direction of beam 0, radians.
    pub first_angle_rad: f64,
    /// Angle from beam to beam, radians.
    pub angle_step_rad: f64,
    /// Range of each beam, meters; 0 where it is no hit.
    pub ranges_m: Vec<f32>,
}

impl Sweep {
    /// The hits of a scan, and the number of ranges of each kind.
    pub fn new(scan: &LaserScan, policy: &RangePolicy) -> (Self, RangeCounts) {
        let mut counts = RangeCounts::default();
        let hit = |(beam, &range): (usize, &f32)| {
            let kind = policy.kind(f64::from(range), scan.angle_rad(beam));
            counts.add(kind);
            if kind == RangeKind::Hit { range } else { 0.0 }
        };
        let ranges_m = scan.ranges_m.iter().enumerate().map(hit).collect();
        let sweep = Self {
            time_s: scan.time_s,
            first_angle_rad: scan.first_angle_rad,
            angle_step_rad: scan.angle_step_rad,
            ranges_m,
        };
        (sweep, counts)
    }

    /// The direction of a beam.
    pub fn direction(&self, beam: usize) -> Point2 {
        Point2::unit(self.first_angle_rad + self.angle_step_rad * beam as f64)
    }

    /// The hits in the frame of the sensor, in the order of the beams.
    pub fn points(&self) -> Vec<Point2> {
        let hits = self.ranges_m.iter().enumerate();
        let hits = hits.filter(|(_, range)| **range > 0.0);
        hits.map(|(beam, &range)| self.direction(beam) * f64::from(range))
            .collect()
    }

    /// Hits within `reach_m`, at least `spacing_m` apart from the one kept before, for matching:
    /// walls close to the sensor would outweigh the rest of the scan otherwise.
    pub fn thinned(&self, spacing_m: f64, reach_m: f64) -> Vec<Point2> {
        let mut kept: Vec<Point2> = Vec::new();
        for point in self.points() {
            if point.norm() > reach_m {
                continue;
            }
            if kept
                .last()
                .is_none_or(|last| last.distance(point) >= spacing_m)
            {
                kept.push(point);
            }
        }
        kept
    }

    /// True where two neighboring hits lie on one surface: the incidence is below about 76 degrees.
    pub fn is_connected(&self, beam: usize) -> bool {
        let Some(&[a, b]) = self.ranges_m.get(beam..beam + 2) else {
            return false;
        };
        let (a, b) = (f64::from(a), f64::from(b));
        a > 0.0 && b > 0.0 && (a - b).abs() < 4.0 * a.min(b) * self.angle_step_rad + 0.03
    }

    /// The surface line of each wedge, the sector between beam `i` and beam `i + 1`; none where the
    /// two do not hit one surface.
    ///
    /// Hits that are connected with the wedge and at most `reach_m` from its middle are fitted by
    /// total least squares; with two hits this is the line through them. Where the fit leaves more
    /// than `MAX_RESIDUAL_M`, the wedge spans a corner and takes the line of its own two hits.
    pub fn lines(&self, reach_m: f64) -> Vec<Option<SurfaceLine>> {
        let points: Vec<Point2> = (0..self.ranges_m.len())
            .map(|beam| self.direction(beam) * f64::from(self.ranges_m[beam]))
            .collect();
        let n_wedges = self.ranges_m.len().saturating_sub(1);
        (0..n_wedges)
            .map(|wedge| {
                self.is_connected(wedge)
                    .then(|| self.line(wedge, &points, reach_m))
            })
            .collect()
    }

    fn line(&self, wedge: usize, points: &[Point2], reach_m: f64) -> SurfaceLine {
        let own = &points[wedge..wedge + 2];
        let middle = own[0].lerp(own[1], 0.5);
        let (mut first, mut last) = (wedge, wedge + 1);
        while first > 0
            && last - first < MAX_FITTED
            && self.is_connected(first - 1)
            && points[first - 1].distance(middle) <= reach_m
        {
            first -= 1;
        }
        while last + 1 < points.len()
            && last - first < 2 * MAX_FITTED
            && self.is_connected(last)
            && points[last + 1].distance(middle) <= reach_m
        {
            last += 1;
        }
        let (line, residual_m) = fitted(&points[first..=last]);
        if residual_m <= MAX_RESIDUAL_M {
            line
        } else {
            fitted(own).0
        }
    }
}

/// Root mean square distance of hits from their common line above which they span a corner, meters.
const MAX_RESIDUAL_M: f64 = 0.02;
/// Most neighbors on each side that are fitted together.
const MAX_FITTED: usize = 24;

/// The line of least squared distances through points, and the root mean square distance.
fn fitted(points: &[Point2]) -> (SurfaceLine, f64) {
    let n = points.len() as f64;
    let sum = points.iter().fold(Point2::default(), |sum, &p| sum + p);
    let center = sum * (1.0 / n);
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for &point in points {
        let d = point - center;
        xx += d.x * d.x;
        xy += d.x * d.y;
        yy += d.y * d.y;
    }
    // The direction of largest spread.
    let angle = 0.5 * (2.0 * xy).atan2(xx - yy);
    let along = Point2::unit(angle);
    let normal = along.perpendicular();
    let across =
        normal.x * normal.x * xx + 2.0 * normal.x * normal.y * xy + normal.y * normal.y * yy;
    let normal = if normal.dot(center) > 0.0 {
        -normal
    } else {
        normal
    };
    let line = SurfaceLine {
        point: center,
        normal,
    };
    (line, (across.max(0.0) / n).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A scan of a wall at x = 2 m.
    fn wall() -> Sweep {
        let range = |beam: i32| (2.0 / (f64::from(beam - 30) * 0.02).cos()) as f32;
        Sweep {
            time_s: 0.0,
            first_angle_rad: -0.6,
            angle_step_rad: 0.02,
            ranges_m: (0..61).map(range).collect(),
        }
    }

    #[test]
    fn lines_of_a_wall_are_the_wall() {
        for reach_m in [0.0, 0.3] {
            for line in wall().lines(reach_m) {
                let line = line.unwrap();
                assert!((line.point.x - 2.0).abs() < 1e-5);
                assert!((line.normal.x + 1.0).abs() < 1e-4, "{line:?}");
            }
        }
    }

    #[test]
    fn a_step_connects_nothing_and_a_corner_is_kept() {
        let mut sweep = wall();
        for range in &mut sweep.ranges_m[30..] {
            *range += 1.0;
        }
        let lines = sweep.lines(0.3);
        assert!(lines[29].is_none());
        assert!((lines[28].unwrap().point.x - 2.0).abs() < 1e-5);
    }

    #[test]
    fn thinned_points_keep_their_distance() {
        let thinned = wall().thinned(0.1, 20.0);
        assert!(
            thinned
                .windows(2)
                .all(|pair| pair[0].distance(pair[1]) >= 0.1)
        );
        assert!(thinned.len() > 10 && thinned.len() < 40);
    }
}
