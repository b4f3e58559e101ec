//! The area that a footprint sweeps along a path.

use crate::geometry::{Point2, Pose2};
use crate::path::CurvePath;
use crate::vehicle::Vehicle;

/// Rows across the smaller side of the footprint.
const ROWS_PER_BODY: f64 = 256.0;
/// Most rows across everything; of very long ways the rows are wider.
const MAX_ROWS: f64 = 131_072.0;
/// The largest distance of a point from the chord of a piece, in sides of the footprint.
const MAX_BULGE: f64 = 2e-4;
/// Heading of the rows, radians: along no wall that people build.
const ROW_HEADING_RAD: f64 = 0.7;

/// The area of the ground that a footprint covers along a path, square meters; ground that is
/// covered twice counts once.
///
/// The area covered at first, and the area that every edge sweeps from then on. The path is cut
/// into pieces so slight that corners move along chords, to 1/5000 of the footprint's smaller side;
/// along a line that is exact. The area of the union is a sum over rows 1/256 of that side apart:
/// along each row the covered length is exact. The rows lie askew, so that few edges run along
/// them. Measured on lines, rings and shunts whose area is known, the error is below 0.1 %.
pub fn swept_area_m2(vehicle: &Vehicle, path: &CurvePath) -> f64 {
    let footprint = vehicle.footprint();
    let sides = vehicle.parts().iter().map(|part| {
        let (low, high) = part.bounds();
        (high.x - low.x).min(high.y - low.y)
    });
    let side_m = sides.fold(f64::INFINITY, f64::min);
    let turned = |pose| Pose2::new(0.0, 0.0, -ROW_HEADING_RAD).compose(pose);
    let pieces = pieces(path, side_m, footprint.circumradius());
    let mut shapes = Vec::new();
    for part in vehicle.parts() {
        let seen = |pose| part.placed(turned(pose));
        shapes.push(seen(path.start()).corners().to_vec());
        for &[from, to] in &pieces {
            let (from, to) = (seen(from), seen(to));
            let edges = from.edges().zip(to.edges());
            shapes.extend(edges.flat_map(|(before, after)| swept_edge(before, after)));
        }
    }
    let (bottom, top) = shapes
        .iter()
        .flatten()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(bottom, top), p| {
            (bottom.min(p.y), top.max(p.y))
        });
    let n_rows = (ROWS_PER_BODY * (top - bottom) / side_m).ceil();
    let mut rows = Rows::new(bottom, top, n_rows.clamp(1.0, MAX_ROWS) as usize);
    for shape in &shapes {
        rows.cover(shape);
    }
    rows.area()
}

type Edge = (Point2, Point2);

/// The area that an edge sweeps from one place to another: a quadrangle, or two triangles where
/// it turns about one of its own points.
fn swept_edge((a0, b0): Edge, (a1, b1): Edge) -> Vec<Vec<Point2>> {
    let (before, after) = (b0 - a0, b1 - a1);
    // Where the two cross, in shares of each; parallel ones nowhere.
    let between = (a1 - a0) * (1.0 / before.cross(after));
    let crossing = [between.cross(after), between.cross(before)];
    if crossing.iter().all(|&share| 0.0 < share && share < 1.0) {
        let pivot = a0 + before * crossing[0];
        return vec![vec![a0, pivot, a1], vec![b0, pivot, b1]];
    }
    vec![vec![a0, b0, b1, a1]]
}

/// First and last poses of pieces that stay near the chord between them.
fn pieces(path: &CurvePath, side_m: f64, reach_m: f64) -> Vec<[Pose2; 2]> {
    let bulge_m = MAX_BULGE * side_m;
    // A point at the end of the body bulges by an eighth of reach times turn squared, the way
    // itself by an eighth of length times turn.
    let stays =
        |length_m: f64, turn_rad: f64| turn_rad * (length_m + reach_m * turn_rad) <= 8.0 * bulge_m;
    let mut pieces = Vec::new();
    let mut from = path.start();
    let (mut length_m, mut turn_rad, mut gear) = (0.0, 0.0, None);
    for segment in path.segments() {
        // On a clothoid the tighter end stands for the whole.
        let whole_rad = segment.max_abs_curvature_per_m() * segment.length_m;
        let mut n_parts = 1.0;
        while !stays(segment.length_m / n_parts, whole_rad / n_parts) && n_parts < 1e6 {
            n_parts *= 2.0;
        }
        let (part_m, part_rad) = (segment.length_m / n_parts, whole_rad / n_parts);
        for i in 0..n_parts as usize {
            let here = segment.pose_at(part_m * i as f64);
            let goes_on =
                gear == Some(segment.direction) && stays(length_m + part_m, turn_rad + part_rad);
            if !goes_on {
                pieces.push([from, here]);
                (from, length_m, turn_rad) = (here, 0.0, 0.0);
                gear = Some(segment.direction);
            }
            length_m += part_m;
            turn_rad += part_rad;
        }
    }
    pieces.push([from, path.end()]);
    pieces
}

/// Covered stretches along rows of equal height.
struct Rows {
    bottom: f64,
    height: f64,
    covered: Vec<Vec<[f64; 2]>>,
}

impl Rows {
    fn new(bottom: f64, top: f64, n_rows: usize) -> Self {
        Self {
            bottom,
            height: (top - bottom) / n_rows as f64,
            covered: vec![Vec::new(); n_rows],
        }
    }

    fn cover(&mut self, shape: &[Point2]) {
        let heights = || shape.iter().map(|p| p.y);
        let row = |y: f64| ((y - self.bottom) / self.height - 0.5).max(0.0);
        let first = row(heights().fold(f64::INFINITY, f64::min)).ceil() as usize;
        let highest = row(heights().fold(f64::NEG_INFINITY, f64::max)).floor() as usize;
        let end = (highest + 1).min(self.covered.len());
        for i in first..end {
            let y = self.bottom + (i as f64 + 0.5) * self.height;
            let Some([from, to]) = section(shape, y) else {
                continue;
            };
            match self.covered[i].last_mut() {
                // Most pieces overlap the one before them.
                Some(last) if from <= last[1] && last[0] <= to => {
                    *last = [last[0].min(from), last[1].max(to)];
                }
                _ => self.covered[i].push([from, to]),
            }
        }
    }

    fn area(mut self) -> f64 {
        let lengths = self.covered.iter_mut().map(|row| {
            row.sort_by(|a, b| a[0].total_cmp(&b[0]));
            let mut end = f64::NEG_INFINITY;
            row.iter().fold(0.0, |sum, &[from, to]| {
                let more = (to - from.max(end)).max(0.0);
                end = end.max(to);
                sum + more
            })
        });
        lengths.sum::<f64>() * self.height
    }
}

/// The intersection of a convex shape with a level.
fn section(shape: &[Point2], y: f64) -> Option<[f64; 2]> {
    let crossing = |i: usize| {
        let (a, b) = (shape[i], shape[(i + 1) % shape.len()]);
        let (below, above) = (a.y.min(b.y), a.y.max(b.y));
        let meets = below <= y && y <= above && above > below;
        meets.then(|| a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y))
    };
    let meets = (0..shape.len()).filter_map(crossing);
    let (from, to) = meets.fold((f64::INFINITY, f64::NEG_INFINITY), |(from, to), x| {
        (from.min(x), to.max(x))
    });
    (from <= to).then_some([from, to])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::path::Direction::{Forward, Reverse};
    use std::f64::consts::{PI, TAU};

    /// 3 x 1 m, 0.5 m of it behind the rear axle.
    fn area(path: &CurvePath) -> f64 {
        swept_area_m2(&Vehicle::lei2020(), path)
    }

    fn is(area: f64, exact: f64) {
        assert!(
            (area / exact - 1.0).abs() < 1e-3,
            "{area} instead of {exact}"
        );
    }

    #[test]
    fn a_line_in_any_direction() {
        for heading in [0.0, 0.3, 0.7, PI / 2.0, 2.0] {
            let mut path = CurvePath::new(Pose2::new(3.0, 4.0, heading));
            is(area(&path), 3.0);
            path.push(0.0, 7.0, Forward);
            is(area(&path), 10.0);
            path.push(0.0, 5.0, Reverse);
            is(area(&path), 10.0);
        }
    }

    #[test]
    fn a_ring_and_a_second_lap() {
        let mut path = CurvePath::default();
        path.push(0.25, TAU * 4.0, Forward);
        let outer = Point2::new(2.5, 4.5).norm();
        is(area(&path), PI * (outer * outer - 3.5 * 3.5));
        path.push(0.25, 9.0, Forward);
        is(area(&path), PI * (outer * outer - 3.5 * 3.5));
    }

    #[test]
    fn many_short_arcs_are_the_long_one() {
        let arc = |n: u32| {
            let step = PI * 4.0 / f64::from(n);
            let mut pose = Pose2::default();
            let mut segments = Vec::new();
            for _ in 0..n {
                let mut path = CurvePath::new(pose);
                path.push(0.25, step, Forward);
                pose = path.end();
                segments.extend_from_slice(path.segments());
            }
            area(&CurvePath::from_segments(Pose2::default(), segments))
        };
        is(arc(1000), arc(1));
    }

    #[test]
    fn a_shunt_adds_what_is_new() {
        let mut path = CurvePath::new(Pose2::new(-1.0, 2.0, 1.3));
        path.push(0.0, 7.0, Forward);
        path.push(0.0, 9.0, Reverse);
        is(area(&path), 12.0);
    }
}
