//! Scans into the map: every vertex of a wedge takes its distance to the line between two hits.

use super::map::{SdfCell, SdfMap, floor};
use super::sweep::{SurfaceLine, Sweep};
use formicar::{Point2, Pose2};
use serde::{Deserialize, Serialize};

/// Parameters of the insertion by wedges.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct WedgeRule {
    /// Surfaces farther from the sensor are not inserted, meters.
    pub reach_m: f64,
    /// Hits this far from the middle of a wedge take part in its line, meters; 0 for the line
    /// through its two hits.
    pub line_reach_m: f64,
    /// Largest weight of a vertex: the map forgets what was seen longer ago.
    pub max_weight: f64,
    /// Weight of free ground relative to that of a surface.
    pub free_weight: f64,
    /// Factor on the weight of free ground where a surface is known: values of a surface in this
    /// place beat those from afar (the priority of Fossel et al. 2015).
    pub priority: f64,
}

impl Default for WedgeRule {
    fn default() -> Self {
        Self {
            reach_m: 20.0,
            line_reach_m: 0.15,
            max_weight: 50.0,
            free_weight: 1.0,
            priority: 0.2,
        }
    }
}

impl SdfMap {
    /// Inserts a scan taken from a pose of the sensor.
    ///
    /// `lines` are those of [`Sweep::lines`]. Cost is proportional to the vertices that the scan
    /// sees.
    pub fn insert(
        &mut self,
        sweep: &Sweep,
        lines: &[Option<SurfaceLine>],
        pose: Pose2,
        rule: &WedgeRule,
    ) {
        let n_beams = sweep.ranges_m.len();
        let turn = |beam: usize| {
            let angle = sweep.first_angle_rad + sweep.angle_step_rad * beam as f64;
            Point2::unit(pose.heading + angle)
        };
        let beams: Vec<Point2> = (0..n_beams).map(turn).collect();
        let mut wedges = Wedges {
            map: self,
            rule,
            sensor: pose.position(),
        };
        for beam in 0..n_beams.saturating_sub(1) {
            let rays = [beams[beam], beams[beam + 1]];
            let ranges = [sweep.ranges_m[beam], sweep.ranges_m[beam + 1]].map(f64::from);
            match lines[beam] {
                Some(line) => wedges.surface(rays, ranges, world(line, pose)),
                None => wedges.gap(rays, ranges),
            }
        }
    }
}

fn world(line: SurfaceLine, pose: Pose2) -> SurfaceLine {
    SurfaceLine {
        point: pose.transform(line.point),
        normal: Pose2::new(0.0, 0.0, pose.heading).transform(line.normal),
    }
}

/// One scan on its way into a map.
struct Wedges<'a> {
    map: &'a mut SdfMap,
    rule: &'a WedgeRule,
    sensor: Point2,
}

impl Wedges<'_> {
    /// A wedge that ends on a surface.
    fn surface(&mut self, rays: [Point2; 2], ranges: [f64; 2], line: SurfaceLine) {
        let nearest = ranges[0].min(ranges[1]);
        if nearest > self.rule.reach_m {
            return self.free(rays, self.rule.reach_m);
        }
        let beyond = 2.0 * self.map.truncation_m;
        let ends = [0, 1].map(|i| self.sensor + rays[i] * (ranges[i] + beyond));
        let (truncation, resolution) = (self.map.truncation_m, self.map.resolution_m);
        let (rule, sensor) = (self.rule, self.sensor);
        let normal = line.normal;
        let farthest = (ranges[0].max(ranges[1]) + truncation).powi(2);
        self.rows(rays, ends, |map, y, from, to| {
            let at = Point2::new(f64::from(from), f64::from(y)) * resolution;
            let first = normal.dot(at - line.point);
            let slope = normal.x * resolution;
            let distance = |x: i32| first + slope * f64::from(x - from);
            // Most vertices are free: the ends of the row tell when all of them are.
            if distance(from).min(distance(to)) >= truncation {
                map.cells
                    .update_row(y, from, to, |_, cell| see_free(cell, truncation, rule));
                return;
            }
            map.cells.update_row(y, from, to, |x, cell| {
                let distance = distance(x);
                let here = || Point2::new(f64::from(x), f64::from(y)) * resolution - sensor;
                if distance >= truncation {
                    see_free(cell, truncation, rule);
                } else if distance > -truncation && here().dot(here()) <= farthest {
                    let weight = weight_at(distance, resolution, truncation);
                    see(cell, distance, weight, rule.max_weight);
                }
            });
        });
    }

    /// A wedge between two hits of different surfaces, or with one hit or none.
    fn gap(&mut self, rays: [Point2; 2], ranges: [f64; 2]) {
        let nearest = ranges[0].min(ranges[1]);
        let truncation = self.map.truncation_m;
        if nearest > truncation {
            self.free(rays, (nearest - truncation).min(self.rule.reach_m));
        }
        let sides = [1.0, -1.0];
        for ((ray, range), side) in rays.into_iter().zip(ranges).zip(sides) {
            if range > 0.0 && range <= self.rule.reach_m {
                self.stub(ray, range, side);
            }
        }
    }

    /// Free ground up to a range.
    fn free(&mut self, rays: [Point2; 2], up_to_m: f64) {
        let ends = rays.map(|ray| self.sensor + ray * up_to_m);
        let (truncation, rule) = (self.map.truncation_m, self.rule);
        let middle = (rays[0] + rays[1]) * 0.5;
        let limit = middle.dot(middle).sqrt() * up_to_m;
        let (sensor, resolution) = (self.sensor, self.map.resolution_m);
        let middle = middle * (1.0 / middle.norm());
        self.rows(rays, ends, |map, y, from, to| {
            map.cells.update_row(y, from, to, |x, cell| {
                let here = Point2::new(f64::from(x), f64::from(y)) * resolution - sensor;
                if middle.dot(here) <= limit {
                    see_free(cell, truncation, rule);
                }
            });
        });
    }

    /// The end of a beam whose neighbor hits something else: vertices within 0.6 cells of it, on
    /// one side (1 left, -1 right).
    fn stub(&mut self, ray: Point2, range: f64, side: f64) {
        let (truncation, resolution) = (self.map.truncation_m, self.map.resolution_m);
        let half_width = 0.6 * resolution;
        let across = ray.perpendicular() * half_width;
        let (near, far) = (
            self.sensor + ray * (range - truncation),
            self.sensor + ray * (range + truncation),
        );
        let corners = [near - across, near + across, far - across, far + across];
        let (low, high) = bounds(&corners, resolution);
        let max_weight = self.rule.max_weight;
        for y in low.1..=high.1 {
            self.map.cells.update_row(y, low.0, high.0, |x, cell| {
                let here = Point2::new(f64::from(x), f64::from(y)) * resolution - self.sensor;
                let lateral = ray.cross(here) * side;
                let distance = range - ray.dot(here);
                if (0.0..=half_width).contains(&lateral) && distance.abs() < truncation {
                    let weight = 0.5 * weight_at(distance, resolution, truncation);
                    see(cell, distance, weight, max_weight);
                }
            });
        }
    }

    /// The vertices of a wedge, row by row: those from the first ray on, up to but without the
    /// second, in the box of the sensor and two ends.
    ///
    /// Neighboring wedges share a ray to the bit, so that every vertex belongs to one wedge.
    fn rows(
        &mut self,
        rays: [Point2; 2],
        ends: [Point2; 2],
        mut visit: impl FnMut(&mut SdfMap, i32, i32, i32),
    ) {
        let resolution = self.map.resolution_m;
        let (low, high) = bounds(&[self.sensor, ends[0], ends[1]], resolution);
        let origin = self.sensor * (1.0 / resolution);
        let [first, second] = rays;
        let (first_slope, second_slope) = (first.x / first.y, second.x / second.y);
        for y in low.1..=high.1 {
            let dy = f64::from(y) - origin.y;
            let (mut from, mut to) = (low.0, high.0);
            // cross(first, d) >= 0, that is first.y * dx <= first.x * dy.
            if first.y > 0.0 {
                to = to.min(floor(origin.x + first_slope * dy));
            } else if first.y < 0.0 {
                from = from.max(-floor(-(origin.x + first_slope * dy)));
            } else if first.x * dy < 0.0 {
                continue;
            }
            // cross(second, d) < 0, that is second.y * dx > second.x * dy.
            if second.y > 0.0 {
                from = from.max(floor(origin.x + second_slope * dy) + 1);
            } else if second.y < 0.0 {
                to = to.min(-floor(-(origin.x + second_slope * dy)) - 1);
            } else if second.x * dy >= 0.0 {
                continue;
            }
            if from <= to {
                visit(self.map, y, from, to);
            }
        }
    }
}

/// The smallest and the largest vertex of a box around points.
fn bounds(points: &[Point2], resolution: f64) -> ((i32, i32), (i32, i32)) {
    let fold = |of: fn(&Point2) -> f64| {
        let values = points.iter().map(of);
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
            (low.min(v), high.max(v))
        })
    };
    let ((x0, x1), (y0, y1)) = (fold(|p| p.x), fold(|p| p.y));
    let low = |v: f64| (v / resolution).ceil() as i32;
    let high = |v: f64| (v / resolution).floor() as i32;
    ((low(x0), low(y0)), (high(x1), high(y1)))
}

/// Weight of a distance: 1 in front of the surface and one cell behind it, less the deeper.
#[inline]
fn weight_at(distance: f64, resolution: f64, truncation: f64) -> f64 {
    let depth = -distance - resolution;
    if depth <= 0.0 {
        return 1.0;
    }
    (1.0 - 0.95 * depth / (truncation - resolution)).max(0.05)
}

#[inline]
fn see(cell: &mut SdfCell, distance: f64, weight: f64, max_weight: f64) {
    let (old, w) = (f64::from(cell.weight), f64::from(cell.distance_m));
    let sum = old + weight;
    cell.distance_m = ((w * old + distance * weight) / sum) as f32;
    cell.weight = sum.min(max_weight) as f32;
}

#[inline]
fn see_free(cell: &mut SdfCell, truncation: f64, rule: &WedgeRule) {
    let t = truncation as f32;
    if cell.weight > 0.0 && cell.distance_m < t {
        let is_surface = f64::from(cell.distance_m.abs()) < 0.9 * truncation;
        let weight = if is_surface {
            rule.free_weight * rule.priority
        } else {
            rule.free_weight
        };
        see(cell, truncation, weight, rule.max_weight);
    } else {
        cell.distance_m = t;
        cell.weight = (cell.weight + rule.free_weight as f32).min(rule.max_weight as f32);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sdf::SignedDistances;
    use proptest::prelude::*;

    const TRUNCATION: f64 = 0.15;

    /// A scan of a straight wall at a distance, whose normal points at an angle.
    fn wall(distance_m: f64, normal_rad: f64) -> Sweep {
        let n_beams = 181;
        let step = std::f64::consts::PI / 180.0;
        let range = |beam: usize| {
            let angle = -std::f64::consts::FRAC_PI_2 + step * beam as f64;
            let incidence = (angle - normal_rad).cos();
            if incidence > 0.3 {
                (distance_m / incidence) as f32
            } else {
                0.0
            }
        };
        Sweep {
            time_s: 0.0,
            first_angle_rad: -std::f64::consts::FRAC_PI_2,
            angle_step_rad: step,
            ranges_m: (0..n_beams).map(range).collect(),
        }
    }

    fn map_of(sweep: &Sweep, pose: Pose2) -> SdfMap {
        let mut map = SdfMap::new(0.05, TRUNCATION);
        let rule = WedgeRule::default();
        map.insert(sweep, &sweep.lines(rule.line_reach_m), pose, &rule);
        map
    }

    proptest! {
        #[test]
        fn a_wall_has_its_analytic_distances(
            distance in 0.8..6.0_f64, normal in -0.8..0.8_f64,
            x in -3.0..3.0_f64, y in -3.0..3.0_f64, heading in -3.2..3.2_f64,
        ) {
            let pose = Pose2::new(x, y, heading);
            let map = map_of(&wall(distance, normal), pose);
            let toward = Point2::unit(heading + normal);
            let mut n_near = 0;
            for ((col, row), cell) in map.cells().iter() {
                let point = Point2::new(f64::from(col), f64::from(row)) * 0.05;
                let truth = distance - toward.dot(point - pose.position());
                if cell.weight == 0.0 {
                    continue;
                }
                prop_assert!(truth > -TRUNCATION - 1e-6, "{truth} is seen through the wall");
                if truth < TRUNCATION {
                    n_near += 1;
                    let error = (f64::from(cell.distance_m) - truth).abs();
                    // Stubs at the ends of the wall measure along the beam.
                    let lateral = toward.cross(point - pose.position()).abs();
                    if lateral < 2.0 * distance {
                        prop_assert!(error < 1e-3, "{truth}: {error}");
                    }
                } else {
                    prop_assert!((f64::from(cell.distance_m) - TRUNCATION).abs() < 1e-6);
                }
            }
            prop_assert!(n_near > 100);
        }

        #[test]
        fn the_gradient_is_that_of_differences(u in 0.05..0.95_f64, v in 0.05..0.95_f64, col in 30..40_i32, row in -20..20_i32) {
            let map = map_of(&wall(1.75, 0.3), Pose2::default());
            let point = Point2::new(f64::from(col) + u, f64::from(row) + v) * 0.05;
            if let Some(sample) = map.sample(point) {
                let h = 1e-6;
                let at = |dx, dy| map.sample(point + Point2::new(dx, dy)).unwrap().distance_m;
                let gradient = Point2::new(at(h, 0.0) - at(-h, 0.0), at(0.0, h) - at(0.0, -h)) * (0.5 / h);
                prop_assert!(gradient.distance(sample.gradient) < 1e-5);
            }
        }
    }

    #[test]
    fn every_vertex_of_a_scan_is_seen_once() {
        let sweep = wall(2.0, 0.0);
        let map = map_of(&sweep, Pose2::new(0.37, -0.2, 0.5));
        let mut n = 0;
        for (_, cell) in map.cells().iter() {
            // Stubs add a half at the ends of the wall, weights behind it are below 1.
            assert!(cell.weight <= 1.5, "{cell:?}");
            n += usize::from(cell.weight == 1.0);
        }
        assert!(n > 3000, "{n}");
    }

    #[test]
    fn free_ground_yields_to_a_surface_and_wears_it_off_slowly() {
        let near = wall(2.0, 0.0);
        let far = wall(3.0, 0.0);
        let rule = WedgeRule::default();
        let mut map = map_of(&near, Pose2::default());
        let place = (40, 3);
        let insert = |map: &mut SdfMap| map.insert(&far, &far.lines(0.15), Pose2::default(), &rule);
        insert(&mut map);
        assert!(
            map.distance(place) < 0.05,
            "a wall stays: {}",
            map.distance(place)
        );
        for _ in 0..30 {
            insert(&mut map);
        }
        assert!(
            map.distance(place) > 0.12,
            "a person leaves: {}",
            map.distance(place)
        );
    }

    #[test]
    fn a_packed_copy_differs_by_half_a_step() {
        let map = map_of(&wall(2.0, 0.2), Pose2::default());
        let packed = map.packed();
        for (place, cell) in map.cells().iter() {
            let value = packed.distance(place);
            if value.is_nan() {
                continue;
            }
            assert!((value - cell.distance_m).abs() < 0.001, "{place:?}");
        }
        assert!(packed.near_cells().count() > 100);
    }
}
