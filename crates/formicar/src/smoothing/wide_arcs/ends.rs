//! Curves from a given start heading onto a leg, and from a leg to a given goal heading.

use super::search::{Leg, Reached, Search, Step};
use super::sight::Sight;
use crate::geometry::{Arc, Curve, Point2, Pose2};

/// Farthest distance from the ends at which curves to given headings begin and end, turning radii.
const CURVE_REACH_RADII: f64 = 5.0;
/// Radii of these curves, in turning radii.
const CURVE_RADII: [f64; 3] = [1.0, 2.0, 4.0];
/// Curves tried between two poses, cheapest first.
const MAX_CURVES: usize = 6;

impl Search<'_> {
    /// Opens the legs and curves that begin at the start.
    pub(super) fn open_start(&mut self) {
        for sight in self.sights.from(0).to_vec() {
            self.close(Leg::new(0, sight, Reached::AtStart), 0.0);
        }
        if self.task.ends.start_is_free {
            return;
        }
        let corner_m = self.corner_m();
        let start = self.sights.points[0];
        let near = self
            .sights
            .after_start()
            .filter(|&i| self.is_near(start, i));
        for from in near.collect::<Vec<_>>() {
            let least = start.distance(self.sights.points[from]) + corner_m;
            for sight in self.sights.from(from).to_vec() {
                let remaining = sight.distance_m + self.sights.rest_m(sight.to);
                self.open.push([least, remaining], Step::Lead(from, sight));
            }
        }
    }

    pub(super) fn is_near(&self, end: Point2, point: usize) -> bool {
        let reach_m = CURVE_REACH_RADII * self.task.radius_m;
        end.distance(self.sights.points[point]) <= reach_m
    }

    pub(super) fn corner_m(&self) -> f64 {
        self.task.config.corner_radii * self.task.radius_m
    }

    /// Puts the cheapest curves from the start onto a leg on the list.
    pub(super) fn expand_lead(&mut self, from: usize, sight: Sight) {
        if self.is_closed(from, sight) {
            return;
        }
        let to = Pose2::at(self.sights.points[from], sight.heading_rad);
        let remaining = sight.distance_m + self.sights.rest_m(sight.to);
        for (cost, start, curve) in self.cheapest_curves(&self.task.ends.starts, &[to]) {
            let number = self.curves.len();
            self.curves.push((start, curve));
            let step = Step::LeadCurve(from, sight, number);
            self.open.push([cost, remaining], step);
        }
    }

    /// The cheapest curves from one of some poses to one of others.
    fn cheapest_curves(&self, from: &[Pose2], to: &[Pose2]) -> Vec<(f64, Pose2, Curve)> {
        let mut curves = Vec::new();
        for (&a, &b) in from.iter().flat_map(|a| to.iter().map(move |b| (a, b))) {
            for radii in CURVE_RADII {
                let words = self.task.words_at(a, b, radii * self.task.radius_m);
                curves.extend(
                    words
                        .into_iter()
                        .map(|curve| (self.curve_cost(&curve), a, curve)),
                );
            }
        }
        curves.sort_by(|a, b| a.0.total_cmp(&b.0));
        curves.truncate(MAX_CURVES);
        curves
    }

    /// A curve's cost: driving, and for each arc a corner's share and its bend.
    fn curve_cost(&self, curve: &Curve) -> f64 {
        let radius_m = self.task.radius_m;
        let bends = curve.arcs().iter().filter(|arc| arc.curvature_per_m != 0.0);
        let bends = bends.map(|arc| {
            let bend = (arc.curvature_per_m * radius_m).powi(2) * arc.length_m();
            self.corner_m() + self.task.config.bend_weight * bend
        });
        self.task.word_cost(curve, [0.0; 2]) + bends.sum::<f64>()
    }

    pub(super) fn try_lead(&mut self, from: usize, sight: Sight, curve: usize, cost: f64) {
        let (start, arcs) = &self.curves[curve];
        let ends_forward = |arcs: &[Arc]| arcs.last().is_none_or(|arc| arc.signed_length_m > 0.0);
        let switch = if ends_forward(arcs.arcs()) {
            0.0
        } else {
            self.task.cost.gear_switch_m
        };
        if self.is_closed(from, sight) {
            return;
        }
        if let Some(tightness_m) = self.task.tightness_m(*start, arcs.arcs()) {
            let cost = cost + switch + tightness_m;
            self.close(Leg::new(from, sight, Reached::ByCurve(curve)), cost);
        }
    }

    /// Puts the cheapest curves from the end of a leg to the goal on the list.
    pub(super) fn expand_tail(&mut self, leg: usize, cost: f64) {
        let from = self.pose(leg, self.legs[leg].sight.distance_m);
        for (curve_cost, start, curve) in self.cheapest_curves(&[from], &self.task.ends.goals) {
            let number = self.curves.len();
            self.curves.push((start, curve));
            self.open
                .push([cost + curve_cost, 0.0], Step::TailCurve(leg, number));
        }
    }

    pub(super) fn is_tail_free(&mut self, leg: usize, curve: usize) -> bool {
        let (start, curve) = &self.curves[curve];
        self.task.all_free(*start, curve.arcs()) && self.is_whole_leg_free(leg)
    }
}
