//! Local search over a chain of legs and arcs: corners are moved, merged and dropped.

use super::fillet::{Fillet, Rounded};
use crate::geometry::{Arc, Point2, Pose2, angle_difference};
use crate::smoothing::task::RoundingTask;
use std::ops::RangeInclusive;

/// Steps by which corners are moved, turning radii, largest first.
const MOVES_RADII: [f64; 4] = [0.6, 0.3, 0.12, 0.05];
/// Most passes over all corners with each step.
const MAX_PASSES: usize = 4;
/// Least gain of a change, meters.
const LEAST_GAIN_M: f64 = 1e-6;

/// Points with an arc at each, except the first and the last.
#[derive(Clone, Debug)]
pub(super) struct Chain {
    pub(super) points: Vec<Point2>,
    pub(super) fillets: Vec<Fillet>,
    /// Cost of passing near obstacles, by leg, meters.
    pub(super) tightness_m: Vec<f64>,
    /// Whether the first leg must keep its direction, and the last one.
    pub(super) first_is_fixed: bool,
    pub(super) last_is_fixed: bool,
}

impl Chain {
    /// Moves, merges and drops corners as long as that lowers the cost.
    pub(super) fn refine(&mut self, task: &RoundingTask) {
        self.measure(task);
        for step_radii in MOVES_RADII {
            for _ in 0..MAX_PASSES {
                if !self.pass(task, step_radii * task.radius_m) {
                    break;
                }
            }
        }
    }

    /// Computes the cost of passing near obstacles for all arcs and legs.
    fn measure(&mut self, task: &RoundingTask) {
        for corner in 1..self.points.len() - 1 {
            let fillet = self.fillets[corner - 1];
            let tightness_m = self.arc_tightness_m(task, corner, &fillet);
            self.fillets[corner - 1].tightness_m = tightness_m.unwrap_or_default();
        }
        self.measure_legs(task, 0..=self.points.len() - 2);
    }

    /// Tries all corners once; returns whether the cost fell.
    fn pass(&mut self, task: &RoundingTask, step_m: f64) -> bool {
        let mut has_gained = false;
        let mut corner = 1;
        while corner < self.points.len() - 1 && !task.is_over() {
            let without = self.without(corner);
            if without.is_some_and(|chain| self.take_if_cheaper(task, chain, corner - 1..=corner)) {
                has_gained = true;
                continue;
            }
            let merged = self.merged(corner);
            if merged
                .is_some_and(|chain| self.take_if_cheaper(task, chain, corner - 1..=corner + 1))
            {
                has_gained = true;
                continue;
            }
            for to in self.moves(corner, step_m) {
                let mut moved = self.clone();
                moved.points[corner] = to;
                if self.take_if_cheaper(task, moved, corner - 1..=corner + 1) {
                    has_gained = true;
                }
            }
            corner += 1;
        }
        has_gained
    }

    /// The chain without a corner; none where that would turn a leg whose direction is fixed.
    fn without(&self, corner: usize) -> Option<Self> {
        let is_fixed = self.first_is_fixed && corner == 1
            || self.last_is_fixed && corner + 2 == self.points.len();
        (!is_fixed).then(|| {
            let mut chain = self.clone();
            chain.points.remove(corner);
            chain.fillets.remove(corner - 1);
            chain.tightness_m.remove(corner);
            chain
        })
    }

    /// The chain with a corner and the next one merged where the legs on both sides meet; none
    /// where these do not meet ahead.
    fn merged(&self, corner: usize) -> Option<Self> {
        if corner + 2 >= self.points.len() {
            return None;
        }
        let [before, after] =
            [corner - 1, corner + 1].map(|leg| Point2::unit(self.heading_rad(leg)));
        let between = self.points[corner + 1] - self.points[corner];
        let ahead_m = between.cross(after) / before.cross(after);
        let back_m = between.cross(before) / before.cross(after);
        let meets = ahead_m.is_finite() && ahead_m > 0.0 && back_m < 0.0;
        meets.then(|| {
            let mut chain = self.clone();
            chain.points[corner] = self.points[corner] + before * ahead_m;
            chain.points.remove(corner + 1);
            chain.fillets.remove(corner);
            chain.tightness_m.remove(corner);
            chain
        })
    }

    /// Candidate positions of a corner: outward, inward, and along both legs.
    fn moves(&self, corner: usize, step_m: f64) -> Vec<Point2> {
        let at = self.points[corner];
        let [back, on] = [corner - 1, corner].map(|leg| Point2::unit(self.heading_rad(leg)));
        let mut directions = Vec::new();
        let first_is_fixed = self.first_is_fixed && corner == 1;
        let last_is_fixed = self.last_is_fixed && corner + 2 == self.points.len();
        if !first_is_fixed && !last_is_fixed {
            let out = back - on;
            let out = if out.norm() > 1e-6 {
                out * (1.0 / out.norm())
            } else {
                back.perpendicular()
            };
            directions.extend([out, -out]);
        }
        if !last_is_fixed {
            directions.extend([back, -back]);
        }
        if !first_is_fixed {
            directions.extend([on, -on]);
        }
        directions
            .into_iter()
            .map(|direction| at + direction * step_m)
            .collect()
    }

    /// Takes a changed chain if the corners of a range, all that differ, become cheaper and its
    /// body stays free.
    fn take_if_cheaper(
        &mut self,
        task: &RoundingTask,
        mut to: Self,
        changed: RangeInclusive<usize>,
    ) -> bool {
        let corners =
            |chain: &Self| (*changed.start()).max(1)..=(*changed.end()).min(chain.points.len() - 2);
        let n_removed = self.points.len() - to.points.len();
        let before =
            *changed.start().max(&1)..=(changed.end() + n_removed).min(self.points.len() - 2);
        let known = self.cost(task, before);
        let legs = corners(&to).start() - 1..=*corners(&to).end();
        // The widest arcs cost least: if they do not gain, no arcs do.
        to.tightness_m[legs.clone()].fill(0.0);
        let limit = known - LEAST_GAIN_M;
        let is_better = to.round(task, corners(&to), None)
            && to.cost(task, corners(&to)) < limit
            && to.round(task, corners(&to), Some(limit))
            && to.measure_legs(task, legs)
            && to.cost(task, corners(&to)) < limit;
        if is_better {
            *self = to;
        }
        is_better
    }

    /// Cost of some corners with the legs before, between and behind them.
    fn cost(&self, task: &RoundingTask, corners: RangeInclusive<usize>) -> f64 {
        let legs = corners.start().saturating_sub(1)..=(*corners.end()).max(corners.start() - 1);
        let legs = legs
            .map(|leg| self.length_m(leg) + self.tightness_m[leg])
            .sum::<f64>();
        legs + corners
            .map(|corner| self.fillets[corner - 1].cost(task))
            .sum::<f64>()
    }

    /// Gives some corners their widest arcs or, below a limit of their cost, the widest free ones;
    /// returns whether all corners have one.
    fn round(
        &mut self,
        task: &RoundingTask,
        corners: RangeInclusive<usize>,
        limit: Option<f64>,
    ) -> bool {
        corners.clone().all(|corner| {
            let turn_rad = angle_difference(self.heading_rad(corner), self.heading_rad(corner - 1));
            let room_m = self.room_m(corner, &corners);
            let Some(limit) = limit else {
                let widest = Fillet::new(task, turn_rad, room_m, 0);
                self.fillets[corner - 1] = widest.unwrap_or_default();
                return widest.is_some();
            };
            for n_tighter in 0.. {
                let Some(mut fillet) = Fillet::new(task, turn_rad, room_m, n_tighter) else {
                    return false;
                };
                self.fillets[corner - 1] = fillet;
                if self.cost(task, corners.clone()) >= limit {
                    return false;
                }
                if let Some(tightness_m) = self.arc_tightness_m(task, corner, &fillet) {
                    fillet.tightness_m = tightness_m;
                    self.fillets[corner - 1] = fillet;
                    return true;
                }
            }
            false
        })
    }

    /// Room for a corner's arc on the shorter of both legs, meters: corners beyond a range keep
    /// their arcs, those in it share their legs.
    fn room_m(&self, corner: usize, range: &RangeInclusive<usize>) -> f64 {
        let room = |leg: usize, other: usize| {
            let length_m = self.length_m(leg);
            if other == 0 || other == self.points.len() - 1 {
                length_m
            } else if range.contains(&other) {
                0.5 * length_m
            } else {
                length_m - self.fillets[other - 1].tangent_m
            }
        };
        room(corner - 1, corner - 1).min(room(corner, corner + 1))
    }

    fn arc_tightness_m(&self, task: &RoundingTask, corner: usize, fillet: &Fillet) -> Option<f64> {
        let leg = corner - 1;
        let begins = self.pose(leg, self.length_m(leg) - fillet.tangent_m);
        task.tightness_m(begins, &[fillet.arc()])
    }

    /// Computes the cost of passing near obstacles for some legs; returns whether all are free.
    fn measure_legs(&mut self, task: &RoundingTask, mut legs: RangeInclusive<usize>) -> bool {
        legs.all(|leg| {
            let [from_m, to_m] = self.straight_m(leg);
            let arc = Arc::new(0.0, to_m - from_m);
            let tightness_m = task.tightness_m(self.pose(leg, from_m), &[arc]);
            self.tightness_m[leg] = tightness_m.unwrap_or_default();
            to_m >= from_m && tightness_m.is_some()
        })
    }

    /// The ends of the straight part of a leg, meters from its first point.
    fn straight_m(&self, leg: usize) -> [f64; 2] {
        let tangent_m = |corner: usize| {
            let fillet = corner.checked_sub(1).and_then(|i| self.fillets.get(i));
            fillet.map_or(0.0, |fillet| fillet.tangent_m)
        };
        // Two arcs may share a leg to the last bit.
        let ends_m = self.length_m(leg) - tangent_m(leg + 1);
        [tangent_m(leg), ends_m.max(tangent_m(leg) - 1e-12)].map(|at_m| at_m.max(0.0))
    }

    fn length_m(&self, leg: usize) -> f64 {
        self.points[leg].distance(self.points[leg + 1])
    }

    fn heading_rad(&self, leg: usize) -> f64 {
        (self.points[leg + 1] - self.points[leg]).angle()
    }

    /// The pose on a leg, some meters from its first point.
    pub(super) fn pose(&self, leg: usize, at_m: f64) -> Pose2 {
        Pose2::at(self.points[leg], self.heading_rad(leg)).advance(0.0, at_m)
    }

    /// All straights and arcs in order.
    pub(super) fn arcs(&self) -> Vec<Arc> {
        let mut arcs = Vec::new();
        for leg in 0..self.points.len() - 1 {
            let [from_m, to_m] = self.straight_m(leg);
            arcs.push(Arc::new(0.0, (to_m - from_m).max(0.0)));
            arcs.extend(self.fillets.get(leg).map(Fillet::arc));
        }
        arcs
    }

    /// The corners with a turn.
    pub(super) fn corners(&self) -> Vec<Rounded> {
        let corners = self.points[1..].iter().zip(&self.fillets);
        let rounded = corners.filter_map(|(&place, fillet)| {
            let turning = fillet.turning()?;
            Some(Rounded { place, turning })
        });
        rounded.collect()
    }
}
