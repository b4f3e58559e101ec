//! A robot driven in simulation: it senses, updates its map, plans, times, steers, and the world
//! moves on.
//!
//! A [`Simulation`] holds the truth: a map, solids, agents that move, a vehicle with actuators. It
//! takes a command and returns an [`Observation`]: a measured pose, a lidar scan, what moves in
//! sight. A [`Driver`] turns observations into commands: a map from scans, a planner, a speed plan
//! that ends within what has been seen, a controller. [`drive`] is the loop over both.
//!
//! There is no clock and no thread: the same setup and seed give the same drive, to the last bit.
//!
//! ```
//! use formicar::{OccupancyGrid, Pose2, Vehicle};
//! use formicar_drive::{Driver, DriverConfig, DriveStatus, KnownMap, RunConfig, Simulation,
//!     SimulationConfig, World, drive};
//!
//! let hall = OccupancyGrid::from_rows(&["........................"; 14], 0.25)?;
//! let vehicle = Vehicle::f1tenth();
//! let (start, goal) = (Pose2::new(1.0, 1.0, 0.0), Pose2::new(4.5, 2.0, 0.0));
//! let config = SimulationConfig::default();
//! let known = KnownMap::unknown(*hall.frame());
//! let mut simulation = Simulation::new(World::new(hall, Vec::new()), &vehicle, start, &config)?;
//! let mut driver = Driver::new(known, &vehicle, goal, &DriverConfig::for_simulation(&config))?;
//! let record = drive(&mut simulation, &mut driver, &RunConfig::default(), &mut ())?;
//! assert_eq!(record.status, DriveStatus::Arrived);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![forbid(unsafe_code)]

mod agents;
mod contact;
mod driver;
mod error;
mod estimate;
mod known_map;
mod lidar;
mod limits;
mod picture;
mod random;
mod record;
mod route;
mod run;
mod simulation;
mod solid;
mod world;

pub use agents::{AGENTS_SCHEMA, Agent, AgentBehavior, AgentsDocument, random_walkers};
pub use contact::{Contact, Contacted, Culprit};
pub use driver::{Driver, DriverConfig, DriverCounts, UnknownGround};
pub use error::SetupError;
pub use estimate::PoseFilter;
pub use known_map::{KnownChange, KnownMap};
pub use lidar::{LidarConfig, Sweep};
pub use picture::{DriveView, drive_film, drive_picture};
pub use record::{
    AgentPose, DRIVE_SCHEMA, DrivePoint, DriveRecord, DriveStatus, Latencies, Latency,
};
pub use run::{Arrival, RunConfig, drive};
pub use simulation::{Observation, Simulation, SimulationConfig, Track};
pub use solid::{Nearness, Solid};
pub use world::World;
