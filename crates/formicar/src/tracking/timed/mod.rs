//! Drives in time: a vehicle with actuators follows a timed path.
//!
//! Every control period a [`DriveController`] sees the vehicle, the timed path and the time, and
//! asks for a speed and a steering angle. The command takes effect after the delay of the actuators,
//! which turn the wheels and change the speed no faster than they can.

mod actuated;
mod actuators;
mod controller;
mod follower;
mod laws;
#[cfg(feature = "mpc")]
mod mpc;
mod mpc_parameters;
#[cfg(feature = "mpc")]
mod qp;
mod regulated;
mod simulate;

pub use actuated::ActuatedVehicle;
pub use actuators::Actuators;
pub use controller::{DriveCommand, DriveController, DriveLimits, DriveMoment};
pub use follower::{FollowedState, Follower};
#[cfg(feature = "mpc")]
pub use mpc::ModelPredictive;
pub use mpc_parameters::MpcParameters;
pub use regulated::RegulatedPurePursuit;
pub use simulate::{track_by, track_in_time};
