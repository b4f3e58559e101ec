//! Costs of motions.

use super::{DriveProblem, Side};
use crate::collision::MIN_CLEARANCE_M;
use crate::geometry::{Arc, Point2};

impl DriveProblem<'_> {
    /// Cost of a motion after another, given the cost factor at its end.
    pub(super) fn cost(&self, before: Arc, arc: Arc, dearness: f64) -> f64 {
        let switches = before.signed_length_m * arc.signed_length_m < 0.0;
        let switching = if switches {
            self.config.direction_switching_cost
        } else {
            0.0
        };
        let factor = self.gear_factor(arc) * self.steering_factor(before, arc);
        switching + arc.length_m() * factor * dearness
    }

    /// Cost factor on lengths at a position: by clearance and by soft costs.
    pub(super) fn dearness(&self, position: Point2, along: Point2) -> f64 {
        let wish_m = self.config.clearance_wish_m.max(2.0 * MIN_CLEARANCE_M);
        let (obstacles, body) = (self.map.obstacles(), self.map.body());
        let clearance_m = obstacles.estimate_at(body, position, along, wish_m);
        let nearness = (1.0 - clearance_m / wish_m).clamp(0.0, 1.0);
        let soft = self
            .soft_costs
            .map_or(0.0, |costs| costs.price_at(position));
        (1.0 + soft) * (1.0 + self.config.cost_penalty * nearness)
    }

    fn gear_factor(&self, arc: Arc) -> f64 {
        let sense = match self.side {
            Side::Start => 1.0,
            Side::Goal => -1.0,
        };
        if sense * arc.signed_length_m < 0.0 {
            self.config.reverse_penalty
        } else {
            1.0
        }
    }

    fn steering_factor(&self, before: Arc, arc: Arc) -> f64 {
        if arc.curvature_per_m == 0.0 {
            return 1.0;
        }
        let swings_over = before.curvature_per_m * arc.curvature_per_m < 0.0;
        let change = if swings_over {
            self.config.change_penalty
        } else {
            0.0
        };
        self.config.non_straight_penalty + change
    }

    /// Length of the pieces in which long arcs are priced, metres.
    pub(super) fn piece_m(&self) -> f64 {
        self.lattice.state_m
    }
}
