//! What a speed plan is asked for.

use crate::parameters::parameters;
use crate::path::{CurvePath, SpeedLimits};
use crate::scenario::{Predictions, SpeedZones};
use crate::vehicle::Vehicle;

parameters! {
    /// Parameters of a speed plan.
    pub struct MotionConfig {
        /// Limits of speed, acceleration and steering rate.
        pub limits: SpeedLimits = SpeedLimits::default(),
        /// Speed at the beginning of the path, meters per second.
        #[range(0.0..=100.0)]
        pub present_speed_mps: f64 = 0.0,
        /// Least distance from every moving obstacle, meters.
        #[range(0.0..=100.0)]
        pub distance_m: f64 = 0.1,
        /// Time for which the acceleration is held where something is in the way, seconds; it
        /// grows where the states would not fit into memory.
        #[range(0.01..=5.0)]
        pub time_step_s: f64 = 0.2,
    }
}

/// A path, the vehicle that drives it, and what may cross its way.
#[derive(Clone, Copy, Debug)]
pub struct MotionProblem<'a> {
    /// The path; a certified one, since standing obstacles are not looked at here.
    pub path: &'a CurvePath,
    /// The vehicle.
    pub vehicle: &'a Vehicle,
    /// Moving obstacles.
    pub predictions: &'a Predictions,
    /// Areas with speed limits of their own.
    pub zones: Option<&'a SpeedZones>,
}
