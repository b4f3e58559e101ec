//! The arc that rounds a corner, and what it costs.

use crate::geometry::Arc;
use crate::smoothing::task::Task;
use crate::smoothing::{TurnOrder, TwoTurning};
use std::f64::consts::PI;

/// Factor from an arc's radius to the next one tried.
const TIGHTER: f64 = 0.75;
/// The widest arc, turning radii.
const MAX_RADII: f64 = 16.0;
/// Turns below this are none, radians.
const STRAIGHT_RAD: f64 = 1e-9;
/// The sharpest corner, radians.
const MAX_TURN_RAD: f64 = 0.75 * PI;

/// An arc that rounds a corner; one without a turn goes straight on.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Fillet {
    pub(super) turn_rad: f64,
    pub(super) radius_m: f64,
    /// From where the arc begins to the corner, and from there to where it ends, metres.
    pub(super) tangent_m: f64,
    /// What it costs that the arc passes near obstacles, metres.
    pub(super) tightness_m: f64,
}

impl Fillet {
    /// The arc of a corner with some room on the shorter of both legs: the widest, made tighter so
    /// many times. None where there is no room for one, or the turn is too sharp.
    pub(super) fn new(task: &Task, turn_rad: f64, room_m: f64, n_tighter: i32) -> Option<Self> {
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
            // The tightest of all is tried once, too.
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

    /// What a corner costs beyond the length of its legs, metres.
    pub(super) fn cost(&self, task: &Task) -> f64 {
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
