//! Collision checks and costs of the pieces that round a polyline.

use super::config::SmoothingConfig;
use super::roadmap::Facing;
use crate::collision::{Body, Drive, ObstacleMap};
use crate::geometry::{Arc, Curve, Pose2, dubins, reeds_shepp};
use crate::objective::VehicleCost;
use crate::vehicle::Gears;

/// Cost of a line or an arc along which the margin is not kept, turning radii.
const TIGHT_RADII: f64 = 1.0;

/// The poses from which curves lead onto the polyline, and those to which they lead from it.
#[derive(Clone, Debug, Default)]
pub(super) struct Ends {
    pub(super) starts: Vec<Pose2>,
    pub(super) goals: Vec<Pose2>,
    /// Whether the path may begin as the polyline does.
    pub(super) start_is_free: bool,
    /// Whether the path may end as the polyline does.
    pub(super) goal_is_free: bool,
}

/// A body on a map, its parameters and its ends; grid coordinates.
#[derive(Clone, Copy)]
pub(super) struct RoundingTask<'a> {
    pub(super) obstacles: &'a ObstacleMap,
    pub(super) body: &'a Body,
    /// The body with the margin that it keeps where it can.
    pub(super) careful_body: &'a Body,
    pub(super) radius_m: f64,
    pub(super) config: &'a SmoothingConfig,
    pub(super) cost: &'a VehicleCost,
    pub(super) gears: Gears,
    pub(super) ends: &'a Ends,
    /// Whether to go on; where not, results are of no use.
    pub(super) goes_on: &'a dyn Fn() -> bool,
}

impl RoundingTask<'_> {
    /// True once the result is of no use any more.
    pub(super) fn is_over(&self) -> bool {
        !(self.goes_on)()
    }

    /// The longest stretch of the polyline that one curve replaces, meters.
    pub(super) fn reach_m(&self) -> f64 {
        self.config.reach_radii * self.radius_m
    }

    /// Facings in which the polyline may be followed.
    pub(super) fn facings(&self) -> &'static [Facing] {
        match self.gears {
            Gears::Forward => &[Facing::Along],
            Gears::Both => &[Facing::Along, Facing::Against],
        }
    }

    /// The curves between two poses that the request allows.
    pub(super) fn words(&self, from: Pose2, to: Pose2) -> Vec<Curve> {
        self.words_at(from, to, self.radius_m)
    }

    /// The same with another radius of their arcs, meters.
    pub(super) fn words_at(&self, from: Pose2, to: Pose2, radius_m: f64) -> Vec<Curve> {
        match self.gears {
            Gears::Forward => dubins::candidates(from, to, radius_m),
            Gears::Both => reeds_shepp::candidates(from, to, radius_m),
        }
    }

    /// Whether the body is free along a line or arc.
    pub(super) fn is_free(&self, start: Pose2, arc: Arc) -> bool {
        self.obstacles.is_free(self.body, &drive(start, arc))
    }

    /// Whether the body is free along arcs driven one after the other.
    pub(super) fn all_free(&self, start: Pose2, arcs: &[Arc]) -> bool {
        self.is_body_free(self.body, start, arcs)
    }

    /// Cost of passing near obstacles along arcs, meters: 0 where the body keeps its margin; none
    /// where it hits something.
    pub(super) fn tightness_m(&self, start: Pose2, arcs: &[Arc]) -> Option<f64> {
        if self.is_body_free(self.careful_body, start, arcs) {
            return Some(0.0);
        }
        self.all_free(start, arcs)
            .then_some(TIGHT_RADII * self.radius_m)
    }

    /// Checks short pieces of the arcs, those that look tightest first: collisions are most likely
    /// there.
    fn is_body_free(&self, body: &Body, start: Pose2, arcs: &[Arc]) -> bool {
        let mut pose = start;
        let mut pieces = Vec::new();
        for &arc in arcs {
            let drive = drive(pose, arc);
            for piece in drive.pieces(drive.n_pieces(body)) {
                let middle = piece.pose_at(0.5);
                let ceiling_m = self.obstacles.clearance_ceiling_m(body, middle);
                if ceiling_m < 0.0 {
                    return false;
                }
                pieces.push((ceiling_m, piece));
            }
            pose = arc.end_from(pose);
        }
        pieces.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut pieces = pieces.iter();
        pieces.all(|(_, piece)| self.obstacles.is_free(body, piece))
    }

    /// Cost of a curve between two gears; 0 stands for no gear.
    pub(super) fn word_cost(&self, curve: &Curve, [before, after]: [f64; 2]) -> f64 {
        let mut gear = before;
        let mut cost = 0.0;
        for arc in curve.arcs() {
            let next = arc.signed_length_m.signum();
            cost += self.cost.open_ground_m(*arc) + self.cost.gear_change_m(gear, next);
            gear = next;
        }
        cost + self.cost.gear_change_m(gear, after)
    }
}

fn drive(start: Pose2, arc: Arc) -> Drive {
    Drive {
        start,
        curvature_per_m: arc.curvature_per_m,
        signed_length_m: arc.signed_length_m,
    }
}
