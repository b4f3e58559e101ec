//! A stretch of the path that may be replaced, and the cost of its replacement.

use super::chain::{Chain, PathPosition, Piece};
use super::task::ImproveTask;
use crate::geometry::{Arc, Curve, Pose2};

/// Least gain of a replacement, meters: more than rounding.
const LEAST_GAIN_M: f64 = 1e-6;

/// A stretch between two places, with the rests of the pieces that it cuts.
pub(super) struct Window {
    /// The pieces that it touches.
    first: usize,
    last: usize,
    /// The remaining parts of the first and the last piece.
    head: Option<Draft>,
    tail: Option<Draft>,
    /// Cost of the touched pieces with the joints between them.
    old_m: f64,
}

/// A piece that is yet to be priced.
#[derive(Clone, Copy)]
struct Draft {
    start: Pose2,
    arc: Arc,
    known_m: Option<f64>,
}

/// Curves from place to place of a window, one after the other.
#[derive(Clone, Copy)]
pub(super) struct Route {
    pub(super) start: Pose2,
    pub(super) curves: [Curve; 2],
    /// A lower bound of what the touched pieces would cost, meters.
    pub(super) bound_m: f64,
}

impl Route {
    fn arcs(&self) -> impl DoubleEndedIterator<Item = Arc> + '_ {
        self.curves.iter().flat_map(Curve::arcs).copied()
    }

    /// The arcs with the poses at which they begin.
    fn placed(&self) -> impl Iterator<Item = (Pose2, Arc)> + '_ {
        let mut pose = self.start;
        self.arcs().map(move |arc| {
            let start = pose;
            pose = arc.end_from(pose);
            (start, arc)
        })
    }

    /// Whether it certainly hits something.
    pub(super) fn certainly_hits(&self, task: &ImproveTask) -> bool {
        let mut arcs = self.placed();
        arcs.any(|(start, arc)| task.certainly_hits(start, arc))
    }
}

impl Window {
    /// The stretch from a place to a later one.
    pub(super) fn new(
        task: &ImproveTask,
        chain: &Chain,
        from: PathPosition,
        to: PathPosition,
    ) -> Self {
        let pieces = &chain.pieces;
        // A place between two pieces belongs to the one outside: it may be continued.
        let (first, head_m) = match from.piece.checked_sub(1) {
            Some(before) if from.driven_m == 0.0 => (before, pieces[before].arc.length_m()),
            _ => (from.piece, from.driven_m),
        };
        let (mut last, mut tail_from_m) = (to.piece, to.driven_m);
        if tail_from_m == pieces[last].arc.length_m() && last + 1 < pieces.len() {
            (last, tail_from_m) = (last + 1, 0.0);
        }
        let touched = &pieces[first..=last];
        let joints = touched.windows(2);
        let joints = joints.map(|w| task.meter.joint_m(w[0].arc, w[1].arc));
        Self {
            first,
            last,
            head: Draft::before(&pieces[first], head_m),
            tail: Draft::after(&pieces[last], tail_from_m),
            old_m: touched.iter().map(|p| p.cost_m).sum::<f64>() + joints.sum::<f64>(),
        }
    }

    /// The route with its bound; none where that is too high.
    pub(super) fn bounded(&self, task: &ImproveTask, mut route: Route) -> Option<Route> {
        let rests = [&self.head, &self.tail].map(|rest| rest.as_ref().map(|rest| rest.arc));
        let [head, tail] = [&self.head, &self.tail].map(|rest| {
            rest.as_ref().map_or(0.0, |rest| {
                rest.known_m.unwrap_or(task.meter.open_ground_m(rest.arc))
            })
        });
        let mut bound_m = head + tail;
        let mut before = rests[0];
        for arc in route.arcs() {
            bound_m += task.meter.open_ground_m(arc);
            bound_m += before.map_or(0.0, |before| task.meter.joint_m(before, arc));
            before = Some(arc);
        }
        if let (Some(before), Some(tail)) = (before, rests[1]) {
            bound_m += task.meter.joint_m(before, tail);
        }
        route.bound_m = bound_m;
        (bound_m < self.old_m - LEAST_GAIN_M).then_some(route)
    }

    /// Computes the cost of the remaining parts, once for all routes.
    pub(super) fn settle(&mut self, task: &ImproveTask) {
        for rest in [&mut self.head, &mut self.tail].into_iter().flatten() {
            if rest.known_m.is_none() {
                rest.known_m = Some(task.meter.arc_m(rest.start, rest.arc));
            }
        }
    }

    /// Replaces the stretch if the route is cheaper and free; returns whether it did.
    pub(super) fn replace(&self, task: &ImproveTask, chain: &mut Chain, route: &Route) -> bool {
        let mut drafts = self.drafts(route);
        if drafts.is_empty() || !self.price(task, &mut drafts) {
            return false;
        }
        let is_free = route.placed().all(|(start, arc)| task.is_free(start, arc));
        if is_free {
            let pieces = drafts.iter().map(|draft| Piece {
                start: draft.start,
                arc: draft.arc,
                cost_m: draft.known_m.unwrap_or_default(),
                from_m: 0.0,
            });
            chain.pieces.splice(self.first..=self.last, pieces);
            chain.measure(task);
        }
        is_free
    }

    /// The pieces that replace the touched ones; pieces of one motion are merged.
    fn drafts(&self, route: &Route) -> Vec<Draft> {
        let inner = route.placed().map(|(start, arc)| Draft {
            start,
            arc,
            known_m: None,
        });
        let mut drafts: Vec<Draft> = Vec::with_capacity(12);
        for draft in self.head.into_iter().chain(inner).chain(self.tail) {
            match drafts.last_mut() {
                Some(last) if last.arc.continues_in(draft.arc) => {
                    last.arc.signed_length_m += draft.arc.signed_length_m;
                    last.known_m = None;
                }
                _ => drafts.push(draft),
            }
        }
        drafts
    }

    /// Computes the cost of the drafts; returns whether it is less than before.
    fn price(&self, task: &ImproveTask, drafts: &mut [Draft]) -> bool {
        let joints = drafts.windows(2);
        let joints = joints.map(|w| task.meter.joint_m(w[0].arc, w[1].arc));
        let grounds = drafts.iter();
        let grounds = grounds.map(|d| d.known_m.unwrap_or(task.meter.open_ground_m(d.arc)));
        let mut left_m = self.old_m - LEAST_GAIN_M - joints.sum::<f64>() - grounds.sum::<f64>();
        for draft in drafts.iter_mut().filter(|draft| draft.known_m.is_none()) {
            if left_m <= 0.0 {
                return false;
            }
            let around_m = task.meter.around_m(draft.start, draft.arc, left_m);
            draft.known_m = Some(task.meter.open_ground_m(draft.arc) + around_m);
            left_m -= around_m;
        }
        left_m > 0.0
    }
}

impl Draft {
    /// The part of a piece before a place on it.
    fn before(piece: &Piece, driven_m: f64) -> Option<Self> {
        let whole = driven_m == piece.arc.length_m();
        (driven_m > 0.0).then(|| Self {
            start: piece.start,
            arc: piece.arc_before(driven_m),
            known_m: whole.then_some(piece.cost_m),
        })
    }

    /// The part of a piece after a place on it.
    fn after(piece: &Piece, driven_m: f64) -> Option<Self> {
        let whole = driven_m == 0.0;
        let arc = piece.arc_after(driven_m);
        (arc.signed_length_m != 0.0).then(|| Self {
            start: piece.pose_at(driven_m),
            arc,
            known_m: whole.then_some(piece.cost_m),
        })
    }
}
