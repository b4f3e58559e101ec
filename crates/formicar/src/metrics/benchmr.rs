//! Bench-MR's curvature and cusp measures, over points at equal steps.

use super::resample::SAME_POINT_M;
use crate::geometry::{Point2, angle_difference};

/// Angle over length, curvature and cusps as Bench-MR computes them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct BenchMr {
    pub(super) aol: f64,
    pub(super) max_curvature: f64,
    pub(super) normalized_curvature: f64,
    pub(super) n_cusps: usize,
}

/// Shortest leg of a triple of points, meters.
const MIN_LEG_M: f64 = 0.3;

/// Turns above this are cusps, degrees.
const CUSP_DEG: f64 = 60.0;

impl BenchMr {
    pub(super) fn new(points: &[Point2]) -> Self {
        let steps: Vec<Point2> = points
            .windows(2)
            .map(|w| w[1] - w[0])
            .filter(|step| step.norm() > 0.0)
            .collect();
        let length: f64 = steps.iter().map(|step| step.norm()).sum();
        let turns: Vec<f64> = steps
            .windows(2)
            .map(|w| angle_difference(w[1].angle(), w[0].angle()).abs())
            .collect();
        let total: f64 = turns.iter().sum();
        let (mut max_curvature, mut normalized_curvature) = (0.0_f64, 0.0);
        for [a, b, c] in triples(points) {
            let curvature = circle_curvature(a, b, c);
            max_curvature = max_curvature.max(curvature);
            normalized_curvature += curvature * (a.distance(b) + b.distance(c));
        }
        Self {
            aol: if length > 0.0 { total / length } else { 0.0 },
            max_curvature,
            normalized_curvature,
            n_cusps: turns.iter().filter(|t| t.to_degrees() > CUSP_DEG).count(),
        }
    }
}

/// Triples of points with both legs long enough, one after the other: the next begins one sample
/// after the last one's end.
fn triples(points: &[Point2]) -> Vec<[Point2; 3]> {
    let far_from = |i: usize| {
        let is_far = |&j: &usize| points[i].distance(points[j]) >= MIN_LEG_M;
        (i + 1..points.len()).find(is_far)
    };
    let (mut triples, mut first) = (Vec::new(), 0);
    while let Some(second) = far_from(first)
        && let Some(third) = far_from(second)
    {
        if points[first].distance(points[third]) > SAME_POINT_M {
            triples.push([points[first], points[second], points[third]]);
        }
        first = third + 1;
    }
    triples
}

/// 1 / R of the circle through three points, 0 on a line: 4 area / (product of the sides).
fn circle_curvature(a: Point2, b: Point2, c: Point2) -> f64 {
    let doubled_area = (b - a).cross(c - b).abs();
    2.0 * doubled_area / (a.distance(b) * b.distance(c) * c.distance(a))
}
