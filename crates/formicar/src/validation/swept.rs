//! The swept body against obstacles and border: tightest pieces first.

use super::report::{Violation, ViolationKind};
use crate::collision::{Body, ClothoidDrive, Drive, MIN_CLEARANCE_M, ObstacleMap, Overlap};
use crate::geometry::Pose2;
use crate::numeric::golden_section;
use crate::path::CurvePath;
use crate::vehicle::Vehicle;

/// The place where the body comes nearest to an obstacle, and the place where it touches one.
pub(super) struct Swept {
    pub(super) min_clearance_m: f64,
    pub(super) tightest: Pose2,
    pub(super) tightest_s_m: f64,
    pub(super) violations: Vec<Violation>,
}

/// Most that a body point on a clothoid may be off the arc that is looked at in its place, meters.
/// The deviation is taken off the clearance, which is then a lower bound, too low by less than
/// twice this.
const CLOTHOID_TOLERANCE_M: f64 = 5e-5;

/// A piece of the path with a lower bound of its clearance.
struct Piece {
    drive: Drive,
    /// The largest distance of the path's body points from those of the drive.
    deviation_m: f64,
    s_m: f64,
    bound_m: f64,
}

impl Piece {
    /// A lower bound of the clearance, meters, exact on lines and arcs where it is below `limit_m`.
    fn clearance_m(&self, obstacles: &ObstacleMap, body: &Body, limit_m: f64) -> f64 {
        let limit_m = limit_m + self.deviation_m;
        (obstacles.drive_clearance_m(body, &self.drive, limit_m) - self.deviation_m).max(0.0)
    }

    /// True if it certainly touches nothing. What a point may touch, and what a body may not, is
    /// the collision module's to say; near a clothoid nothing may be touched.
    fn is_free(&self, obstacles: &ObstacleMap, body: &Body) -> bool {
        if self.deviation_m == 0.0 {
            return obstacles.is_free(body, &self.drive);
        }
        self.clearance_m(obstacles, body, 2.0 * MIN_CLEARANCE_M) > MIN_CLEARANCE_M
    }
}

/// Pieces between two questions whether to go on.
const PIECES_PER_LOOK: usize = 16;

/// Checks a whole path; none where `goes_on` ends it before.
pub(super) fn check(
    obstacles: &ObstacleMap,
    vehicle: &Vehicle,
    path: &CurvePath,
    goes_on: &mut dyn FnMut() -> bool,
) -> Option<Swept> {
    let body = Body::new(vehicle);
    let mut pieces = cut(obstacles, &body, path);
    pieces.sort_by(|a, b| a.bound_m.total_cmp(&b.bound_m));
    let mut least = f64::INFINITY;
    let mut tightest = 0;
    let mut touching = Vec::new();
    for (i, piece) in pieces.iter().enumerate() {
        if i.is_multiple_of(PIECES_PER_LOOK) && !goes_on() {
            return None;
        }
        if piece.bound_m >= least.max(2.0 * MIN_CLEARANCE_M) {
            break;
        }
        let clearance = piece.clearance_m(obstacles, &body, least.max(2.0 * MIN_CLEARANCE_M));
        if clearance < least {
            (least, tightest) = (clearance, i);
        }
        if clearance <= 2.0 * MIN_CLEARANCE_M && !piece.is_free(obstacles, &body) {
            touching.push(piece);
        }
    }
    let violations = collisions(obstacles, &body, touching);
    let (pose, driven_m) = narrowest(obstacles, &body, &pieces[tightest].drive);
    Some(Swept {
        min_clearance_m: if violations.is_empty() { least } else { 0.0 },
        tightest: obstacles.frame().to_world(pose).wrapped(),
        tightest_s_m: pieces[tightest].s_m + driven_m,
        violations,
    })
}

fn cut(obstacles: &ObstacleMap, body: &Body, path: &CurvePath) -> Vec<Piece> {
    let frame = obstacles.frame();
    let piece = |drive: Drive, deviation_m: f64, s_m: f64| Piece {
        bound_m: obstacles.clearance_bound_m(body, &drive) - deviation_m,
        drive,
        deviation_m,
        s_m,
    };
    let mut s_m = 0.0;
    let mut pieces = Vec::new();
    for segment in path.segments() {
        let clothoid = ClothoidDrive {
            start: frame.to_grid(segment.start),
            curvature_per_m: segment.curvature_per_m,
            curvature_rate_per_m2: segment.curvature_rate_per_m2,
            signed_length_m: segment.direction.sign() * segment.length_m,
        };
        let arcs = clothoid.arcs(body, CLOTHOID_TOLERANCE_M);
        let arc_m = segment.length_m / arcs.len() as f64;
        for (i, arc) in arcs.iter().enumerate() {
            let n = arc.drive.n_pieces(body);
            let (begin_m, step_m) = (s_m + arc_m * i as f64, arc_m / n as f64);
            let parts = arc.drive.pieces(n).enumerate();
            pieces.extend(
                parts.map(|(k, part)| piece(part, arc.deviation_m, begin_m + step_m * k as f64)),
            );
        }
        s_m += segment.length_m;
    }
    if pieces.is_empty() {
        pieces.push(piece(Drive::at(frame.to_grid(path.start())), 0.0, 0.0));
    }
    pieces
}

/// The pose of least clearance on a piece, and the driven length up to it: samples, then golden
/// section around the best.
fn narrowest(obstacles: &ObstacleMap, body: &Body, drive: &Drive) -> (Pose2, f64) {
    const N_SAMPLES: usize = 16;
    // From an eighth of a piece, which is half a body long, to about a millimeter.
    const N_SECTIONS: u32 = 12;
    let clearance = |t: f64| obstacles.clearance_m(body, drive.pose_at(t));
    let sample = |i: usize| i as f64 / N_SAMPLES as f64;
    let best = (0..=N_SAMPLES)
        .map(sample)
        .min_by(|&a, &b| clearance(a).total_cmp(&clearance(b)))
        .unwrap_or(0.0);
    let width = 1.0 / N_SAMPLES as f64;
    let around = [(best - width).max(0.0), (best + width).min(1.0)];
    let middle = golden_section(clearance, around, N_SECTIONS);
    let t = if clearance(best) <= clearance(middle) {
        best
    } else {
        middle
    };
    (drive.pose_at(t), t * drive.signed_length_m.abs())
}

/// One violation for every stretch of neighboring pieces that touch something.
fn collisions(obstacles: &ObstacleMap, body: &Body, mut touching: Vec<&Piece>) -> Vec<Violation> {
    touching.sort_by(|a, b| a.s_m.total_cmp(&b.s_m));
    let end = |piece: &Piece| piece.s_m + piece.drive.signed_length_m.abs();
    touching
        .chunk_by(|a, b| b.s_m - end(a) < 1e-9)
        .map(|stretch| {
            let last = stretch[stretch.len() - 1];
            violation(obstacles, body, stretch, end(last))
        })
        .collect()
}

fn violation(obstacles: &ObstacleMap, body: &Body, stretch: &[&Piece], end_m: f64) -> Violation {
    const N_SAMPLES: usize = 16;
    let touch = Overlap {
        cell: None,
        depth_m: 0.0,
        n_cells: 1,
    };
    let poses = stretch.iter().flat_map(|piece| {
        (0..=N_SAMPLES).map(|i| {
            let t = i as f64 / N_SAMPLES as f64;
            let pose = piece.drive.pose_at(t);
            let overlap = obstacles.overlap(body, pose).unwrap_or(touch);
            (
                overlap,
                pose,
                piece.s_m + t * piece.drive.signed_length_m.abs(),
            )
        })
    });
    let (overlap, pose, s_m) = poses
        .reduce(|deepest, next| {
            if next.0.depth_m > deepest.0.depth_m {
                next
            } else {
                deepest
            }
        })
        .unwrap_or((touch, stretch[0].drive.start, stretch[0].s_m));
    let leaves = overlap.cell.is_none() && overlap.n_cells == 0;
    let what = match overlap.cell {
        Some(cell) => format!("overlaps cell ({}, {}) by", cell.col, cell.row),
        None if leaves => "leaves the map by".to_owned(),
        None => "touches an obstacle between two poses, overlap".to_owned(),
    };
    let pose = obstacles.frame().to_world(pose).wrapped();
    Violation {
        kind: if leaves {
            ViolationKind::LeavesMap
        } else {
            ViolationKind::Collision
        },
        s_m,
        pose,
        amount: -overlap.depth_m,
        limit: MIN_CLEARANCE_M,
        message: format!(
            "the body {what} {:.4} m at ({:.3}, {:.3}), heading {:.4}, s = {s_m:.3} m (touching from s = {:.3} to {end_m:.3} m); the least clearance allowed is {MIN_CLEARANCE_M} m",
            overlap.depth_m, pose.x, pose.y, pose.heading, stretch[0].s_m
        ),
    }
}
