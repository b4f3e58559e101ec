//! The steering laws as controllers in time: they steer, and the timed path gives the speed.

use super::controller::{DriveCommand, DriveController, DriveMoment};
use crate::tracking::Controller;
use crate::tracking::stretch::faced;
use crate::tracking::view::View;

/// A steering law with the speed of the timed path.
pub(super) struct Scheduled {
    pub(super) law: Controller,
}

impl DriveController for Scheduled {
    fn name(&self) -> &str {
        self.law.name()
    }

    fn command(&mut self, at: &DriveMoment) -> DriveCommand {
        let speed_mps = at.scheduled_speed_mps();
        let asked_rad = self.law.steer_rad(&view(at, speed_mps));
        at.drive(speed_mps, at.direction.sign() * asked_rad)
    }
}

/// The moment as a steering law sees it, in the travel frame.
pub(super) fn view<'a>(at: &DriveMoment<'a>, speed_mps: f64) -> View<'a> {
    View {
        stretch: at.stretch,
        driven_m: at.driven_m,
        foot_m: at.foot_m,
        pose: faced(at.state.pose, at.direction),
        wheelbase_m: at.limits.wheelbase_m,
        speed_mps,
    }
}
