//! Costs of motions.

use super::{DriveProblem, Side};
use crate::collision::Drive;
use crate::geometry::{Arc, Point2, Pose2};

impl DriveProblem<'_> {
    /// Cost of a motion after another, given the cost factor at its end.
    pub(super) fn cost(&self, before: Arc, arc: Arc, dearness: f64) -> f64 {
        let [before, arc] = [before, arc].map(|arc| self.as_driven(arc));
        let rate = self.cost.rate_after(before, arc);
        self.cost.joint_m(before, arc) + arc.length_m() * rate * dearness
    }

    /// Cost factor on lengths at a position, by clearance and by soft costs; none where the body
    /// keeps too little clearance.
    pub(super) fn dearness(&self, position: Point2, along: Point2) -> Option<f64> {
        let kept_m = self.kept_clearance_m;
        let enough_m = self.cost.clearance_wish_m.max(kept_m);
        let (obstacles, body) = (self.map.obstacles(), self.map.body());
        let clearance_m = obstacles.estimate_at(body, position, along, enough_m);
        // The estimate is a lower bound.
        if kept_m > 0.0 && clearance_m < kept_m {
            let stand = Drive::at(Pose2::at(position, along.angle()));
            if obstacles.drive_clearance_m(body, &stand, kept_m) < kept_m {
                return None;
            }
        }
        let soft = self
            .soft_costs
            .map_or(0.0, |costs| costs.price_at(position));
        Some((1.0 + soft) * (1.0 + self.cost.nearness(clearance_m)))
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
