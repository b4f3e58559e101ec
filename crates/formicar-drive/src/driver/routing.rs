//! The path to the goal, and the memory of what was tried.

use crate::route::joined;
use formicar::CurvePath;

/// Length of the driven path that is kept for backing off, meters.
const TRAIL_M: f64 = 3.0;

/// The path, and the memory of what was tried.
#[derive(Default)]
pub(super) struct Routing {
    pub(super) route: Option<Route>,
    /// What has been driven, as it was planned.
    pub(super) trail: Option<CurvePath>,
    pub(super) planned_s: f64,
    pub(super) moved_s: Option<f64>,
    pub(super) n_tries: usize,
    pub(super) since_try_m: f64,
}

/// A path from where the robot is due.
pub(super) struct Route {
    pub(super) path: CurvePath,
    /// The lane that it was planned on.
    pub(super) lane: usize,
    /// True for a way back that was driven before, which ends short of the goal.
    pub(super) retreats: bool,
}

impl Routing {
    pub(super) fn path(&self) -> Option<&CurvePath> {
        self.route.as_ref().map(|route| &route.path)
    }

    /// Drops the path.
    pub(super) fn forget(&mut self) {
        self.route = None;
    }

    /// Cuts off what has been driven.
    pub(super) fn advance(&mut self, driven_m: f64) {
        let Some(route) = &mut self.route else {
            return;
        };
        if driven_m <= 0.0 {
            return;
        }
        let driven = route.path.between_m(0.0, driven_m);
        route.path = route.path.between_m(driven_m, route.path.length_m());
        self.since_try_m += driven.length_m();
        let trail = match &self.trail {
            Some(trail) => joined(trail, &driven),
            None => driven,
        };
        let length_m = trail.length_m();
        self.trail = Some(trail.between_m(length_m - TRAIL_M, length_m));
    }
}
