//! The ground that a body covers along a path, piece by piece.

use super::hull::{Bounds, Hull};
use crate::geometry::Point2;
use crate::path::{CurvePath, CurveSegment};
use crate::vehicle::Vehicle;

/// Length of a piece, meters.
const PIECE_M: f64 = 0.05;
/// Most pieces of a path; those of a longer one are longer.
const MAX_PIECES: f64 = 20_000.0;

/// A path in short pieces with the ground that the body covers on each.
pub(super) struct SweptPath {
    /// Where the pieces begin, and the end of the last one.
    pub(super) places_m: Vec<f64>,
    /// The parts of the body on each piece.
    hulls: Vec<Vec<Hull>>,
    /// Boxes around the pieces, and around pairs of boxes of the level below.
    levels: Vec<Vec<Bounds>>,
}

impl SweptPath {
    /// The pieces of a path; of one without length, a single piece.
    pub(super) fn new(path: &CurvePath, vehicle: &Vehicle) -> Self {
        let piece_m = PIECE_M.max(path.length_m() / MAX_PIECES);
        let standing = CurveSegment {
            start: path.start(),
            ..CurveSegment::default()
        };
        let has_length = path.length_m() > 0.0;
        let segments = path.segments().iter().filter(|s| s.length_m > 0.0);
        let segments: Vec<_> = if has_length {
            segments.collect()
        } else {
            vec![&standing]
        };
        let (mut places_m, mut hulls, mut begin_m) = (vec![0.0], Vec::new(), 0.0);
        for segment in segments {
            let n_pieces = (segment.length_m / piece_m).ceil().max(1.0) as usize;
            for i in 0..n_pieces {
                let ends = [i, i + 1].map(|i| segment.length_m * i as f64 / n_pieces as f64);
                hulls.push(covered(segment, ends, vehicle));
                places_m.push(begin_m + ends[1]);
            }
            begin_m += segment.length_m;
        }
        let levels = levels(&hulls);
        Self {
            places_m,
            hulls,
            levels,
        }
    }

    /// The pieces, as ranges, on which the body may come within a distance of a hull.
    pub(super) fn pieces_within(&self, other: &Hull, distance_m: f64) -> Vec<[usize; 2]> {
        let mut runs = Vec::new();
        let top = self.levels.len() - 1;
        self.collect(top, 0, (other, distance_m), &mut runs);
        runs
    }

    fn collect(
        &self,
        level: usize,
        at: usize,
        (other, distance_m): (&Hull, f64),
        runs: &mut Vec<[usize; 2]>,
    ) {
        let Some(bounds) = self.levels[level].get(at) else {
            return;
        };
        if !bounds.is_near(&other.bounds, distance_m) {
            return;
        }
        if level > 0 {
            self.collect(level - 1, 2 * at, (other, distance_m), runs);
            self.collect(level - 1, 2 * at + 1, (other, distance_m), runs);
            return;
        }
        let parts = &self.hulls[at];
        if parts.iter().any(|part| part.is_within(other, distance_m)) {
            match runs.last_mut() {
                Some(run) if run[1] == at => run[1] = at + 1,
                _ => runs.push([at, at + 1]),
            }
        }
    }
}

/// The parts of the body on a piece of a segment. A body point at `r` from the rear axle moves on a
/// track of second derivative at most `|k| + R (k^2 + |k'|)`: from the chord of its ends it is off
/// by at most that times l^2 / 8.
fn covered(segment: &CurveSegment, [from_m, to_m]: [f64; 2], vehicle: &Vehicle) -> Vec<Hull> {
    let k = segment.max_abs_curvature_per_m();
    let reach_m = vehicle.footprint().circumradius();
    let bend = k + reach_m * (k * k + segment.curvature_rate_per_m2.abs());
    let bulge_m = 0.125 * bend * (to_m - from_m).powi(2);
    let ends = [segment.pose_at(from_m), segment.pose_at(to_m)];
    let part = |corners: &[Point2]| {
        let points = ends
            .iter()
            .flat_map(|end| corners.iter().map(|&p| end.transform(p)));
        Hull::new(points.collect(), bulge_m)
    };
    vehicle.parts().iter().map(|p| part(p.corners())).collect()
}

fn levels(hulls: &[Vec<Hull>]) -> Vec<Vec<Bounds>> {
    let united = |bounds: &[Bounds]| {
        let rest = bounds.iter().skip(1);
        rest.fold(bounds[0], |all, next| all.union(next))
    };
    let leaves = hulls.iter().map(|parts| {
        let bounds: Vec<_> = parts.iter().map(|part| part.bounds).collect();
        united(&bounds)
    });
    let mut levels: Vec<Vec<Bounds>> = vec![leaves.collect()];
    while let Some(last) = levels.last().filter(|last| last.len() > 1) {
        let next = last.chunks(2).map(united).collect();
        levels.push(next);
    }
    levels
}
