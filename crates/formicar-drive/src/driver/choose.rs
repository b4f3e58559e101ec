//! The path to the goal: when to keep it, when to plan anew, and what to do when stuck.

use super::lanes::Search;
use super::robot::{Driver, STANDS_MPS};
use super::routing::Route;
use crate::error::SetupError;
use crate::route::{NOTHING_M, back, from_pose, joined, parting_m};
use formicar::scenario::GoalTolerance;
use formicar::{CurvePath, Observer, Pose2, Request};

/// Length that the robot backs off, in lengths of its body.
const BACK_OFF: f64 = 1.0;
/// Driving so far ends a series of recoveries, meters.
const RECOVERED_M: f64 = 1.0;
/// Beyond the way to stop, meters: where a new path may begin.
const COMMIT_M: f64 = 0.03;
/// A robot with company waits so much longer before it tries something else.
const COMPANY: f64 = 3.0;
/// Something that moves within this is company, meters.
const COMPANY_M: f64 = 2.0;
/// Where no path was found, another search waits for so long, seconds.
const RETRY_S: f64 = 0.5;
/// Length over which paths are compared, meters.
const COMPARED_M: f64 = 2.0;

impl Driver {
    /// Keeps the path, or plans another.
    pub(super) fn choose_route(&mut self, observer: &mut dyn Observer) -> Result<(), SetupError> {
        self.note_motion();
        if self.is_stuck() {
            return self.recover(observer);
        }
        let age_s = self.senses.t_s() - self.routing.planned_s;
        let Some(route) = &self.routing.route else {
            let waits = self.counts.n_searches > 0 && age_s < RETRY_S;
            return if waits {
                Ok(())
            } else {
                self.plan_from_here(0, observer)
            };
        };
        let length_m = route.path.length_m();
        if length_m < NOTHING_M {
            return self.plan_from_here(0, observer);
        }
        if route.retreats {
            return Ok(());
        }
        let is_blocked = self.lanes.free_m(route.lane, &route.path) < length_m - NOTHING_M;
        if !is_blocked && age_s < self.config.refresh_s {
            return Ok(());
        }
        let lane = if is_blocked {
            route.lane
        } else {
            route.lane.saturating_sub(1)
        };
        self.replan(lane, is_blocked, observer)
    }

    fn note_motion(&mut self) {
        let t_s = self.senses.t_s();
        let moves = self.senses.state().speed_mps.abs() > STANDS_MPS;
        if moves || self.routing.moved_s.is_none() {
            self.routing.moved_s = Some(t_s);
        }
        if self.routing.since_try_m > RECOVERED_M {
            self.routing.n_tries = 0;
        }
    }

    fn is_stuck(&self) -> bool {
        let factor = if self.senses.has_company(COMPANY_M) {
            COMPANY
        } else {
            1.0
        };
        let stands_s = self.senses.t_s() - self.routing.moved_s.unwrap_or(0.0);
        stands_s > factor * self.config.patience_s
    }

    /// Tries in turn: known ground alone, backing off, planning from scratch.
    fn recover(&mut self, observer: &mut dyn Observer) -> Result<(), SetupError> {
        self.counts.n_recoveries += 1;
        self.routing.moved_s = Some(self.senses.t_s());
        self.routing.since_try_m = 0.0;
        let n_tries = self.routing.n_tries;
        self.routing.n_tries += 1;
        self.routing.forget();
        self.reference.hold();
        match n_tries % 3 {
            0 => self.plan_from_here(self.lanes.cautious(), observer)?,
            1 => self.back_off(n_tries / 3),
            _ => {}
        }
        if self.routing.route.is_none() {
            self.plan_from_here(0, observer)?;
        }
        Ok(())
    }

    /// Back along what was driven, farther each time.
    fn back_off(&mut self, n_before: usize) {
        let (low, high) = self.vehicle.footprint().bounds();
        let Some(trail) = self.routing.trail.take() else {
            return;
        };
        let length_m = trail.length_m();
        let back_m = (BACK_OFF * (1 + n_before) as f64 * (high.x - low.x)).min(length_m);
        let way = back(&trail.between_m(length_m - back_m, length_m));
        if way.length_m() < NOTHING_M {
            return;
        }
        self.routing.route = Some(Route {
            path: from_pose(&way, self.senses.state().pose),
            lane: self.lanes.cautious(),
            retreats: true,
        });
    }

    /// Plans from where the robot stands; one that still rolls waits until it stands.
    fn plan_from_here(
        &mut self,
        first: usize,
        observer: &mut dyn Observer,
    ) -> Result<(), SetupError> {
        let state = self.senses.state();
        if state.speed_mps.abs() > STANDS_MPS {
            return Ok(());
        }
        self.reference.hold();
        let search = Search {
            request: self.request(state.pose),
            previous: None,
            first,
        };
        let counted = (&mut self.counts.n_searches, observer);
        let found = self.lanes.search(&search, &self.config, counted)?;
        self.routing.planned_s = self.senses.t_s();
        self.routing.route = found.map(|(path, lane)| Route {
            path,
            lane,
            retreats: false,
        });
        self.counts.n_routes += usize::from(self.routing.route.is_some());
        Ok(())
    }

    /// Plans again from where the robot can have stopped.
    fn replan(
        &mut self,
        first: usize,
        is_blocked: bool,
        observer: &mut dyn Observer,
    ) -> Result<(), SetupError> {
        let Some(route) = self.routing.route.take() else {
            return Ok(());
        };
        let due_mps = self.reference.present_mps();
        if due_mps == 0.0 && self.senses.state().speed_mps.abs() < STANDS_MPS {
            self.routing.route = Some(route);
            return self.replan_standing(first, is_blocked, observer);
        }
        let braking_mps2 = self.limits_of_plan().braking_mps2();
        let commit_m = due_mps * due_mps / (2.0 * braking_mps2) + COMMIT_M;
        let length_m = route.path.length_m();
        let is_open = self.lanes.open_m(&route.path) > commit_m;
        if commit_m + COMMIT_M > length_m || !is_open {
            self.routing.route = Some(route);
            return Ok(());
        }
        let (kept, rest) = (
            route.path.between_m(0.0, commit_m),
            route.path.between_m(commit_m, length_m),
        );
        let search = Search {
            request: self.request(kept.end()),
            previous: Some(&rest),
            first,
        };
        let counted = (&mut self.counts.n_searches, observer);
        let found = self.lanes.search(&search, &self.config, counted)?;
        self.routing.planned_s = self.senses.t_s();
        let found = found.map(|(path, lane)| (joined(&kept, &path), lane));
        self.take(route, found, is_blocked);
        Ok(())
    }

    /// From a stand the path begins where the robot is, not where it should be.
    fn replan_standing(
        &mut self,
        first: usize,
        is_blocked: bool,
        observer: &mut dyn Observer,
    ) -> Result<(), SetupError> {
        let Some(route) = self.routing.route.take() else {
            return Ok(());
        };
        let pose = self.senses.state().pose;
        let search = Search {
            request: self.request(pose),
            previous: Some(&route.path),
            first,
        };
        let counted = (&mut self.counts.n_searches, observer);
        let found = self.lanes.search(&search, &self.config, counted)?;
        self.routing.planned_s = self.senses.t_s();
        self.take(route, found, is_blocked);
        Ok(())
    }

    /// Takes a path that was found, or keeps the one before.
    fn take(&mut self, old: Route, found: Option<(CurvePath, usize)>, is_blocked: bool) {
        let Some((path, lane)) = found else {
            self.routing.route = Some(old);
            return;
        };
        let compared_m = COMPARED_M.min(path.length_m()).min(old.path.length_m());
        let parts_m = parting_m(&path, &old.path, compared_m);
        let is_other = parts_m > 0.5 * self.vehicle.width_m();
        self.counts.n_flips += usize::from(!is_blocked && is_other);
        self.counts.n_routes += usize::from(is_blocked || is_other);
        self.routing.route = Some(Route {
            path,
            lane,
            retreats: false,
        });
    }

    /// Paths end within half the tolerance: the controller needs some of it.
    fn request(&self, start: Pose2) -> Request {
        let tolerance = self.config.goal_tolerance;
        Request {
            goal_heading: self.config.goal_heading,
            goal_tolerance: GoalTolerance {
                xy_m: 0.5 * tolerance.xy_m,
                yaw_rad: 0.5 * tolerance.yaw_rad,
            },
            gears: self.config.gears,
            ..Request::new(start, self.goal)
        }
    }
}
