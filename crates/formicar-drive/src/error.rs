//! Setups that make no sense.

use formicar::PlanError;
use formicar::scenario::MovingError;
use formicar::tracking::TrackingError;
use formicar_mapping::MappingError;
use thiserror::Error;

/// An error in a simulated world, its agents, its robot or their parameters.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SetupError {
    /// A parameter outside its range.
    #[error("{what} = {value}; it must be {range}")]
    OutOfRange {
        /// The name of the parameter.
        what: &'static str,
        /// Its value.
        value: f64,
        /// The allowed values.
        range: &'static str,
    },
    /// Two parameters that contradict each other.
    #[error("{what}: {problem}; hint: {hint}")]
    Contradiction {
        /// The names of the parameters.
        what: &'static str,
        /// What is wrong.
        problem: String,
        /// The way out.
        hint: &'static str,
    },
    /// A start or goal that is off the map, not finite, or in contact.
    #[error("{which} ({x:.3}, {y:.3}) m {problem}; hint: {hint}")]
    Pose {
        /// Start or goal.
        which: &'static str,
        /// Meters.
        x: f64,
        /// Meters.
        y: f64,
        /// What is wrong.
        problem: String,
        /// The way out.
        hint: String,
    },
    /// An agent that cannot begin where it is put.
    #[error("agent {agent} at ({x:.3}, {y:.3}) m {problem}; hint: {hint}")]
    Agent {
        /// Its name, or its number counted from 1.
        agent: String,
        /// Meters.
        x: f64,
        /// Meters.
        y: f64,
        /// What is wrong.
        problem: &'static str,
        /// The way out.
        hint: &'static str,
    },
    /// A shape or a motion that makes no sense.
    #[error(transparent)]
    Moving(#[from] MovingError),
    /// A vehicle that cannot be driven, or a controller that is not compiled in.
    #[error(transparent)]
    Tracking(#[from] TrackingError),
    /// A planner that cannot be set up.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// A scan that makes no sense.
    #[error(transparent)]
    Scan(#[from] MappingError),
}

/// A number in a range, or an error that names it.
pub(crate) fn in_range(
    what: &'static str,
    value: f64,
    allowed: std::ops::RangeInclusive<f64>,
    range: &'static str,
) -> Result<(), SetupError> {
    if allowed.contains(&value) {
        return Ok(());
    }
    Err(SetupError::OutOfRange { what, value, range })
}
