//! The update of 2D-SDF-SLAM (Fossel, Tuyls & Sturm, IROS 2015): regression and priority.
//!
//! Read from the authors' published code; `references/fossel2015.md` lists what was read how.

use super::map::{SdfCell, SdfMap};
use super::sweep::Sweep;
use super::tiles::Place;
use formicar::{Point2, Pose2};
use serde::{Deserialize, Serialize};

/// Parameters of the update.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FosselRule {
    /// Surfaces farther from the sensor are not inserted, meters.
    pub reach_m: f64,
    /// Vertices up to this many rings around the dual cell of a hit are updated.
    pub n_rings: i32,
}

impl Default for FosselRule {
    fn default() -> Self {
        Self {
            reach_m: 20.0,
            n_rings: 5,
        }
    }
}

/// A vertex of ring k has the weight `RINGS - k`: the priority, kept in the place of a weight.
const RINGS: f32 = 8.0;

impl SdfMap {
    /// Inserts a scan by regression lines in dual cells.
    ///
    /// Consecutive hits in one dual cell (the square between four vertices) are a group; a single
    /// hit borrows its nearer neighbor. Vertices around the cell take the distance to the group's
    /// regression line, with the sign of the sensor's side. Where signs conflict, the nearer ring
    /// wins; in one ring, the value nearer to zero.
    pub fn insert_fossel(&mut self, sweep: &Sweep, pose: Pose2, rule: &FosselRule) {
        let hits: Vec<Point2> = sweep
            .points()
            .into_iter()
            .filter(|hit| hit.norm() <= rule.reach_m)
            .map(|hit| pose.transform(hit))
            .collect();
        let cell = |point: Point2| {
            let scaled = point * (1.0 / self.resolution_m);
            (scaled.x.floor() as i32, scaled.y.floor() as i32)
        };
        let mut first = 0;
        let mut groups = Vec::new();
        while first < hits.len() {
            let place = cell(hits[first]);
            let n = hits[first..].iter().take_while(|hit| cell(**hit) == place);
            let end = first + n.count();
            groups.push((place, first..end));
            first = end;
        }
        for (place, range) in groups {
            let group = if range.len() > 1 {
                hits[range].to_vec()
            } else {
                with_neighbor(&hits, range.start)
            };
            if let Some(line) = Segment::through(&group, pose.position()) {
                self.update_around(place, &line, rule.n_rings);
            }
        }
    }

    fn update_around(&mut self, cell: Place, line: &Segment, n_rings: i32) {
        let (resolution, truncation) = (self.resolution_m, self.truncation_m);
        let half = 0.5 * resolution;
        for y in cell.1 - n_rings..=cell.1 + 1 + n_rings {
            let (from, to) = (cell.0 - n_rings, cell.0 + 1 + n_rings);
            self.cells.update_row(y, from, to, |x, vertex| {
                // Rings count from the four corners of the cell.
                let outside = |v: i32, low: i32| (low - v).max(v - low - 1).max(0);
                let ring = outside(x, cell.0).max(outside(y, cell.1));
                let point = Point2::new(f64::from(x), f64::from(y)) * resolution;
                if let Some(distance) = line.distance(point, half) {
                    let distance = distance.clamp(-truncation, truncation) as f32;
                    take(vertex, distance, RINGS - ring as f32);
                }
            });
        }
    }
}

/// A hit and the nearer of its two neighbors in the scan.
fn with_neighbor(hits: &[Point2], at: usize) -> Vec<Point2> {
    let hit = hits[at];
    let neighbors = [at.checked_sub(1), Some(at + 1)];
    let neighbors = neighbors.into_iter().flatten().filter_map(|i| hits.get(i));
    let nearer = neighbors.min_by(|a, b| a.distance(hit).total_cmp(&b.distance(hit)));
    std::iter::once(hit).chain(nearer.copied()).collect()
}

/// The rule of priority.
fn take(vertex: &mut SdfCell, distance_m: f32, priority: f32) {
    let is_new = vertex.weight == 0.0;
    let conflicts = (vertex.distance_m < 0.0) != (distance_m < 0.0);
    let wins = if conflicts || priority != vertex.weight {
        priority > vertex.weight
    } else {
        distance_m.abs() < vertex.distance_m.abs()
    };
    if is_new || wins {
        *vertex = SdfCell {
            distance_m,
            weight: priority,
        };
    }
}

/// A regression line clipped to its hits.
struct Segment {
    center: Point2,
    along: Point2,
    half_length_m: f64,
    normal: Point2,
}

impl Segment {
    /// The orthogonal regression line of hits, whose normal points to the sensor.
    fn through(hits: &[Point2], sensor: Point2) -> Option<Self> {
        let n = hits.len() as f64;
        if hits.len() < 2 {
            return None;
        }
        let center = hits.iter().fold(Point2::default(), |sum, &hit| sum + hit) * (1.0 / n);
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        for &hit in hits {
            let d = hit - center;
            xx += d.x * d.x;
            xy += d.x * d.y;
            yy += d.y * d.y;
        }
        if xx + yy == 0.0 {
            return None;
        }
        // Deming regression with equal variances: the same line as that of slope
        // (syy - sxx + sqrt((syy - sxx)^2 + 4 sxy^2)) / (2 sxy), without its special cases.
        let along = Point2::unit(0.5 * (2.0 * xy).atan2(xx - yy));
        let normal = along.perpendicular();
        let normal = if normal.dot(sensor - center) < 0.0 {
            -normal
        } else {
            normal
        };
        let reaches = hits.iter().map(|&hit| along.dot(hit - center).abs());
        Some(Self {
            center,
            along,
            half_length_m: reaches.fold(0.0, f64::max),
            normal,
        })
    }

    /// Signed distance of a vertex whose foot lies on the segment, lengthened by `slack_m`.
    fn distance(&self, point: Point2, slack_m: f64) -> Option<f64> {
        let d = point - self.center;
        let is_beside = self.along.dot(d).abs() <= self.half_length_m.max(slack_m) + slack_m;
        is_beside.then(|| self.normal.dot(d))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sdf::SignedDistances;

    #[test]
    fn a_wall_has_its_distances_and_the_nearer_ring_wins() {
        let range = |beam: i32| (2.02 / (f64::from(beam - 30) * 0.01).cos()) as f32;
        let sweep = Sweep {
            time_s: 0.0,
            first_angle_rad: -0.3,
            angle_step_rad: 0.01,
            ranges_m: (0..61).map(range).collect(),
        };
        let mut map = SdfMap::new(0.05, 0.25);
        map.insert_fossel(&sweep, Pose2::default(), &FosselRule::default());
        for col in 37..=44 {
            let truth = 2.02 - 0.05 * f64::from(col);
            let value = f64::from(map.distance((col, 2)));
            assert!((value - truth).abs() < 2e-3, "{col}: {value} for {truth}");
        }
        let mut vertex = SdfCell::default();
        take(&mut vertex, 0.1, 3.0);
        take(&mut vertex, -0.2, 2.0);
        assert_eq!(
            vertex.distance_m, 0.1,
            "a farther ring does not turn the sign"
        );
        take(&mut vertex, -0.2, 5.0);
        assert_eq!(vertex.distance_m, -0.2, "a nearer ring does");
    }
}
