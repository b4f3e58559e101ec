//! Rays counted cell by cell: those that end in a cell and those that pass it.

use crate::sdf::{Place, Sweep, Tiles};
use formicar::{Point2, Pose2};
use serde::{Deserialize, Serialize};

/// Rays of one cell.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct RayCount {
    /// Rays that end in it.
    pub hits: u32,
    /// Rays that pass it.
    pub misses: u32,
}

/// Ray counts on the lattice of a map; cell (0, 0) is centered on the origin.
#[derive(Clone, Debug, PartialEq)]
pub struct RayCounts {
    resolution_m: f64,
    cells: Tiles<RayCount>,
}

impl RayCounts {
    /// No rays yet.
    pub fn new(resolution_m: f64) -> Self {
        Self {
            resolution_m,
            cells: Tiles::new(RayCount::default()),
        }
    }

    /// The rays of a cell.
    pub fn get(&self, place: Place) -> RayCount {
        self.cells.get(place)
    }

    /// Memory in use, bytes.
    pub fn memory_bytes(&self) -> usize {
        self.cells.memory_bytes()
    }

    /// Cells with a ray.
    pub fn seen(&self) -> impl Iterator<Item = Place> {
        let seen = self.cells.iter();
        let seen = seen.filter(|(_, count)| count.hits + count.misses > 0);
        seen.map(|(place, _)| place)
    }

    /// Adds the rays of a scan; those longer than `reach_m` pass cells up to there and end nowhere.
    pub fn add(&mut self, sweep: &Sweep, pose: Pose2, reach_m: f64) {
        let scale = 1.0 / self.resolution_m;
        let from = pose.position() * scale;
        for (beam, &range) in sweep.ranges_m.iter().enumerate() {
            let range = f64::from(range);
            if range <= 0.0 {
                continue;
            }
            let angle = sweep.first_angle_rad + sweep.angle_step_rad * beam as f64;
            let along = Point2::unit(pose.heading + angle);
            let end = from + along * (range.min(reach_m) * scale);
            let last = self.pass(from, end);
            if range <= reach_m {
                self.cells.update(last, |count| count.hits += 1);
            }
        }
    }

    /// Counts a miss in every cell between two points in cells, and returns the last cell, without
    /// a miss.
    fn pass(&mut self, from: Point2, end: Point2) -> Place {
        // Cell i spans i - 0.5 to i + 0.5.
        let cell = |v: f64| (v + 0.5).floor() as i32;
        let mut at = (cell(from.x), cell(from.y));
        let last = (cell(end.x), cell(end.y));
        let d = end - from;
        let axis = |from: f64, d: f64, at: i32| {
            let step = if d >= 0.0 { 1 } else { -1 };
            let edge = f64::from(at) + 0.5 * f64::from(step);
            let next = if d == 0.0 {
                f64::INFINITY
            } else {
                (edge - from) / d
            };
            (step, next, (1.0 / d).abs())
        };
        let (step_x, mut next_x, stride_x) = axis(from.x, d.x, at.0);
        let (step_y, mut next_y, stride_y) = axis(from.y, d.y, at.1);
        let n_steps = last.0.abs_diff(at.0) + last.1.abs_diff(at.1);
        for _ in 0..n_steps {
            self.cells.update(at, |count| count.misses += 1);
            // Rounding at the end must not lead past the last cell.
            let is_x = if at.0 == last.0 {
                false
            } else {
                at.1 == last.1 || next_x < next_y
            };
            if is_x {
                at.0 += step_x;
                next_x += stride_x;
            } else {
                at.1 += step_y;
                next_y += stride_y;
            }
        }
        last
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_ray_passes_connected_cells_close_to_it(
            x in -3.0..3.0_f64, y in -3.0..3.0_f64, angle in -4.0..4.0_f64, range in 0.2..6.0_f64,
        ) {
            let mut counts = RayCounts::new(0.05);
            let sweep = Sweep {
                time_s: 0.0,
                first_angle_rad: 0.0,
                angle_step_rad: 0.1,
                ranges_m: vec![range as f32],
            };
            let pose = Pose2::new(x, y, angle);
            counts.add(&sweep, pose, 20.0);
            let end = pose.position() + Point2::unit(angle) * f64::from(range as f32);
            let along = Point2::unit(angle);
            let (mut n_hits, mut n_misses) = (0, 0);
            for place in counts.seen() {
                let center = Point2::new(f64::from(place.0), f64::from(place.1)) * 0.05;
                let aside = along.cross(center - pose.position()).abs();
                prop_assert!(aside <= 0.05 * 0.708, "{aside}");
                let count = counts.get(place);
                n_hits += count.hits;
                n_misses += count.misses;
                if count.hits > 0 {
                    prop_assert!(center.distance(end) < 0.036);
                    prop_assert_eq!(count.misses, 0);
                }
            }
            let d = (end - pose.position()) * 20.0;
            prop_assert_eq!(n_hits, 1);
            prop_assert!(f64::from(n_misses) <= d.x.abs() + d.y.abs() + 2.0);
            prop_assert!(f64::from(n_misses) >= d.x.abs().max(d.y.abs()) - 1.0);
        }
    }

    #[test]
    fn long_rays_end_nowhere() {
        let mut counts = RayCounts::new(0.1);
        let sweep = Sweep {
            time_s: 0.0,
            first_angle_rad: 0.0,
            angle_step_rad: 0.1,
            ranges_m: vec![9.0, 0.0],
        };
        counts.add(&sweep, Pose2::default(), 2.0);
        assert_eq!(counts.get((15, 0)), RayCount { hits: 0, misses: 1 });
        assert_eq!(counts.get((25, 0)), RayCount::default());
        assert!(counts.seen().all(|place| counts.get(place).hits == 0));
    }
}
