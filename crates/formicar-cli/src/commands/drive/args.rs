//! Flags of `drive`.

use crate::mode_args::ModeArgs;
use crate::scene::SceneArgs;
use crate::values;
use anyhow::{Context, Result, bail};
use clap::{Args, ValueEnum, ValueHint};
use formicar::geometry::Pose2;
use formicar::scenario::GoalTolerance;
use formicar::tracking::{Actuators, Controller, MpcParameters, RegulatedPurePursuit};
use formicar::{Seed, Vehicle};
use formicar_drive::{
    AGENTS_SCHEMA, Agent, AgentsDocument, Arrival, DriverConfig, LidarConfig, RunConfig,
    SimulationConfig, UnknownGround, random_walkers,
};
use std::path::PathBuf;

/// Flags of `drive`.
#[derive(Args, Debug)]
#[command(after_help = "\
The map is the truth. The robot knows it too, or nothing of it (--unknown-map): then its lidar shows \
it the ground, and it never drives faster than it can stop within what it has seen. Exit code 3 if \
the robot drives into something or does not arrive in time.")]
pub(crate) struct DriveArgs {
    #[command(flatten)]
    pub(super) scene: SceneArgs,

    /// Start pose in meters and radians (or 90deg).
    #[arg(long, value_name = "X,Y,H", value_parser = values::pose, allow_hyphen_values = true)]
    pub(super) start: Option<Pose2>,

    /// Goal pose.
    #[arg(long, value_name = "X,Y,H", value_parser = values::pose, allow_hyphen_values = true)]
    pub(super) goal: Option<Pose2>,

    #[command(flatten)]
    pub(super) modes: ModeArgs,

    /// Tolerance at the goal; 0.1,0.1 by default.
    #[arg(long, value_name = "M,RAD", value_parser = values::goal_tolerance, allow_hyphen_values = true)]
    goal_tolerance: Option<GoalTolerance>,

    /// End the drive where the rear axle comes within so many meters of the goal, at any speed.
    #[arg(long, value_name = "M", value_parser = values::positive, allow_hyphen_values = true)]
    within: Option<f64>,

    /// Begin without a map.
    #[arg(long)]
    pub(super) unknown_map: bool,

    /// Drive as if unknown ground were free, to see what that leads to.
    #[arg(long, requires = "unknown_map")]
    no_safe_speed: bool,

    /// Agents: scripted, at constant velocity, walkers and carts (see `formicar/agents/1`).
    #[arg(long, value_name = "F.json", value_hint = ValueHint::FilePath)]
    agents: Option<PathBuf>,

    /// Walkers at random places, every other one of whom makes way.
    #[arg(long, value_name = "N", conflicts_with = "agents",
          value_parser = clap::value_parser!(u32).range(1..=500))]
    agents_random: Option<u32>,

    /// Seed of noise, walkers and planner: same seed, same drive.
    #[arg(
        long,
        value_name = "N",
        default_value_t = 1,
        allow_hyphen_values = true
    )]
    pub(super) seed: u64,

    /// Controller; `mpc` by default.
    #[arg(long, value_name = "LAW")]
    controller: Option<Law>,

    /// Top speed in m/s; that of the vehicle by default.
    #[arg(long, value_name = "MPS", value_parser = values::positive, allow_hyphen_values = true)]
    speed: Option<f64>,

    /// Largest acceleration and deceleration in m/s^2; that of the vehicle by default, or 1.
    #[arg(long, value_name = "MPS2", value_parser = values::positive, allow_hyphen_values = true)]
    acceleration: Option<f64>,

    /// Steering rate in rad/s (or 200deg); that of the vehicle by default, or unlimited.
    #[arg(long, value_name = "RAD_PER_S", value_parser = values::turn_rate, allow_hyphen_values = true)]
    steer_rate: Option<f64>,

    /// Time until a command takes effect, seconds; 0 by default.
    #[arg(long, value_name = "S", value_parser = values::not_negative, allow_hyphen_values = true)]
    delay: Option<f64>,

    /// Standard deviations of a measured pose, drawn anew per reading: meters, radians (or 1deg).
    #[arg(long, value_name = "M,RAD", value_parser = values::goal_tolerance, allow_hyphen_values = true)]
    pose_noise: Option<GoalTolerance>,

    /// Standard deviation of lidar ranges, meters; 0.01 by default.
    #[arg(long, value_name = "M", value_parser = values::not_negative, allow_hyphen_values = true)]
    lidar_noise: Option<f64>,

    /// Range of the lidar, meters; 30 by default.
    #[arg(long, value_name = "M", value_parser = values::positive, allow_hyphen_values = true)]
    lidar_range: Option<f64>,

    /// Time after which the drive is over, seconds; 120 by default.
    #[arg(long, value_name = "S", value_parser = values::positive, allow_hyphen_values = true)]
    max_time: Option<f64>,

    /// Write the record of the drive.
    #[arg(long, value_name = "F.json", value_hint = ValueHint::FilePath)]
    pub(super) out: Option<PathBuf>,

    /// Write a picture.
    #[arg(long, value_name = "F.svg|F.png", value_hint = ValueHint::FilePath)]
    pub(super) picture: Option<PathBuf>,

    /// Write a film.
    #[arg(long, value_name = "F.gif", value_hint = ValueHint::FilePath)]
    pub(super) film: Option<PathBuf>,

    /// Print the record as one JSON object.
    #[arg(long)]
    pub(super) json: bool,
}

/// The controllers that drive in time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Law {
    /// Pure pursuit that slows down in turns, near obstacles and toward stops.
    RegulatedPurePursuit,
    /// Look ahead with a model of the vehicle.
    Mpc,
}

impl DriveArgs {
    /// Sensors, actuators and seed.
    pub(super) fn simulation(&self) -> SimulationConfig {
        let usual = SimulationConfig::default();
        let (noise, lidar) = (self.pose_noise, usual.lidar);
        SimulationConfig {
            seed: Seed(self.seed),
            lidar: LidarConfig {
                sigma_m: self.lidar_noise.unwrap_or(lidar.sigma_m),
                max_m: self.lidar_range.unwrap_or(lidar.max_m),
                ..lidar
            },
            position_noise_m: noise.map_or(0.0, |noise| noise.xy_m),
            heading_noise_rad: noise.map_or(0.0, |noise| noise.yaw_rad),
            actuators: Actuators {
                delay_s: self.delay.unwrap_or(0.0),
                max_acceleration_mps2: self.acceleration,
                ..usual.actuators
            },
            max_steer_rate_rad_per_s: self.steer_rate,
        }
    }

    /// The driver for these sensors and actuators.
    pub(super) fn driver(&self, simulation: &SimulationConfig) -> DriverConfig {
        let usual = DriverConfig::for_simulation(simulation);
        DriverConfig {
            max_speed_mps: self.speed,
            gears: self.modes.motion.unwrap_or(usual.gears),
            goal_heading: self.modes.goal_heading.unwrap_or(usual.goal_heading),
            goal_tolerance: self.goal_tolerance.unwrap_or(usual.goal_tolerance),
            unknown: if self.no_safe_speed {
                UnknownGround::TakeAsFree
            } else {
                UnknownGround::StopBefore
            },
            controller: match self.controller {
                None => usual.controller.clone(),
                Some(Law::Mpc) => Controller::Mpc(MpcParameters::default()),
                Some(Law::RegulatedPurePursuit) => {
                    Controller::RegulatedPurePursuit(RegulatedPurePursuit::default())
                }
            },
            ..usual
        }
    }

    /// When the drive ends.
    pub(super) fn ending(&self) -> RunConfig {
        let usual = RunConfig::default();
        RunConfig {
            max_time_s: self.max_time.unwrap_or(usual.max_time_s),
            arrival: match self.within {
                Some(distance_m) => Arrival::Within { distance_m },
                None => usual.arrival,
            },
            ..usual
        }
    }

    /// The agents of the file, or random ones.
    pub(super) fn agents(
        &self,
        map: &formicar::OccupancyGrid,
        vehicle: &Vehicle,
        start: Pose2,
    ) -> Result<Vec<Agent>> {
        if let Some(n) = self.agents_random {
            let n = n as usize;
            let walkers = random_walkers(map, vehicle, start, (n, Seed(self.seed)));
            if walkers.len() < n {
                let room = walkers.len();
                bail!("--agents-random {n}: the map has room for {room}; hint: ask for fewer");
            }
            return Ok(walkers);
        }
        let Some(path) = &self.agents else {
            return Ok(Vec::new());
        };
        let name = || path.display().to_string();
        let text = crate::files::read_document(path)?;
        let read: Result<AgentsDocument, _> = serde_json::from_str(&text);
        let document = read.with_context(|| {
            format!(
                "{}: no agents; hint: {{\"agents\": [...]}}, see the book's page on drives",
                name()
            )
        })?;
        if let Some(found) = document.schema.as_ref().filter(|s| *s != AGENTS_SCHEMA) {
            bail!(
                "{}: schema {found:?}; this version reads {AGENTS_SCHEMA:?}",
                name()
            );
        }
        Ok(document.agents)
    }
}
