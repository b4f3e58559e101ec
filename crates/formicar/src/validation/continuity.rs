//! Continuity of the curvature of a path, and its rate of change.

use super::CURVATURE_TOLERANCE;
use super::report::{Violation, ViolationKind};
use crate::path::{CurvePath, CurveSegment};
use crate::scenario::Request;
use crate::vehicle::Vehicle;

/// A curvature that jumps by less is rounding, 1/m: of numbers in files, and of the sum that gives
/// a clothoid's curvature at its end.
const SAME_CURVATURE_PER_M: f64 = 1e-9;

/// A joint inside one gear at which the curvature jumps.
struct Jump<'a> {
    after: &'a CurveSegment,
    s_m: f64,
    amount_per_m: f64,
}

/// The violations of a path that the request asks to be continuous; none of other paths.
pub(super) fn violations(vehicle: &Vehicle, request: &Request, path: &CurvePath) -> Vec<Violation> {
    match request.max_curvature_rate_per_m2(vehicle) {
        Ok(None) => Vec::new(),
        Ok(Some(limit)) => {
            let jumps = jumps(path).map(|jump| jump.violation());
            jumps.chain(too_fast(path, limit)).collect()
        }
        // Such a request is refused before anything is planned; here nothing fulfils it.
        Err(error) => vec![Violation {
            kind: ViolationKind::CurvatureChange,
            s_m: 0.0,
            pose: path.start(),
            amount: max_rate_per_m2(path),
            limit: 0.0,
            message: error.to_string(),
        }],
    }
}

/// True if the curvature jumps nowhere inside one gear.
pub(super) fn is_continuous(path: &CurvePath) -> bool {
    jumps(path).next().is_none()
}

/// Fastest change of the curvature along a segment.
pub(super) fn max_rate_per_m2(path: &CurvePath) -> f64 {
    let rates = driven(path).map(|s| s.curvature_rate_per_m2.abs());
    rates.fold(0.0, f64::max)
}

fn driven(path: &CurvePath) -> impl Iterator<Item = &CurveSegment> {
    path.segments().iter().filter(|s| s.length_m > 0.0)
}

fn jumps(path: &CurvePath) -> impl Iterator<Item = Jump<'_>> {
    let mut s_m = 0.0;
    driven(path)
        .zip(driven(path).skip(1))
        .filter_map(move |(before, after)| {
            s_m += before.length_m;
            let amount_per_m = (after.curvature_per_m - before.end_curvature_per_m()).abs();
            let jumps = before.direction == after.direction && amount_per_m > SAME_CURVATURE_PER_M;
            jumps.then_some(Jump {
                after,
                s_m,
                amount_per_m,
            })
        })
}

impl Jump<'_> {
    fn violation(&self) -> Violation {
        let (amount, limit, s_m, pose) = (
            self.amount_per_m,
            SAME_CURVATURE_PER_M,
            self.s_m,
            self.after.start,
        );
        Violation {
            kind: ViolationKind::CurvatureChange,
            s_m,
            pose,
            amount,
            limit,
            message: format!(
                "the curvature jumps by {amount:.6} 1/m at ({:.3}, {:.3}), s = {s_m:.3} m, inside one gear; the request asks for continuous curvature",
                pose.x, pose.y
            ),
        }
    }
}

/// Segments along which the curvature changes too fast.
fn too_fast(path: &CurvePath, limit: f64) -> Vec<Violation> {
    let mut s_m = 0.0;
    let mut violations = Vec::new();
    for segment in driven(path) {
        let amount = segment.curvature_rate_per_m2.abs();
        if amount > limit * (1.0 + CURVATURE_TOLERANCE) {
            violations.push(Violation {
                kind: ViolationKind::CurvatureChange,
                s_m,
                pose: segment.start,
                amount,
                limit,
                message: format!(
                    "the curvature changes by {amount:.6} 1/m^2 over {:.3} m from ({:.3}, {:.3}), s = {s_m:.3} m; the limit is {limit:.6} 1/m^2",
                    segment.length_m, segment.start.x, segment.start.y
                ),
            });
        }
        s_m += segment.length_m;
    }
    violations
}
