//! Parameters of a driver.

use crate::error::{SetupError, in_range};
use crate::lidar::LidarConfig;
use crate::simulation::SimulationConfig;
use formicar::path::SpeedLimits;
use formicar::scenario::{GoalHeading, GoalTolerance};
use formicar::tracking::{
    Actuators, Controller, DEFAULT_SPEED_MPS, DriveLimits, MpcParameters, RegulatedPurePursuit,
};
use formicar::{Gears, PlannerConfig, Seed, Vehicle};

/// How a driver treats ground that it has not seen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UnknownGround {
    /// Plan through it, but be able to stop before it.
    #[default]
    StopBefore,
    /// Drive as if it were free: for comparisons, since it leads to collisions.
    TakeAsFree,
}

/// Parameters of a driver.
#[derive(Clone, Debug, PartialEq)]
pub struct DriverConfig {
    /// Seed of its planner.
    pub seed: Seed,
    /// The planner; one that replans.
    pub planner: PlannerConfig,
    /// Search steps per query, so that a drive is repeated to the bit.
    pub budget_steps: u64,
    /// Time between two plans, seconds.
    pub plan_period_s: f64,
    /// Time after which a path that is still free is planned anew, seconds.
    pub refresh_s: f64,
    /// Margins around the robot that paths are planned with, meters, the widest first; the last one
    /// is kept by every timed path.
    pub margins_m: Vec<f64>,
    /// Limits of speed plans. A deceleration that is left out is 0.8 of what the actuators can.
    pub limits: SpeedLimits,
    /// Top speed, m/s; that of the vehicle where left out.
    pub max_speed_mps: Option<f64>,
    /// Least distance of speed plans from predicted obstacles, meters; less only where it cannot be
    /// kept.
    pub distance_m: f64,
    /// Time for which what moves is predicted, seconds.
    pub horizon_s: f64,
    /// Growth of predicted bodies, m/s.
    pub growth_mps: f64,
    /// The controller.
    pub controller: Controller,
    /// The treatment of ground that has not been seen.
    pub unknown: UnknownGround,
    /// Gears that paths may use.
    pub gears: Gears,
    /// The rule for the heading at the goal.
    pub goal_heading: GoalHeading,
    /// The tolerance at the goal.
    pub goal_tolerance: GoalTolerance,
    /// Time for which the robot stands at first to find its pose, seconds.
    pub settle_s: f64,
    /// Time after which a robot that stands tries something else, seconds.
    pub patience_s: f64,
    /// Distance from the timed path at which the robot stops and plans anew, meters.
    pub max_error_m: f64,
    /// The lidar.
    pub lidar: LidarConfig,
    /// Standard deviation of a measured position, per axis, meters.
    pub position_noise_m: f64,
    /// Standard deviation of a measured heading, radians.
    pub heading_noise_rad: f64,
    /// Delay, acceleration and control period.
    pub actuators: Actuators,
    /// Fastest change of the steering angle, rad/s; that of the vehicle where left out.
    pub max_steer_rate_rad_per_s: Option<f64>,
}

/// Share of the actuators' deceleration that is planned with.
const BRAKING_SHARE: f64 = 0.8;
/// Time to average measured poses over, where they are noisy, seconds.
const SETTLE_S: f64 = 0.5;

impl Default for DriverConfig {
    fn default() -> Self {
        Self::for_simulation(&SimulationConfig::default())
    }
}

impl DriverConfig {
    /// The usual parameters for the sensors and actuators of a simulation.
    pub fn for_simulation(simulation: &SimulationConfig) -> Self {
        let is_noisy = simulation.position_noise_m > 0.0 || simulation.heading_noise_rad > 0.0;
        Self {
            seed: simulation.seed,
            planner: PlannerConfig::default(),
            budget_steps: 30_000,
            plan_period_s: 0.1,
            refresh_s: 1.0,
            margins_m: vec![0.1, 0.06, 0.03],
            limits: SpeedLimits {
                max_lateral_mps2: 2.0,
                ..SpeedLimits::default()
            },
            max_speed_mps: None,
            distance_m: 0.2,
            horizon_s: 4.0,
            growth_mps: 0.1,
            controller: usual_controller(),
            unknown: UnknownGround::default(),
            gears: Gears::Both,
            goal_heading: GoalHeading::Exact,
            goal_tolerance: GoalTolerance {
                xy_m: 0.1,
                yaw_rad: 0.1,
            },
            settle_s: if is_noisy { SETTLE_S } else { 0.0 },
            patience_s: 1.0,
            max_error_m: 0.25,
            lidar: simulation.lidar.clone(),
            position_noise_m: simulation.position_noise_m,
            heading_noise_rad: simulation.heading_noise_rad,
            actuators: simulation.actuators,
            max_steer_rate_rad_per_s: simulation.max_steer_rate_rad_per_s,
        }
    }

    /// Checks every parameter.
    ///
    /// # Errors
    /// The first out of its range, or a planner that does not replan.
    pub fn check(&self) -> Result<(), SetupError> {
        let n_margins = self.margins_m.len() as f64;
        in_range("number of margins_m", n_margins, 1.0..=8.0, "1 to 8")?;
        for &margin_m in &self.margins_m {
            in_range("margins_m", margin_m, 0.0..=10.0, "0 to 10 m")?;
        }
        if self.margins_m.windows(2).any(|pair| pair[1] > pair[0]) {
            return Err(SetupError::Contradiction {
                what: "margins_m",
                problem: format!("{:?} do not fall", self.margins_m),
                hint: "the widest comes first",
            });
        }
        in_range(
            "budget_steps",
            self.budget_steps as f64,
            1.0..=1e12,
            "at least 1",
        )?;
        in_range(
            "plan_period_s",
            self.plan_period_s,
            1e-3..=60.0,
            "0.001 to 60 s",
        )?;
        in_range("refresh_s", self.refresh_s, 1e-3..=1e6, "at least 0.001 s")?;
        in_range("distance_m", self.distance_m, 0.0..=100.0, "0 to 100 m")?;
        in_range("horizon_s", self.horizon_s, 0.01..=60.0, "0.01 to 60 s")?;
        in_range("growth_mps", self.growth_mps, 0.0..=10.0, "0 to 10 m/s")?;
        in_range("settle_s", self.settle_s, 0.0..=60.0, "0 to 60 s")?;
        in_range("patience_s", self.patience_s, 0.1..=600.0, "0.1 to 600 s")?;
        in_range("max_error_m", self.max_error_m, 0.01..=10.0, "0.01 to 10 m")?;
        in_range(
            "goal tolerance xy",
            self.goal_tolerance.xy_m,
            1e-3..=100.0,
            "0.001 to 100 m",
        )?;
        in_range(
            "goal tolerance yaw",
            self.goal_tolerance.yaw_rad,
            1e-3..=4.0,
            "0.001 to 4 rad",
        )?;
        if let Some(speed) = self.max_speed_mps {
            in_range("max_speed_mps", speed, 1e-3..=100.0, "0.001 to 100 m/s")?;
        }
        let limits = self.limits.check();
        limits.map_err(|error| SetupError::Tracking(error.into()))?;
        self.lidar.check()
    }

    /// With the limits that a vehicle and its actuators leave.
    pub(super) fn resolved(&self, vehicle: &Vehicle, limits: &DriveLimits) -> Self {
        let of_vehicle = vehicle.parameters().speed_mps;
        let speed_mps = self.max_speed_mps.or(of_vehicle);
        let braking_mps2 = self.limits.max_braking_mps2;
        let braking_mps2 = braking_mps2.unwrap_or(f64::INFINITY);
        Self {
            limits: SpeedLimits {
                max_speed_mps: speed_mps.unwrap_or(DEFAULT_SPEED_MPS),
                max_acceleration_mps2: limits.acceleration_mps2,
                max_braking_mps2: Some(braking_mps2.min(BRAKING_SHARE * limits.braking_mps2)),
                // Wheels that lag are the controller's to foresee: a stop at every joint of arcs
                // would stop the robot all the time.
                max_steer_rate_rad_per_s: None,
                max_jerk_mps3: None,
                ..self.limits.clone()
            },
            ..self.clone()
        }
    }
}

/// The model-predictive controller where it is compiled in, otherwise regulated pure pursuit.
fn usual_controller() -> Controller {
    if cfg!(feature = "mpc") {
        Controller::Mpc(MpcParameters::default())
    } else {
        Controller::RegulatedPurePursuit(RegulatedPurePursuit::default())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_out_of_range_are_named() {
        let usual = DriverConfig::default();
        usual.check().unwrap();
        let fault = |config: DriverConfig| config.check().unwrap_err().to_string();
        let no_horizon = DriverConfig {
            horizon_s: 0.0,
            ..usual.clone()
        };
        assert!(fault(no_horizon).contains("horizon_s = 0; it must be 0.01 to 60 s"));
        let no_time = DriverConfig {
            plan_period_s: f64::NAN,
            ..usual.clone()
        };
        assert!(fault(no_time).contains("plan_period_s = NaN"));
        let rising = DriverConfig {
            margins_m: vec![0.01, 0.1],
            ..usual.clone()
        };
        assert!(fault(rising).contains("the widest comes first"));
        let mut slow = usual;
        slow.limits.max_lateral_mps2 = 0.0;
        assert!(fault(slow).contains("max_lateral_mps2"));
    }
}
