//! The driver: what is asked of it, in order.

use super::config::DriverConfig;
use super::lanes::Lanes;
use super::reference::Reference;
use super::routing::Routing;
use super::senses::Senses;
use crate::error::SetupError;
use crate::known_map::KnownMap;
use crate::limits::drive_limits;
use crate::simulation::Observation;
use formicar::geometry::angle_difference;
use formicar::path::SpeedLimits;
use formicar::scenario::GoalHeading;
use formicar::tracking::{DriveCommand, DriveLimits};
use formicar::vehicle::BicycleState;
use formicar::{CurvePath, Observer, Pose2, Vehicle};
use serde::{Deserialize, Serialize};

/// Slower than this, the robot stands, m/s.
pub(super) const STANDS_MPS: f64 = 0.02;

/// Drives a robot to a goal by what it observes.
///
/// The caller hands over each [`Observation`] ([`Driver::observe`]), lets it plan when that is due
/// ([`Driver::plan`]) and asks for a command every control period ([`Driver::command`]);
/// [`drive`](crate::drive) does so in a loop.
///
/// - Unknown ground may be planned through, but the timed path always ends within ground that has
///   been seen and is free: the robot never drives faster than it can stop there (see
///   [`UnknownGround`]).
/// - The path is planned anew where the map has changed under it, and now and then since more is
///   known. A new path begins where the robot can have stopped, so that it may begin with a change
///   of gear.
/// - What moves is predicted with its present velocity; the speed plan keeps a distance from it, and
///   the judge in time certifies each.
/// - Where there is no timed path, the robot brakes. One that stands for long plans with other
///   margins, avoids unknown ground, or backs off along what it has driven.
pub struct Driver {
    pub(super) config: DriverConfig,
    pub(super) vehicle: Vehicle,
    pub(super) limits: DriveLimits,
    pub(super) goal: Pose2,
    pub(super) senses: Senses,
    pub(super) lanes: Lanes,
    pub(super) routing: Routing,
    pub(super) reference: Reference,
    pub(super) counts: DriverCounts,
    pub(super) next_plan_s: f64,
    pub(super) begins_s: Option<f64>,
}

/// What a driver has done, in numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
#[non_exhaustive]
pub struct DriverCounts {
    /// Calls of [`Driver::plan`].
    pub n_plans: usize,
    /// Searches for a path, several where margins had to be lowered.
    pub n_searches: usize,
    /// Paths taken.
    pub n_routes: usize,
    /// Paths taken while the one before was still free, and that part from it by more than half the
    /// robot's width.
    pub n_flips: usize,
    /// Times at which no timed path was found while driving, and the robot braked.
    pub n_emergency_brakes: usize,
    /// Recoveries from a stand.
    pub n_recoveries: usize,
    /// Speed plans that the judge in time has certified.
    pub n_certified: usize,
    /// Commands without an answer of the controller's program.
    pub n_controller_failures: usize,
}

impl Driver {
    /// A driver who knows a map, or nothing of it.
    ///
    /// # Errors
    /// Parameters out of range, a vehicle that is not a car, a goal off the map, or a controller that
    /// is not compiled in.
    pub fn new(
        known: KnownMap,
        vehicle: &Vehicle,
        goal: Pose2,
        config: &DriverConfig,
    ) -> Result<Self, SetupError> {
        config.check()?;
        check_goal(&known, goal)?;
        let limits = drive_limits(vehicle, &config.actuators, config.max_steer_rate_rad_per_s)?;
        let config = config.resolved(vehicle, &limits);
        Ok(Self {
            lanes: Lanes::new(&known, vehicle, &config)?,
            senses: Senses::new(known, vehicle, &config, limits),
            routing: Routing::default(),
            reference: Reference::new(&config, limits)?,
            counts: DriverCounts::default(),
            next_plan_s: 0.0,
            begins_s: None,
            vehicle: vehicle.clone(),
            limits,
            goal,
            config,
        })
    }

    /// Takes in what the robot observes.
    pub fn observe(&mut self, seen: &Observation) {
        self.senses.observe(seen);
        if self.begins_s.is_none() {
            self.begins_s = Some(seen.t_s + self.config.settle_s);
            self.next_plan_s = seen.t_s + self.config.settle_s;
        }
    }

    /// True if it is time to plan.
    pub fn plan_is_due(&self) -> bool {
        const SAME_S: f64 = 1e-9;
        self.begins_s.is_some() && self.senses.t_s() >= self.next_plan_s - SAME_S
    }

    /// Updates the maps, the path and its times; nothing after arrival.
    ///
    /// # Errors
    /// A planner that refuses its own configuration.
    pub fn plan(&mut self, observer: &mut dyn Observer) -> Result<(), SetupError> {
        self.counts.n_plans += 1;
        self.next_plan_s = self.senses.t_s() + self.config.plan_period_s;
        if let Some(change) = self.senses.take_change() {
            self.lanes.update(&change)?;
        }
        if self.has_arrived() {
            self.reference.hold();
            return Ok(());
        }
        self.advance();
        self.choose_route(observer)?;
        self.set_times();
        Ok(())
    }

    /// The command for now: the controller's along the timed path, or to stand.
    pub fn command(&mut self) -> DriveCommand {
        let (state, t_s) = (self.senses.state(), self.senses.t_s());
        let clearance_m = if self.reference.asks_for_clearance() {
            self.lanes.clearance_m(state.pose)
        } else {
            f64::INFINITY
        };
        let command = self.reference.command(t_s, state, clearance_m);
        self.counts.n_controller_failures = self.reference.n_failures();
        command
    }

    /// True if the robot stands at its goal, as far as it knows.
    pub fn has_arrived(&self) -> bool {
        /// Beyond the tolerance, since paths end at its rim.
        const SLACK: f64 = 1.05;
        let state = self.senses.state();
        let tolerance = self.config.goal_tolerance;
        let turn_rad = angle_difference(state.pose.heading, self.goal.heading).abs();
        let turn_rad = match self.config.goal_heading {
            GoalHeading::Exact => turn_rad,
            GoalHeading::Bidirectional => turn_rad.min(std::f64::consts::PI - turn_rad),
            _ => 0.0,
        };
        let apart_m = state.pose.position().distance(self.goal.position());
        apart_m <= SLACK * tolerance.xy_m
            && turn_rad <= SLACK * tolerance.yaw_rad
            && state.speed_mps.abs() < STANDS_MPS
    }

    /// What it knows of the ground.
    pub fn known(&self) -> &KnownMap {
        self.senses.known()
    }

    /// Where it believes to be.
    pub fn state(&self) -> BicycleState {
        self.senses.state()
    }

    /// The path ahead up to the goal, as it was planned last.
    pub fn path(&self) -> Option<&CurvePath> {
        self.routing.path()
    }

    /// The goal.
    pub fn goal(&self) -> Pose2 {
        self.goal
    }

    /// Numbers of what it has done.
    pub fn counts(&self) -> &DriverCounts {
        &self.counts
    }

    /// The configuration, with the limits that it resolved.
    pub fn config(&self) -> &DriverConfig {
        &self.config
    }

    pub(super) fn limits_of_plan(&self) -> &SpeedLimits {
        &self.config.limits
    }
}

fn check_goal(known: &KnownMap, goal: Pose2) -> Result<(), SetupError> {
    let fault = |problem: &str| SetupError::Pose {
        which: "goal",
        x: goal.x,
        y: goal.y,
        problem: problem.to_owned(),
        hint: "check frame and units".to_owned(),
    };
    if !goal.is_finite() {
        return Err(fault("is not finite"));
    }
    match known.frame().cell_at(goal.position()) {
        Some(_) => Ok(()),
        None => Err(fault("lies outside the map")),
    }
}
