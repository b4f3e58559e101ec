//! The limits of a vehicle with its actuators.

use crate::error::SetupError;
use formicar::tracking::{Actuators, DriveLimits};
use formicar::{PlanError, Vehicle};

/// What a vehicle can do; brakes without a limit of their own are as strong as the motor.
pub(crate) fn drive_limits(
    vehicle: &Vehicle,
    actuators: &Actuators,
    steer_rate_rad_per_s: Option<f64>,
) -> Result<DriveLimits, SetupError> {
    let limits = DriveLimits::of(vehicle, actuators, steer_rate_rad_per_s)?;
    let braking_mps2 = actuators.max_braking_mps2;
    Ok(DriveLimits {
        braking_mps2: braking_mps2.unwrap_or(limits.acceleration_mps2),
        ..limits
    })
}

/// A vehicle with another margin.
pub(crate) fn with_margin(vehicle: &Vehicle, margin_m: f64) -> Result<Vehicle, SetupError> {
    vehicle.with_safety_margin(margin_m).map_err(plan_error)
}

/// An error of map, vehicle or planner.
pub(crate) fn plan_error(error: impl Into<PlanError>) -> SetupError {
    SetupError::Plan(error.into())
}
