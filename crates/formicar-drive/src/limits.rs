//! The limits of a vehicle with its actuators.

use crate::error::SetupError;
use formicar::tracking::{Actuators, DriveLimits, TrackingError};
use formicar::vehicle::Motion;
use formicar::{PlanError, Vehicle};

/// Acceleration of a vehicle that names none, m/s^2.
const USUAL_ACCELERATION_MPS2: f64 = 1.0;

/// What a vehicle can do; where the actuators leave something out, as the vehicle says. Braking is
/// as strong as the acceleration.
pub(crate) fn drive_limits(
    vehicle: &Vehicle,
    actuators: &Actuators,
    steer_rate_rad_per_s: Option<f64>,
) -> Result<DriveLimits, SetupError> {
    actuators
        .check()
        .map_err(|error| SetupError::Tracking(TrackingError::from(error)))?;
    if vehicle.motion() == Motion::Point {
        return Err(TrackingError::NeedsACar.into());
    }
    let wheelbase_m = vehicle.wheelbase_m();
    let wheelbase_m = wheelbase_m.ok_or(TrackingError::NeedsAWheelbase)?;
    let parameters = vehicle.parameters();
    let acceleration_mps2 = actuators.max_acceleration_mps2;
    let acceleration_mps2 = acceleration_mps2.or(parameters.max_acceleration_mps2);
    let acceleration_mps2 = acceleration_mps2.unwrap_or(USUAL_ACCELERATION_MPS2);
    let rate = steer_rate_rad_per_s.or(parameters.max_steer_rate_rad_per_s);
    Ok(DriveLimits {
        wheelbase_m,
        max_steer_rad: (wheelbase_m * vehicle.max_curvature_per_m()).atan(),
        steer_rate_rad_per_s: rate.unwrap_or(f64::INFINITY),
        acceleration_mps2,
        braking_mps2: actuators.max_braking_mps2.unwrap_or(acceleration_mps2),
        delay_s: actuators.delay_s,
        control_period_s: actuators.control_period_s,
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
