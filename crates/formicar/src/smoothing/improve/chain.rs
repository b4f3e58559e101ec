//! A driven path as it is improved: pieces with their poses and what they cost.

use super::task::ImproveTask;
use crate::geometry::{Arc, Pose2};
use crate::objective::VehicleCost;

/// A line or arc of the path.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub(super) start: Pose2,
    pub(super) arc: Arc,
    /// Cost on open ground, meters, without joints.
    pub(super) open_m: f64,
    /// Cost of passing near obstacles, meters.
    pub(super) around_m: f64,
    /// Its least clearance, meters; at most the wish.
    pub(super) least_m: f64,
    /// Driven length before it, meters.
    pub(super) from_m: f64,
}

impl Piece {
    /// The arc up to a driven length.
    pub(super) fn arc_before(&self, driven_m: f64) -> Arc {
        let signed_m = driven_m.copysign(self.arc.signed_length_m);
        Arc::new(self.arc.curvature_per_m, signed_m)
    }

    /// The arc after a driven length.
    pub(super) fn arc_after(&self, driven_m: f64) -> Arc {
        let rest_m = (self.arc.length_m() - driven_m).max(0.0);
        let signed_m = rest_m.copysign(self.arc.signed_length_m);
        Arc::new(self.arc.curvature_per_m, signed_m)
    }

    /// The pose after a driven length.
    pub(super) fn pose_at(&self, driven_m: f64) -> Pose2 {
        self.arc_before(driven_m).end_from(self.start)
    }

    pub(super) fn is_forward(&self) -> bool {
        self.arc.signed_length_m > 0.0
    }
}

/// A place on the path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PathPosition {
    pub(super) piece: usize,
    /// Driven on the piece, from 0 to its length, meters.
    pub(super) driven_m: f64,
}

/// Pieces one after the other; no two neighbors continue one motion.
#[derive(Clone, Debug)]
pub(super) struct Chain {
    pub(super) pieces: Vec<Piece>,
    pub(super) length_m: f64,
    /// Cost of pieces and joints on open ground, meters.
    pub(super) open_m: f64,
    /// Length driven in reverse, meters.
    pub(super) reversed_m: f64,
    /// Cost of passing near obstacles, meters.
    pub(super) around_m: f64,
    /// Cost of the path, meters.
    pub(super) cost_m: f64,
}

impl Chain {
    /// Places nearer to the end of a piece than this are that end, meters.
    const SNAP_M: f64 = 1e-6;

    /// The path along arcs that are merged already, at least one.
    pub(super) fn new(task: &ImproveTask, start: Pose2, arcs: &[Arc]) -> Self {
        let mut pose = start;
        let piece_along = |&arc: &Arc| {
            let start = pose;
            pose = arc.end_from(pose);
            Piece {
                start,
                arc,
                open_m: task.meter.open_ground_m(arc),
                around_m: task.meter.around_m(start, arc, f64::INFINITY),
                least_m: task
                    .meter
                    .least_clearance_m(start, arc, [0.0, f64::INFINITY]),
                from_m: 0.0,
            }
        };
        let mut chain = Self {
            pieces: arcs.iter().map(piece_along).collect(),
            length_m: 0.0,
            open_m: 0.0,
            reversed_m: 0.0,
            around_m: 0.0,
            cost_m: 0.0,
        };
        chain.measure(task);
        chain
    }

    /// Sums up lengths and costs anew.
    pub(super) fn measure(&mut self, task: &ImproveTask) {
        let mut from_m = 0.0;
        for piece in &mut self.pieces {
            piece.from_m = from_m;
            from_m += piece.arc.length_m();
        }
        self.length_m = from_m;
        self.open_m = open_m(task, &self.pieces);
        self.around_m = self.pieces.iter().map(|piece| piece.around_m).sum();
        self.reversed_m = reversed_m(&self.pieces);
        let open_m = self.open_m + task.meter.long_reverse_m(self.reversed_m);
        self.cost_m = path_m(task, open_m, self.around_m, least_m(&self.pieces));
    }

    pub(super) fn arcs(&self) -> Vec<Arc> {
        self.pieces.iter().map(|piece| piece.arc).collect()
    }

    /// The place after a driven length.
    pub(super) fn position(&self, driven_m: f64) -> PathPosition {
        let after = self.pieces.partition_point(|p| p.from_m <= driven_m);
        let piece = after.saturating_sub(1);
        let length_m = self.pieces[piece].arc.length_m();
        let on_piece_m = (driven_m - self.pieces[piece].from_m).clamp(0.0, length_m);
        let driven_m = if on_piece_m < Self::SNAP_M {
            0.0
        } else if on_piece_m > length_m - Self::SNAP_M {
            length_m
        } else {
            on_piece_m
        };
        PathPosition { piece, driven_m }
    }

    /// The joint or end of the path that is nearest to a driven length, as a driven length.
    pub(super) fn nearest_joint_m(&self, driven_m: f64) -> f64 {
        let piece = &self.pieces[self.position(driven_m).piece];
        let (from_m, length_m) = (piece.from_m, piece.arc.length_m());
        if driven_m - from_m < 0.5 * length_m {
            from_m
        } else {
            from_m + length_m
        }
    }

    pub(super) fn pose(&self, position: PathPosition) -> Pose2 {
        self.pieces[position.piece].pose_at(position.driven_m)
    }

    /// Driven lengths at which the gear changes.
    pub(super) fn cusps_m(&self) -> Vec<f64> {
        let joints = self.pieces.windows(2);
        let cusps = joints.filter(|w| w[0].is_forward() != w[1].is_forward());
        cusps.map(|w| w[1].from_m).collect()
    }
}

/// The cost of pieces and the joints between them on open ground, meters.
pub(super) fn open_m(task: &ImproveTask, pieces: &[Piece]) -> f64 {
    let joints = pieces.windows(2);
    let joints = joints.map(|w| task.meter.joint_m(w[0].arc, w[1].arc));
    pieces.iter().map(|piece| piece.open_m).sum::<f64>() + joints.sum::<f64>()
}

/// The cost of a path from that on open ground, that of nearness, and the least clearance.
pub(super) fn path_m(task: &ImproveTask, open_m: f64, around_m: f64, least_m: f64) -> f64 {
    open_m + around_m + task.meter.least_clearance_price_m(open_m, least_m)
}

/// The length of pieces driven in reverse, meters.
pub(super) fn reversed_m(pieces: &[Piece]) -> f64 {
    let lengths = pieces
        .iter()
        .map(|piece| VehicleCost::reversed_m(piece.arc));
    lengths.sum()
}

/// The least clearance of pieces, meters; at most the wish.
pub(super) fn least_m(pieces: &[Piece]) -> f64 {
    pieces.iter().fold(f64::INFINITY, |m, p| m.min(p.least_m))
}
