//! Costs of motions.

use super::{DriveProblem, Side};
use crate::geometry::{Arc, Point2};

impl DriveProblem<'_> {
    /// Cost of a motion after another, given the cost factor at its end.
    pub(super) fn cost(&self, before: Arc, arc: Arc, dearness: f64) -> f64 {
        let [before, arc] = [before, arc].map(|arc| self.as_driven(arc));
        let rate = self.cost.rate_after(before, arc);
        self.cost.joint_m(before, arc) + arc.length_m() * rate * dearness
    }

    /// Cost factor on lengths at a position: by clearance and by soft costs.
    pub(super) fn dearness(&self, position: Point2, along: Point2) -> f64 {
        let wish_m = self.cost.clearance_wish_m;
        let (obstacles, body) = (self.map.obstacles(), self.map.body());
        let clearance_m = obstacles.estimate_at(body, position, along, wish_m);
        let soft = self
            .soft_costs
            .map_or(0.0, |costs| costs.price_at(position));
        (1.0 + soft) * (1.0 + self.cost.nearness(clearance_m))
    }

    /// An arc in the gear in which it will be driven: a search from the goal goes back.
    fn as_driven(&self, arc: Arc) -> Arc {
        match self.side {
            Side::Start => arc,
            Side::Goal => Arc::new(arc.curvature_per_m, -arc.signed_length_m),
        }
    }

    /// Length of the pieces in which long arcs are priced, meters.
    pub(super) fn piece_m(&self) -> f64 {
        self.lattice.state_m
    }
}
