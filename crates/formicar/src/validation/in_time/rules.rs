//! What a drive is judged by.

use crate::path::SpeedLimits;
use crate::scenario::{Predictions, SpeedZones};
use crate::vehicle::Vehicle;

/// The rules that a drive has to keep.
#[derive(Clone, Copy, Debug)]
pub struct DriveRules<'a> {
    /// The vehicle.
    pub vehicle: &'a Vehicle,
    /// Limits of speed, acceleration and steering rate.
    pub limits: &'a SpeedLimits,
    /// Areas with speed limits of their own.
    pub zones: Option<&'a SpeedZones>,
    /// The speed with which the drive begins, m/s.
    pub present_speed_mps: f64,
    /// Moving obstacles.
    pub predictions: &'a Predictions,
    /// Least distance to be kept from them, meters.
    pub distance_m: f64,
}
