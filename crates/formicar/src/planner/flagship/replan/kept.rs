//! The parts of a path that a changed map leaves.

use crate::geometry::Arc;
use crate::path::{CurvePath, CurveSegment, Direction};
use crate::search::DriveProblem;
use crate::vehicle::Gears;
use std::ops::Range;

/// Segments that are not free are cut into pieces of so many turning radii.
const PIECE_RADII: f64 = 0.25;
/// Curvatures beyond the vehicle's by more than this share are not driven.
const CURVATURE_TOLERANCE: f64 = 1e-9;

/// A stretch of a path in grid coordinates, by driven lengths.
pub(super) type Stretch = Range<f64>;

/// The stretches of a path that can still be driven, as long as they go.
pub(super) fn kept_stretches(problem: &DriveProblem, path: &CurvePath) -> Vec<Stretch> {
    let piece_m = PIECE_RADII * problem.map().radius_m();
    let mut kept: Vec<Stretch> = Vec::new();
    let mut begun_m = 0.0;
    for segment in path.segments() {
        if is_driven(problem, segment) {
            push(&mut kept, begun_m..begun_m + segment.length_m);
        } else {
            let n_pieces = (segment.length_m / piece_m).ceil().max(1.0);
            let at = |i: f64| segment.length_m * i / n_pieces;
            for i in (0..n_pieces as usize).map(|i| i as f64) {
                let piece = CurveSegment {
                    start: segment.pose_at(at(i)),
                    length_m: at(i + 1.0) - at(i),
                    ..*segment
                };
                if is_driven(problem, &piece) {
                    push(&mut kept, begun_m + at(i)..begun_m + at(i + 1.0));
                }
            }
        }
        begun_m += segment.length_m;
    }
    kept
}

/// Appends a stretch, to the last one where they meet.
fn push(kept: &mut Vec<Stretch>, next: Stretch) {
    match kept.last_mut() {
        Some(last) if last.end >= next.start => last.end = next.end,
        _ => kept.push(next),
    }
}

/// True where the vehicle can drive a segment, in a gear that the request allows, and is free on
/// it.
fn is_driven(problem: &DriveProblem, segment: &CurveSegment) -> bool {
    let bend = segment.curvature_per_m.abs() * problem.map().radius_m();
    let is_allowed = problem.gears() == Gears::Both || segment.direction == Direction::Forward;
    bend <= 1.0 + CURVATURE_TOLERANCE
        && is_allowed
        && problem.is_arc_free(segment.start, arc_of(segment))
}

/// The arcs of a part of a path.
pub(super) fn arcs_between(path: &CurvePath, part: Stretch) -> impl Iterator<Item = Arc> {
    let part = path.between_m(part.start, part.end);
    let arcs: Vec<Arc> = part.segments().iter().map(arc_of).collect();
    arcs.into_iter()
}

pub(super) fn arc_of(segment: &CurveSegment) -> Arc {
    Arc::new(
        segment.curvature_per_m,
        segment.direction.sign() * segment.length_m,
    )
}
