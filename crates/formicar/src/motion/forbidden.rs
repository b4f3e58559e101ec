//! Forbidden regions in arc length and time: where the body may come too near to a prediction.
//!
//! Time is cut into slabs, the path into short pieces. The body on a piece lies within the hull of
//! its two ends, grown by the sagitta of its points' tracks; an obstacle over a slab lies within the
//! hull of its body at the slab's ends and knots, grown likewise and by its uncertainty at the
//! slab's end. A piece is forbidden in a slab unless the two hulls are farther apart than the wished
//! distance. So a place outside every region keeps the distance at every moment: the bound never
//! passes contact.

use super::hull::Hull;
use super::swept_path::SweptPath;
use crate::collision::MIN_CLEARANCE_M;
use crate::path::TimedPath;
use crate::scenario::{Predicted, Predictions};

/// A stretch of the path that is closed during a slab of time.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Region {
    /// The obstacle that closes it, by its place in the predictions.
    pub obstacle: usize,
    /// Beginning of the slab, seconds.
    pub from_s: f64,
    /// End of the slab, seconds; infinite in the last one, in which obstacles stand.
    pub to_s: f64,
    /// Arc length where it begins, meters.
    pub from_m: f64,
    /// Arc length where it ends, meters.
    pub to_m: f64,
}

/// The forbidden regions of a path.
#[derive(Clone, Debug, Default)]
pub(super) struct Forbidden {
    pub(super) time_step_s: f64,
    length_m: f64,
    /// Closed stretches per slab, disjoint and in order; the last slab goes on forever.
    slabs: Vec<Vec<[f64; 2]>>,
    pub(super) regions: Vec<Region>,
}

/// Places that are this near count as one, meters.
pub(super) const SAME_PLACE_M: f64 = 1e-9;
/// The most that a turning obstacle may leave the hull of its poses within a slab, meters.
const OBSTACLE_BULGE_M: f64 = 0.01;
/// Most poses of an obstacle within a slab.
const MAX_POSES: f64 = 64.0;

impl Forbidden {
    pub(super) fn new(
        path: &SweptPath,
        predictions: &Predictions,
        distance_m: f64,
        time_step_s: f64,
    ) -> Self {
        let n_slabs = (predictions.horizon_s() / time_step_s).ceil() as usize;
        let distance_m = distance_m + MIN_CLEARANCE_M;
        let (mut slabs, mut regions) = (Vec::new(), Vec::new());
        for slab in 0..=n_slabs {
            let from_s = slab as f64 * time_step_s;
            let to_s = match slab {
                last if last == n_slabs => f64::INFINITY,
                _ => (slab + 1) as f64 * time_step_s,
            };
            let mut closed = Vec::new();
            for (i, obstacle) in predictions.obstacles().iter().enumerate() {
                let hull = covered(obstacle, from_s, to_s);
                let within_m = distance_m + obstacle.radius_at(to_s);
                let runs = path.pieces_within(&hull, within_m);
                let ends = |[first, last]: [usize; 2]| [path.places_m[first], path.places_m[last]];
                regions.extend(runs.iter().copied().map(ends).map(|[from_m, to_m]| Region {
                    obstacle: i,
                    from_s,
                    to_s,
                    from_m,
                    to_m,
                }));
                closed.extend(runs);
            }
            slabs.push(united(closed, &path.places_m));
        }
        Self {
            time_step_s,
            length_m: path.places_m.last().copied().unwrap_or_default(),
            slabs,
            regions,
        }
    }

    /// The closed stretches of a slab; beyond the last one those of the last.
    pub(super) fn closed(&self, slab: usize) -> &[[f64; 2]] {
        let last = self.slabs.len().saturating_sub(1);
        self.slabs.get(slab.min(last)).map_or(&[], Vec::as_slice)
    }

    /// The first slab from which on nothing changes.
    pub(super) fn settled(&self) -> usize {
        let last = self.closed(usize::MAX);
        let changing = self.slabs.iter().rposition(|closed| closed != last);
        changing.map_or(0, |slab| slab + 1)
    }

    /// True if a drive over a stretch, from one end to the other within a slab, meets nothing. A
    /// vehicle that stands on the border of a closed stretch is outside it, but for the ends of the
    /// path, which have only one side.
    pub(super) fn is_open(&self, slab: usize, [from_m, to_m]: [f64; 2]) -> bool {
        let stands = to_m - from_m <= SAME_PLACE_M;
        self.closed(slab).iter().all(|&[closed_m, open_m]| {
            let at_begin = stands && closed_m <= SAME_PLACE_M && from_m <= SAME_PLACE_M;
            let at_end = stands
                && open_m >= self.length_m - SAME_PLACE_M
                && to_m >= self.length_m - SAME_PLACE_M;
            let is_apart = to_m <= closed_m + SAME_PLACE_M || from_m >= open_m - SAME_PLACE_M;
            is_apart && !at_begin && !at_end
        })
    }

    /// True if a drive meets no region.
    pub(super) fn is_free(&self, timed: &TimedPath) -> bool {
        self.is_free_from(timed, 0.0)
    }

    /// The same, from a time on.
    pub(super) fn is_free_from(&self, timed: &TimedPath, from_s: f64) -> bool {
        let first = (from_s / self.time_step_s + SAME_PLACE_M).floor() as usize;
        let s_m = |t_s: f64| timed.at(t_s).s_m;
        (first..self.slabs.len()).all(|slab| {
            let begin_s = (slab as f64 * self.time_step_s).max(from_s);
            let end_s = if slab + 1 == self.slabs.len() {
                timed.duration_s().max(begin_s)
            } else {
                (slab + 1) as f64 * self.time_step_s
            };
            self.is_open(slab, [s_m(begin_s), s_m(end_s)])
        })
    }

    /// The beginning of the first stretch ahead of a place that stays closed; none where all is
    /// open in the end.
    pub(super) fn closed_for_good_m(&self, s_m: f64) -> Option<f64> {
        let ahead = self.closed(usize::MAX).iter();
        let mut ahead = ahead.map(|run| run[0]);
        ahead.find(|&closed_m| closed_m >= s_m - SAME_PLACE_M)
    }
}

/// What an obstacle covers over a slab.
fn covered(obstacle: &Predicted, from_s: f64, to_s: f64) -> Hull {
    if to_s.is_infinite() {
        return Hull::new(obstacle.corners_at(to_s), 0.0);
    }
    let bend = obstacle.point_acceleration_mps2();
    // From a chord over a time d a point is off by at most bend d^2 / 8.
    let n_parts = (to_s - from_s) * (0.125 * bend / OBSTACLE_BULGE_M).sqrt();
    let n_parts = n_parts.ceil().clamp(1.0, MAX_POSES);
    let part_s = (to_s - from_s) / n_parts;
    let even = (0..=n_parts as usize).map(|i| from_s + i as f64 * part_s);
    let knots = obstacle.knots();
    let knots = knots.into_iter().filter(|&t_s| t_s > from_s && t_s < to_s);
    let points = even.chain(knots).flat_map(|t_s| obstacle.corners_at(t_s));
    Hull::new(points.collect(), 0.125 * bend * part_s * part_s)
}

/// The union of ranges of pieces, as stretches.
fn united(mut runs: Vec<[usize; 2]>, places_m: &[f64]) -> Vec<[f64; 2]> {
    runs.sort_unstable();
    let mut united: Vec<[usize; 2]> = Vec::new();
    for run in runs {
        match united.last_mut() {
            Some(last) if run[0] <= last[1] => last[1] = last[1].max(run[1]),
            _ => united.push(run),
        }
    }
    let ends = |[first, last]: [usize; 2]| [places_m[first], places_m[last]];
    united.into_iter().map(ends).collect()
}
