//! A vehicle simulated along a path: what it drives when a controller turns its wheels.
//!
//! The vehicle is the kinematic bicycle of [`crate::vehicle::BicycleState`] at a constant speed
//! (Lei & Zheng 2020, sec. IV.B). The wheels are held over a time step, so what it drives is a
//! chain of arcs: [`Tracking::driven`] is a path that collision and judge take as they take any.
//! Where the path changes gear the vehicle stops, turns its wheels and drives on.
//!
//! A car in reverse moves as a car that faces the other way, with its wheels turned the other way
//! and its front axle one wheelbase behind its rear one. Each stretch in one gear is seen in that
//! *travel frame*, so that controllers only ever drive forward.

mod clearance;
mod config;
mod controller;
mod document;
mod errors;
mod problem;
mod pure_pursuit;
mod record;
mod simulate;
mod stanley;
mod stretch;
mod swept_area;
mod timed;
mod trace;
mod view;

pub use clearance::{Contact, DrivenClearance};
pub use config::{DEFAULT_SPEED_MPS, StartOffset, TrackingConfig};
pub use controller::Controller;
pub use document::{TRACKING_SCHEMA, TrackingDocument};
pub use problem::TrackingError;
pub use pure_pursuit::PurePursuit;
pub use simulate::track;
pub use stanley::Stanley;
pub use swept_area::swept_area_m2;
#[cfg(feature = "mpc")]
pub use timed::ModelPredictive;
pub use timed::{
    ActuatedVehicle, Actuators, DriveCommand, DriveController, DriveLimits, DriveMoment,
    FollowedState, Follower, MpcParameters, RegulatedPurePursuit, track_by, track_in_time,
};
pub use trace::{TracePoint, Tracking, TrackingStatus, TrackingSummary};
