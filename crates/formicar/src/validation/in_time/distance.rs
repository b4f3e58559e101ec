//! The least distance from moving obstacles over time, proven by spans of time.

use super::report::{Nearest, TimedReport, TimedViolation, TimedViolationKind};
use super::rules::DriveRules;
use crate::collision::MIN_CLEARANCE_M;
use crate::geometry::Point2;
use crate::path::TimedPath;
use crate::scenario::Predicted;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// How far below the least distance found its proven bound may lie, meters.
const PRECISION_M: f64 = 1e-4;
/// Most distances that are computed for one obstacle; beyond, it counts as too near.
const MAX_LOOKS: usize = 300_000;

/// Places that are this near count as one, meters.
const SAME_PLACE_M: f64 = 1e-6;

pub(super) struct Distances<'a> {
    rules: &'a DriveRules<'a>,
    timed: &'a TimedPath,
    /// Ends of the segments, and the largest curvature on each.
    bends: Vec<(f64, f64)>,
    reach_m: f64,
}

/// A span of time with the distances at its ends and a lower bound of those between.
#[derive(Clone, Copy, Debug)]
struct Span {
    from_s: f64,
    to_s: f64,
    ends_m: [f64; 2],
    bound_m: f64,
}

impl Ord for Span {
    /// The span with the least bound is the greatest; of equals the earlier.
    fn cmp(&self, other: &Self) -> Ordering {
        let by_bound = other.bound_m.total_cmp(&self.bound_m);
        by_bound.then(other.from_s.total_cmp(&self.from_s))
    }
}

impl PartialOrd for Span {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Span {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Span {}

/// What is known about one obstacle.
struct Found {
    /// No distance is less.
    proven_m: f64,
    /// The least that was computed, and when.
    least_m: f64,
    at_s: f64,
}

impl<'a> Distances<'a> {
    pub(super) fn new(rules: &'a DriveRules<'a>, timed: &'a TimedPath) -> Self {
        let mut end_m = 0.0;
        let bends = timed.path().segments().iter().map(|segment| {
            end_m += segment.length_m;
            (end_m, segment.max_abs_curvature_per_m())
        });
        Self {
            rules,
            timed,
            bends: bends.collect(),
            reach_m: rules.vehicle.footprint().circumradius(),
        }
    }

    /// Adds the least distance and violations to a report.
    pub(super) fn check(&self, report: &mut TimedReport) {
        let wished_m = self.rules.distance_m.max(MIN_CLEARANCE_M);
        for obstacle in self.rules.predictions.obstacles() {
            let enough_m = report.min_distance_m.unwrap_or(f64::INFINITY).max(wished_m);
            let found = self.least(obstacle, [wished_m, enough_m]);
            if report
                .min_distance_m
                .is_none_or(|least_m| found.proven_m < least_m)
            {
                report.min_distance_m = Some(found.proven_m);
                report.nearest = Some(self.nearest(obstacle, &found));
            }
            // A bound that is not a number, as over times beyond all measure, proves nothing.
            if found.proven_m.is_nan() || found.proven_m < wished_m {
                report.violations.push(self.violation(obstacle, &found));
            }
        }
    }

    /// The least distance from an obstacle: precisely where it is below `enough_m`, and decided
    /// whether it is below `wished_m`.
    fn least(&self, obstacle: &Predicted, [wished_m, enough_m]: [f64; 2]) -> Found {
        let times = self.times(obstacle);
        let distances: Vec<_> = times
            .iter()
            .map(|&t| self.distance_m(obstacle, t))
            .collect();
        let mut found = Found {
            proven_m: f64::INFINITY,
            least_m: distances[0],
            at_s: times[0],
        };
        let mut spans = BinaryHeap::new();
        for (i, &distance_m) in distances.iter().enumerate() {
            found.note(distance_m, times[i]);
            if i > 0 {
                let ends_m = [distances[i - 1], distance_m];
                spans.push(self.span(obstacle, [times[i - 1], times[i]], ends_m));
            }
        }
        for _ in 0..MAX_LOOKS {
            let Some(span) = spans.pop() else { break };
            let is_precise = span.bound_m >= found.least_m - PRECISION_M;
            let is_decided = span.bound_m >= wished_m || found.least_m < wished_m;
            if span.bound_m >= enough_m || is_precise && is_decided {
                found.proven_m = span.bound_m.min(found.least_m);
                return found;
            }
            let middle_s = 0.5 * (span.from_s + span.to_s);
            let distance_m = self.distance_m(obstacle, middle_s);
            found.note(distance_m, middle_s);
            let [first_m, last_m] = span.ends_m;
            spans.push(self.span(obstacle, [span.from_s, middle_s], [first_m, distance_m]));
            spans.push(self.span(obstacle, [middle_s, span.to_s], [distance_m, last_m]));
        }
        found.proven_m = spans.peek().map_or(found.least_m, |span| span.bound_m);
        found
    }

    /// Moments between which drive and obstacle move smoothly.
    fn times(&self, obstacle: &Predicted) -> Vec<f64> {
        let end_s = self
            .timed
            .duration_s()
            .max(self.rules.predictions.horizon_s());
        let phases = self.timed.phases().iter().map(|phase| phase.t_s);
        let all = phases.chain(obstacle.knots()).chain([0.0, end_s]);
        let mut times: Vec<_> = all.filter(|t_s| (0.0..=end_s).contains(t_s)).collect();
        times.push(self.timed.duration_s());
        times.sort_by(f64::total_cmp);
        times.dedup();
        times
    }

    /// Two Lipschitz cones from the ends meet at the bound.
    fn span(&self, obstacle: &Predicted, [from_s, to_s]: [f64; 2], ends_m: [f64; 2]) -> Span {
        let closing_mps =
            self.point_speed_mps(from_s, to_s) + obstacle.point_speed_mps(from_s, to_s);
        Span {
            from_s,
            to_s,
            ends_m,
            bound_m: 0.5 * (ends_m[0] + ends_m[1] - closing_mps * (to_s - from_s)),
        }
    }

    /// A bound of the speed of the body's points in a span within one phase.
    fn point_speed_mps(&self, from_s: f64, to_s: f64) -> f64 {
        let middle_s = 0.5 * (from_s + to_s);
        let phases = self.timed.phases();
        let begun = phases.partition_point(|phase| phase.t_s <= middle_s);
        let Some(phase) = begun.checked_sub(1).map(|i| phases[i]) else {
            return 0.0;
        };
        if middle_s >= phase.t_s + phase.duration_s {
            // The drive is over.
            return 0.0;
        }
        let [a, b] = [from_s, to_s].map(|t_s| phase.after(t_s - phase.t_s));
        let bulge_mps = 0.125 * phase.jerk_mps3.abs() * (to_s - from_s).powi(2);
        let speed_mps = a.speed_mps.max(b.speed_mps) + bulge_mps;
        speed_mps * (1.0 + self.max_curvature_per_m(a.s_m, b.s_m) * self.reach_m)
    }

    /// The largest curvature between two places.
    fn max_curvature_per_m(&self, from_m: f64, to_m: f64) -> f64 {
        let first = self
            .bends
            .partition_point(|(end_m, _)| *end_m < from_m - SAME_PLACE_M);
        let mut largest: f64 = 0.0;
        for (end_m, curvature_per_m) in &self.bends[first..] {
            largest = largest.max(*curvature_per_m);
            if *end_m > to_m + SAME_PLACE_M {
                break;
            }
        }
        largest
    }

    /// The distance at a moment; negative where the two overlap.
    fn distance_m(&self, obstacle: &Predicted, t_s: f64) -> f64 {
        let pose = self.timed.pose_at(t_s);
        let theirs = obstacle.corners_at(t_s);
        let parts = self.rules.vehicle.parts().iter();
        let gap = |part: Vec<Point2>| widest_gap_m(&part, &theirs);
        let placed = parts.map(|part| {
            let corners = part.corners().iter();
            gap(corners.map(|&p| pose.transform(p)).collect())
        });
        placed.fold(f64::INFINITY, f64::min) - obstacle.radius_at(t_s)
    }

    fn nearest(&self, obstacle: &Predicted, found: &Found) -> Nearest {
        Nearest {
            obstacle: obstacle.name().to_owned(),
            t_s: found.at_s,
            s_m: self.timed.at(found.at_s).s_m,
            pose: self.timed.pose_at(found.at_s).wrapped(),
            distance_m: found.least_m,
        }
    }

    fn violation(&self, obstacle: &Predicted, found: &Found) -> TimedViolation {
        let (at, limit) = (self.nearest(obstacle, found), self.rules.distance_m);
        let near = if at.distance_m <= MIN_CLEARANCE_M {
            "touches the vehicle".to_owned()
        } else if at.distance_m < limit {
            format!("comes within {:.3} m of the vehicle", at.distance_m)
        } else {
            "was not proven to keep its distance".to_owned()
        };
        TimedViolation {
            kind: TimedViolationKind::Distance,
            t_s: at.t_s,
            s_m: at.s_m,
            pose: at.pose,
            amount: at.distance_m,
            limit,
            message: format!(
                "obstacle {} {near} at {:.2} s, {:.2} m along the path, at ({:.3}, {:.3}); {limit} m are to be kept",
                at.obstacle, at.t_s, at.s_m, at.pose.x, at.pose.y
            ),
        }
    }
}

impl Found {
    fn note(&mut self, distance_m: f64, t_s: f64) {
        if distance_m < self.least_m {
            (self.least_m, self.at_s) = (distance_m, t_s);
        }
    }
}

/// The widest gap between the shadows of two convex shapes: their distance, or less than 0 where
/// they overlap. The direction in which it is widest is normal to an edge of one of them, or leads
/// from a corner of one to a corner of the other. Any direction gives a lower bound, whatever is
/// rounded.
fn widest_gap_m(a: &[Point2], b: &[Point2]) -> f64 {
    let normals = |ring: &[Point2], sign: f64| {
        let n = ring.len();
        let edge = |i: usize| ring[(i + 1) % n] - ring[i];
        // Corners run counter-clockwise: the outside is to the right of an edge.
        let outward = |i: usize| -edge(i).perpendicular() * sign;
        (0..n).map(outward).collect::<Vec<_>>()
    };
    let corners = a.iter().flat_map(|&p| b.iter().map(move |&q| q - p));
    let directions = normals(a, 1.0).into_iter().chain(normals(b, -1.0));
    let gap = |direction: Point2| {
        let norm = direction.norm();
        if norm == 0.0 {
            return f64::NEG_INFINITY;
        }
        let reach = a
            .iter()
            .map(|p| p.dot(direction))
            .fold(f64::NEG_INFINITY, f64::max);
        let begin = b
            .iter()
            .map(|q| q.dot(direction))
            .fold(f64::INFINITY, f64::min);
        (begin - reach) / norm
    };
    let widest = directions.chain(corners).map(gap);
    let widest = widest.fold(f64::NEG_INFINITY, f64::max);
    // Two points in one place.
    if widest.is_finite() { widest } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{ConvexPolygon, Pose2};
    use crate::numeric::Seed;

    /// Distance of densely sampled outlines.
    fn sampled_m(a: &ConvexPolygon, b: &ConvexPolygon) -> f64 {
        let outline = |polygon: &ConvexPolygon| {
            let edges = polygon.edges();
            let points =
                edges.flat_map(|(p, q)| (0..60).map(move |i| p.lerp(q, f64::from(i) / 60.0)));
            points.collect::<Vec<_>>()
        };
        let (a, b) = (outline(a), outline(b));
        let pairs = a.iter().flat_map(|p| b.iter().map(|q| p.distance(*q)));
        pairs.fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn the_widest_gap_is_the_distance() {
        let a = ConvexPolygon::rectangle(Point2::new(-0.5, -0.3), Point2::new(1.0, 0.3));
        let corners = [(0.0, 0.0), (0.7, 0.2), (0.1, 0.9)].map(|(x, y)| Point2::new(x, y));
        let b = ConvexPolygon::new(&corners).unwrap();
        let mut stream = Seed(18).stream([0, 0]);
        let mut n_apart = 0;
        for _ in 0..300 {
            let mut place = |polygon: &ConvexPolygon| {
                let (x, y) = (stream.range(-1.5, 1.5), stream.range(-1.5, 1.5));
                polygon.placed(Pose2::new(x, y, stream.range(-3.0, 3.0)))
            };
            let (a, b) = (place(&a), place(&b));
            let gap_m = widest_gap_m(a.corners(), b.corners());
            let sampled_m = sampled_m(&a, &b);
            if gap_m > 0.0 {
                n_apart += 1;
                assert!(gap_m <= sampled_m + 1e-12 && sampled_m - gap_m < 0.02);
            } else {
                let inside = a.corners().iter().any(|&p| b.contains(p))
                    || b.corners().iter().any(|&p| a.contains(p));
                assert!(inside || sampled_m < 0.03, "{gap_m} {sampled_m}");
            }
        }
        assert!(n_apart > 100);
        let at = |x, y| [Point2::new(x, y)];
        assert_eq!(widest_gap_m(&at(0.0, 0.0), &at(3.0, 4.0)), 5.0);
        assert_eq!(widest_gap_m(&at(1.0, 1.0), &at(1.0, 1.0)), 0.0);
    }
}
