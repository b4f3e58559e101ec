//! A stretch of the path that may be replaced, and the cost of its replacement.

use super::chain::{Chain, PathPosition, Piece, least_m, open_m, path_m, reversed_m};
use super::task::ImproveTask;
use crate::collision::MIN_CLEARANCE_M;
use crate::geometry::{Arc, Curve, Pose2};
use crate::objective::VehicleCost;

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
    /// Cost of the path, which a replacement must undercut.
    path_m: f64,
    /// Of the pieces and joints that it does not touch.
    outside: Sums,
    outside_least_m: f64,
}

/// Sums over pieces of a path: cost on open ground, length driven in reverse, cost of nearness.
#[derive(Clone, Copy, Debug, Default)]
#[allow(clippy::struct_field_names, reason = "the names end in their unit")]
struct Sums {
    open_m: f64,
    reversed_m: f64,
    around_m: f64,
}

/// A piece that is yet to be priced.
#[derive(Clone, Copy)]
struct Draft {
    start: Pose2,
    arc: Arc,
    open_m: f64,
    around_m: Option<f64>,
    least_m: Option<f64>,
}

/// Curves from place to place of a window, one after the other.
#[derive(Clone, Copy)]
pub(super) struct Route {
    pub(super) start: Pose2,
    pub(super) curves: [Curve; 2],
    /// A lower bound of what the path would cost, meters.
    pub(super) bound_m: f64,
    /// A clearance below which the path would not gain, meters; at least 0.
    pub(super) low_m: f64,
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

    /// Whether it certainly hits something or is too near to gain.
    pub(super) fn is_certainly_too_near(&self, task: &ImproveTask) -> bool {
        let mut arcs = self.placed();
        arcs.any(|(start, arc)| task.is_certainly_nearer(start, arc, self.low_m))
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
        Self {
            first,
            last,
            head: Draft::before(task, &pieces[first], head_m),
            tail: Draft::after(task, &pieces[last], tail_from_m),
            path_m: chain.cost_m,
            outside: Sums {
                open_m: chain.open_m - open_m(task, touched),
                reversed_m: chain.reversed_m - reversed_m(touched),
                around_m: chain.around_m - touched.iter().map(|p| p.around_m).sum::<f64>(),
            },
            outside_least_m: least_m(&pieces[..first]).min(least_m(&pieces[last + 1..])),
        }
    }

    /// The cost of the path with a replacement, given its sums and its least clearance.
    fn new_path_m(&self, task: &ImproveTask, inside: Sums, least_m: f64) -> f64 {
        let whole = self.outside.plus(inside);
        let least_m = least_m.min(self.outside_least_m);
        path_m(task, whole.ground_m(task), whole.around_m, least_m)
    }

    fn gains(&self, path_m: f64) -> bool {
        path_m < self.path_m - LEAST_GAIN_M
    }

    /// The clearance below which a replacement does not gain, given its cost without the price of
    /// that.
    fn low_m(&self, task: &ImproveTask, inside: Sums) -> f64 {
        let whole = self.outside.plus(inside);
        let ground_m = whole.ground_m(task);
        let price_m = self.path_m - ground_m - whole.around_m;
        task.meter.least_clearance_for_m(ground_m, price_m).max(0.0)
    }

    /// The route with its bound; none where that is too high.
    pub(super) fn bounded(&self, task: &ImproveTask, mut route: Route) -> Option<Route> {
        let rests = [&self.head, &self.tail].map(|rest| rest.as_ref().map(|rest| rest.arc));
        let drafts = [&self.head, &self.tail].into_iter().flatten();
        let least_m = drafts.clone().filter_map(|rest| rest.least_m);
        let least_m = least_m.fold(f64::INFINITY, f64::min);
        let mut sums = Sums::default();
        for rest in drafts {
            sums.open_m += rest.open_m;
            sums.reversed_m += VehicleCost::reversed_m(rest.arc);
            sums.around_m += rest.around_m.unwrap_or(0.0);
        }
        let mut before = rests[0];
        for arc in route.arcs() {
            sums.open_m += task.meter.open_ground_m(arc);
            sums.open_m += before.map_or(0.0, |before| task.meter.joint_m(before, arc));
            sums.reversed_m += VehicleCost::reversed_m(arc);
            before = Some(arc);
        }
        if let (Some(before), Some(tail)) = (before, rests[1]) {
            sums.open_m += task.meter.joint_m(before, tail);
        }
        route.bound_m = self.new_path_m(task, sums, least_m);
        if !self.gains(route.bound_m) {
            return None;
        }
        route.low_m = self.low_m(task, sums);
        Some(route)
    }

    /// Computes cost and clearance of the remaining parts, once for all routes.
    pub(super) fn settle(&mut self, task: &ImproveTask) {
        for rest in [&mut self.head, &mut self.tail].into_iter().flatten() {
            if rest.around_m.is_none() {
                let around_m = task.meter.around_m(rest.start, rest.arc, f64::INFINITY);
                rest.around_m = Some(around_m);
            }
            if rest.least_m.is_none() {
                let limits_m = [0.0, f64::INFINITY];
                let least_m = task.meter.least_clearance_m(rest.start, rest.arc, limits_m);
                rest.least_m = Some(least_m);
            }
        }
    }

    /// Replaces the stretch if the route is cheaper and free; returns whether it did.
    pub(super) fn replace(&self, task: &ImproveTask, chain: &mut Chain, route: &Route) -> bool {
        let mut drafts = self.drafts(task, route);
        if drafts.is_empty() || !self.price(task, &mut drafts) {
            return false;
        }
        if !self.keeps_clear(task, route, &mut drafts) {
            return false;
        }
        let pieces = drafts.iter().map(|draft| Piece {
            start: draft.start,
            arc: draft.arc,
            open_m: draft.open_m,
            around_m: draft.around_m.unwrap_or_default(),
            least_m: draft.least_m.unwrap_or(f64::INFINITY),
            from_m: 0.0,
        });
        chain.pieces.splice(self.first..=self.last, pieces);
        chain.measure(task);
        true
    }

    /// Whether the route is free and its least clearance leaves a gain; finds that of the drafts.
    fn keeps_clear(&self, task: &ImproveTask, route: &Route, drafts: &mut [Draft]) -> bool {
        if !task.meter.counts_least_clearance() {
            return route.placed().all(|(start, arc)| task.is_free(start, arc));
        }
        let sums = Sums::of_drafts(task, drafts);
        let low_m = self.low_m(task, sums).max(MIN_CLEARANCE_M);
        let mut path_least_m = f64::INFINITY;
        for draft in drafts {
            let least_m = draft.least_m.unwrap_or_else(|| {
                let limits_m = [low_m, f64::INFINITY];
                task.meter
                    .least_clearance_m(draft.start, draft.arc, limits_m)
            });
            if least_m <= low_m {
                return false;
            }
            draft.least_m = Some(least_m);
            path_least_m = path_least_m.min(least_m);
        }
        self.gains(self.new_path_m(task, sums, path_least_m))
    }

    /// The pieces that replace the touched ones; pieces of one motion are merged.
    fn drafts(&self, task: &ImproveTask, route: &Route) -> Vec<Draft> {
        let inner = route.placed();
        let inner = inner.map(|(start, arc)| Draft::new(task, start, arc));
        let mut drafts: Vec<Draft> = Vec::with_capacity(12);
        for draft in self.head.into_iter().chain(inner).chain(self.tail) {
            match drafts.last_mut() {
                Some(last) if last.arc.continues_in(draft.arc) => {
                    let length_m = last.arc.signed_length_m + draft.arc.signed_length_m;
                    let arc = Arc::new(last.arc.curvature_per_m, length_m);
                    *last = Draft::new(task, last.start, arc);
                }
                _ => drafts.push(draft),
            }
        }
        drafts
    }

    /// Computes the cost of the drafts; returns whether it is less than before.
    fn price(&self, task: &ImproveTask, drafts: &mut [Draft]) -> bool {
        let sums = Sums::of_drafts(task, drafts);
        let least_m = drafts.iter().filter_map(|draft| draft.least_m);
        let least_m = least_m.fold(f64::INFINITY, f64::min);
        let known_m = self.new_path_m(task, sums, least_m);
        let mut left_m = self.path_m - LEAST_GAIN_M - known_m;
        for draft in drafts.iter_mut().filter(|draft| draft.around_m.is_none()) {
            if left_m <= 0.0 {
                return false;
            }
            let around_m = task.meter.around_m(draft.start, draft.arc, left_m);
            draft.around_m = Some(around_m);
            left_m -= around_m;
        }
        left_m > 0.0
    }
}

impl Sums {
    /// Of drafts and the joints between them; nearness that is not known yet counts as none.
    fn of_drafts(task: &ImproveTask, drafts: &[Draft]) -> Self {
        let joints = drafts.windows(2);
        let joints = joints.map(|w| task.meter.joint_m(w[0].arc, w[1].arc));
        let mut sums = Self {
            open_m: joints.sum(),
            ..Self::default()
        };
        for draft in drafts {
            sums.open_m += draft.open_m;
            sums.reversed_m += VehicleCost::reversed_m(draft.arc);
            sums.around_m += draft.around_m.unwrap_or(0.0);
        }
        sums
    }

    fn plus(self, other: Self) -> Self {
        Self {
            open_m: self.open_m + other.open_m,
            reversed_m: self.reversed_m + other.reversed_m,
            around_m: self.around_m + other.around_m,
        }
    }

    /// The cost on open ground, what reverse adds to it included.
    fn ground_m(&self, task: &ImproveTask) -> f64 {
        self.open_m + task.meter.long_reverse_m(self.reversed_m)
    }
}

impl Draft {
    fn new(task: &ImproveTask, start: Pose2, arc: Arc) -> Self {
        Self {
            start,
            arc,
            open_m: task.meter.open_ground_m(arc),
            around_m: None,
            least_m: None,
        }
    }

    fn whole(piece: &Piece) -> Self {
        Self {
            start: piece.start,
            arc: piece.arc,
            open_m: piece.open_m,
            around_m: Some(piece.around_m),
            least_m: Some(piece.least_m),
        }
    }

    /// A part of a piece: it has as much room where that has all it wants.
    fn part(task: &ImproveTask, piece: &Piece, start: Pose2, arc: Arc) -> Self {
        Self {
            least_m: task
                .meter
                .is_enough_m(piece.least_m)
                .then_some(piece.least_m),
            ..Self::new(task, start, arc)
        }
    }

    /// The part of a piece before a place on it.
    fn before(task: &ImproveTask, piece: &Piece, driven_m: f64) -> Option<Self> {
        if driven_m == piece.arc.length_m() {
            return Some(Self::whole(piece));
        }
        let arc = piece.arc_before(driven_m);
        (driven_m > 0.0).then(|| Self::part(task, piece, piece.start, arc))
    }

    /// The part of a piece after a place on it.
    fn after(task: &ImproveTask, piece: &Piece, driven_m: f64) -> Option<Self> {
        if driven_m == 0.0 {
            return Some(Self::whole(piece));
        }
        let arc = piece.arc_after(driven_m);
        let start = piece.pose_at(driven_m);
        (arc.signed_length_m != 0.0).then(|| Self::part(task, piece, start, arc))
    }
}
