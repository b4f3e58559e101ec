//! The loop over simulation and driver.

use crate::driver::Driver;
use crate::error::{SetupError, in_range};
use crate::record::{DRIVE_SCHEMA, DrivePoint, DriveRecord, DriveStatus, Latencies, Latency};
use crate::simulation::Simulation;
use formicar::{Observer, Pose2};
use serde::{Deserialize, Serialize};
use std::time::Duration;

/// Faster than this, a robot has set out, m/s; slower than a tenth of it, it stands.
const SETS_OUT_MPS: f64 = 0.1;

/// When a drive ends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RunConfig {
    /// Time after which it is over, seconds.
    pub max_time_s: f64,
    /// The condition of arrival.
    pub arrival: Arrival,
    /// Time between two points of the trace, seconds.
    pub record_interval_s: f64,
}

/// The condition of arrival.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Arrival {
    /// The robot stands within its goal tolerance, as far as it knows.
    #[default]
    Stands,
    /// Its rear axle has come within a distance of the goal, at any speed.
    Within {
        /// Meters.
        distance_m: f64,
    },
}

impl Default for RunConfig {
    fn default() -> Self {
        Self {
            max_time_s: 120.0,
            arrival: Arrival::default(),
            record_interval_s: 0.1,
        }
    }
}

impl RunConfig {
    fn check(&self) -> Result<(), SetupError> {
        in_range(
            "max_time_s",
            self.max_time_s,
            0.01..=36_000.0,
            "0.01 to 36000 s",
        )?;
        in_range(
            "record_interval_s",
            self.record_interval_s,
            1e-3..=60.0,
            "0.001 to 60 s",
        )?;
        if let Arrival::Within { distance_m } = self.arrival {
            in_range(
                "arrival distance_m",
                distance_m,
                1e-3..=1000.0,
                "0.001 to 1000 m",
            )?;
        }
        Ok(())
    }
}

/// Drives until the robot has arrived, has driven into something, or the time is over.
///
/// The observer sees the searches of the planner; where it has a clock, latencies are measured by it.
///
/// # Errors
/// Parameters out of range, or a planner that refuses its configuration.
pub fn drive(
    simulation: &mut Simulation,
    driver: &mut Driver,
    config: &RunConfig,
    observer: &mut dyn Observer,
) -> Result<DriveRecord, SetupError> {
    config.check()?;
    let start = simulation.state().pose;
    let mut log = Log::default();
    let mut seen = simulation.observe();
    let status = loop {
        driver.observe(&seen);
        if driver.plan_is_due() {
            let begun = observer.elapsed();
            driver.plan(observer)?;
            log.planner.extend(since(begun, observer));
        }
        let begun = observer.elapsed();
        let command = driver.command();
        log.controller.extend(since(begun, observer));
        log.note(simulation, driver, config);
        if let Some(status) = ending(simulation, driver, config) {
            break status;
        }
        seen = simulation.step(command);
    };
    log.push(simulation, driver);
    Ok(log.record(simulation, driver, (start, status)))
}

fn since(begun: Option<Duration>, observer: &mut dyn Observer) -> Option<Duration> {
    Some(observer.elapsed()?.saturating_sub(begun?))
}

fn ending(simulation: &Simulation, driver: &Driver, config: &RunConfig) -> Option<DriveStatus> {
    let contacts = simulation.contacts();
    if contacts.iter().any(|contact| contact.by.is_robot()) {
        return Some(DriveStatus::Collided);
    }
    let has_arrived = match config.arrival {
        Arrival::Stands => driver.has_arrived(),
        Arrival::Within { distance_m } => goal_error_m(simulation, driver.goal()) <= distance_m,
    };
    if has_arrived {
        return Some(DriveStatus::Arrived);
    }
    (simulation.t_s() >= config.max_time_s).then_some(DriveStatus::TimedOut)
}

fn goal_error_m(simulation: &Simulation, goal: Pose2) -> f64 {
    let here = simulation.state().pose.position();
    here.distance(goal.position())
}

/// What is noted on the way.
#[derive(Default)]
struct Log {
    planner: Vec<Duration>,
    controller: Vec<Duration>,
    trace: Vec<DrivePoint>,
    next_s: f64,
    max_speed_mps: f64,
    n_stops: usize,
    drives: bool,
}

impl Log {
    fn note(&mut self, simulation: &Simulation, driver: &Driver, config: &RunConfig) {
        const SAME_S: f64 = 1e-9;
        let speed_mps = simulation.state().speed_mps.abs();
        self.max_speed_mps = self.max_speed_mps.max(speed_mps);
        if speed_mps > SETS_OUT_MPS {
            self.drives = true;
        } else if self.drives && speed_mps < 0.1 * SETS_OUT_MPS {
            self.drives = false;
            self.n_stops += 1;
        }
        if simulation.t_s() >= self.next_s - SAME_S {
            self.next_s += config.record_interval_s;
            self.push(simulation, driver);
        }
    }

    fn push(&mut self, simulation: &Simulation, driver: &Driver) {
        let state = simulation.state();
        let t_s = simulation.t_s();
        if self.trace.last().is_some_and(|last| last.t_s == t_s) {
            return;
        }
        let believed = driver.state().pose.position();
        let agents = simulation.agent_poses().into_iter();
        self.trace.push(DrivePoint {
            t_s,
            pose: state.pose,
            speed_mps: state.speed_mps,
            steer_rad: state.steer_rad,
            pose_error_m: believed.distance(state.pose.position()),
            agents: agents.map(|p| [p.x, p.y, p.heading]).collect(),
        });
    }

    fn record(
        self,
        simulation: &Simulation,
        driver: &Driver,
        (start, status): (Pose2, DriveStatus),
    ) -> DriveRecord {
        let planner = Latency::of(&self.planner);
        let controller = Latency::of(&self.controller);
        let latencies = planner
            .zip(controller)
            .map(|(planner, controller)| Latencies {
                planner,
                controller,
            });
        DriveRecord {
            schema: DRIVE_SCHEMA.to_owned(),
            status,
            seed: driver.config().seed,
            start,
            goal: driver.goal(),
            duration_s: simulation.t_s(),
            driven_m: simulation.driven_m(),
            goal_error_m: goal_error_m(simulation, driver.goal()),
            max_speed_mps: self.max_speed_mps,
            min_static_distance_m: simulation.min_static_distance_m(),
            min_agent_distance_m: simulation.min_agent_distance_m(),
            min_time_to_collision_s: simulation.min_time_to_collision_s(),
            n_stops: self.n_stops,
            known_share: driver.known().known_share(),
            driver: *driver.counts(),
            contacts: simulation.contacts().to_vec(),
            latencies,
            agents: simulation
                .agents()
                .map(|(_, agent)| agent.clone())
                .collect(),
            trace: self.trace,
        }
    }
}
