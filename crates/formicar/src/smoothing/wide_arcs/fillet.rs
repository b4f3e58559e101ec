//! The arc that rounds a corner, and its cost.

use crate::geometry::{Arc, Point2};
use crate::smoothing::task::RoundingTask;
use crate::smoothing::two_turning::{TurnOrder, TwoTurning};
use std::f64::consts::PI;

/// Factor from an arc's radius to the next one tried.
const TIGHTER: f64 = 0.75;
/// The widest arc, turning radii.
const MAX_RADII: f64 = 16.0;
/// Turns below this do not count, radians.
const STRAIGHT_RAD: f64 = 1e-9;
/// The sharpest corner, radians.
const MAX_TURN_RAD: f64 = 0.75 * PI;

/// A corner with the turning that rounds it.
#[derive(Clone, Copy, Debug)]
pub(in crate::smoothing) struct Rounded {
    pub(in crate::smoothing) place: Point2,
    pub(in crate::smoothing) turning: TwoTurning,
}

/// An arc that rounds a corner; one without a turn goes straight on.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Fillet {
    pub(super) turn_rad: f64,
    pub(super) radius_m: f64,
    /// Distance of both ends of the arc from the corner, meters.
    pub(super) tangent_m: f64,
    /// Cost of passing near obstacles along the arc, meters.
    pub(super) tightness_m: f64,
}

impl Fillet {
    /// The widest arc that the room on the shorter of both legs allows, tightened `n_tighter` times;
    /// none where there is no room for one, or the turn is too sharp.
    pub(super) fn new(
        task: &RoundingTask,
        turn_rad: f64,
        room_m: f64,
        n_tighter: i32,
    ) -> Option<Self> {
        if turn_rad.abs() < STRAIGHT_RAD {
            return (n_tighter == 0).then_some(Self::default());
        }
        if turn_rad.abs() > MAX_TURN_RAD {
            return None;
        }
        let (tangent, least_m) = ((0.5 * turn_rad.abs()).tan(), task.radius_m);
        let widest_m = (room_m / tangent).min(MAX_RADII * least_m);
        let wanted_m = widest_m * TIGHTER.powi(n_tighter);
        let radius_m = if wanted_m >= least_m {
            wanted_m
        } else if widest_m >= least_m && wanted_m > TIGHTER * least_m {
            // The tightest arc is tried once, too.
            least_m
        } else {
            return None;
        };
        Some(Self {
            turn_rad,
            radius_m,
            tangent_m: radius_m * tangent,
            tightness_m: 0.0,
        })
    }

    /// Cost of a corner beyond the length of its legs, meters.
    pub(super) fn cost(&self, task: &RoundingTask) -> f64 {
        if self.turn_rad == 0.0 {
            return 0.0;
        }
        let (config, least_m) = (task.config, task.radius_m);
        let bend = self.turn_rad.abs() * least_m * least_m / self.radius_m;
        let shortened_m = 2.0 * self.tangent_m - self.turn_rad.abs() * self.radius_m;
        config.corner_radii * least_m + config.bend_weight * bend - shortened_m + self.tightness_m
    }

    pub(super) fn arc(&self) -> Arc {
        if self.turn_rad == 0.0 {
            return Arc::new(0.0, 0.0);
        }
        let length_m = self.turn_rad.abs() * self.radius_m;
        Arc::new(self.turn_rad.signum() / self.radius_m, length_m)
    }

    pub(super) fn turning(&self) -> Option<TwoTurning> {
        TwoTurning::new(self.turn_rad, self.radius_m, TurnOrder::AvoidFirst, 0.0)
    }
}
